// The names of operations. A file that includes this is recompiled for every new operation; one that only passes codes
// on includes op_code.h, and one that needs the properties of an operation includes op_info.h.
#pragma once
#include <cstdint>

#include "ir/core/op_code.h"

namespace rung::ir {

enum class OpCode : uint8_t {
#define RUNG_OP(code, ...) code,
#include "ir/core/ops.def"
};

inline constexpr int kOpCount = 0
#define RUNG_OP(code, ...) +1 // NOLINT(bugprone-macro-parentheses): a sum is made of them
#include "ir/core/ops.def"
    ;

} // namespace rung::ir
