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

} // namespace rung::api
