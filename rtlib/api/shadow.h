// What the rest of an instance needs of its shadow.
#pragma once
#include "rtlib/api/instance.h"

namespace rung::api {

// The running program makes a request.
void shadowRequest(rung_instance& instance, const core::ServiceRequest& request) noexcept;
// The instance has a shadow no longer.
void endShadow(rung_instance& instance) noexcept;

} // namespace rung::api
