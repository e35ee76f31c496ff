// What others ask of a replacement.
#pragma once
#include <memory>

#include "rtlib/api/instance.h"

namespace rung::api {

// The program that would take over with it. A status, and a sentence where it is an error.
int32_t nextOf(const rung_instance& instance, const rung_replacement* replacement, std::shared_ptr<Generation>& next);

// Whether a program can take over from those of the instance, or run beside them: it is of their dialect.
int32_t checkDialect(const rung_instance& instance, const rung_program& program) noexcept;

// RUNG_LATER, and the sentence why: `result` is what the instance has said.
int32_t failLater(const rung_instance& instance, runtime::ReplaceResult result,
                  const runtime::StateTransfer& transfer) noexcept;

// What the rest of an instance needs of its shadow.

// The running program makes a request.
void shadowRequest(rung_instance& instance, const core::ServiceRequest& request) noexcept;
// The instance has a shadow no longer.
void endShadow(rung_instance& instance) noexcept;

} // namespace rung::api
