// The value of an operation without effects, by the functions of sem.hpp. The constant folder and the interpreter both
// call it, so a folded operation cannot differ from one that ran.
//
// A value has the bits of its type in the low end of a uint64_t, zero above: a bit is 0 or 1, an f64 its IEEE bits.
#pragma once
#include <cstdint>

#include "ir/core/op_code.h"
#include "ir/core/type.h"

namespace rung::ir {

// The bits that a type has.
constexpr uint64_t valueMask(Type type) {
  const uint32_t width = bitWidth(type);
  return width >= 64 ? ~0ull : (1ull << width) - 1;
}

// `type` is the operation's T, `first` the type of its first operand; the number of `args` is that of the row.
uint64_t evalPure(OpCode code, Type type, Type first, const uint64_t* args);

} // namespace rung::ir
