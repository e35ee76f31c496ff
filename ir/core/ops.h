// The names of operations. Who includes this is compiled again for every new operation; who only hands codes on
// includes op_code.h, who asks what an operation is, op_info.h.
#pragma once
#include <cstdint>

#include "ir/core/op_code.h"

namespace rung::ir {

enum class OpCode : uint8_t {
#define RUNG_OP(name, text) name,
#include "ir/core/ops.def"
};

inline constexpr int kOpCount = 0
#define RUNG_OP(name, text) +1 // NOLINT(bugprone-macro-parentheses): a sum is made of them
#include "ir/core/ops.def"
    ;

} // namespace rung::ir
