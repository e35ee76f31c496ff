// What the rest of an instance needs of its shadow.
#pragma once
#include "rtlib/runtime/instance.h"

namespace rung::runtime {

// The running program makes a request.
void shadowRequest(rung_instance& instance, const rt::ServiceRequest& request) noexcept;
// The instance has a shadow no longer.
void endShadow(rung_instance& instance) noexcept;

} // namespace rung::runtime
