// Functions of replacements and shadows that other parts of the library call.
#pragma once
#include <memory>

#include "rtlib/api/instance.h"

namespace rung::api {

// Returns the program of a replacement in `next`. The result is a status; an error has a sentence.
int32_t nextOf(const rung_instance& instance, const rung_replacement* replacement, std::shared_ptr<Generation>& next);

// Checks that a program has the dialect of the instance, so that it can replace its program or run beside it.
int32_t checkDialect(const rung_instance& instance, const rung_program& program) noexcept;

// RUNG_LATER with a sentence that explains `result`, the result of the instance.
int32_t failLater(const rung_instance& instance, runtime::ReplaceResult result,
                  const runtime::StateTransfer& transfer) noexcept;

// Functions of shadows.

// Reports a request of the running program to the shadow. Scan thread.
void shadowRequest(rung_instance& instance, const core::ServiceRequest& request) noexcept;
// Ends the instance's shadow.
void endShadow(rung_instance& instance) noexcept;

} // namespace rung::api
