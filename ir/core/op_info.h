// The table of operations (ops.def) as data: the operands, results and effects of each. Used by verifier, printer,
// parser, builder, docs and the random generator. Interpreter and back ends treat all value operations by their row,
// and switch over the others without a default, so that the build fails where a new one is missing.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "ir/core/op_code.h"
#include "ir/core/type.h"

namespace rung::ir {

// What an operand or the result must be, in terms of the operation's own type T (`Op::type`).
enum class Constraint : uint8_t {
  None,     // no operand or result
  Same,     // T
  Bit,      // bit
  I32,      // i32
  I64,      // i64
  F64,      // f64
  Narrower, // bit or an integer narrower than T
  Wider,    // an integer wider than T
  AnyInt,   // any integer type but bit
  Any,      // any type
  Variadic, // last entry only: any number of operands of any types
};

// What follows the operands, and in which fields of Op.
enum class Attr : uint8_t {
  None,
  Literal,       // imm: the constant's bits
  Place,         // ref: space, imm: bit offset of the accessed bit or first byte in the space
  Window,        // ref: space, imm: bit offset of element 0, count: number of addressable elements
  Slot,          // ref: slot
  Count,         // count: iterations
  MessageOp,     // ref: enum rung_message_op
  Service,       // ref: service
  ResultNo,      // imm: index of the result
  Fault,         // ref: fault
  Text,          // ref: text in Rung::notes
  BranchWeights, // ref: enum BranchWeights
};

enum Effect : uint8_t {
  kPure = 0,
  kReads = 1,      // memory or slots; with kHost: the host may read any space, and no slot
  kWrites = 2,     // memory or slots
  kTraps = 4,      // may leave the rung
  kHost = 8,       // calls the host; order matters
  kStructure = 16, // opens, divides or closes a region
  kClock = 32,     // reads the clock, which is constant within a scan
};

using Operands = std::array<Constraint, 4>;
constexpr uint8_t countFixed(const Operands& operands) {
  uint8_t n = 0;
  for (Constraint c : operands) n += (c != Constraint::None && c != Constraint::Variadic) ? 1 : 0;
  return n;
}

struct OpInfo {
  OpCode code;
  std::string_view name;
  TypeSet types; // legal T; kNoTypes for an operation without a type
  Operands operands;
  Constraint result;
  Attr attr;
  uint8_t effects;                      // Effect
  std::string_view function;            // of sem.hpp, with `T` for the type; empty: not a value operation
  std::string_view doc;                 // one or two sentences, with the result of every unusual input
  uint8_t fixed = countFixed(operands); // number of operands, not counting a Variadic one
};

// In the order of OpCode; use `opInfo`.
extern const OpInfo kOpRows[];

inline const OpInfo& opInfo(OpCode code) { return kOpRows[static_cast<int>(code)]; }
std::span<const OpInfo> allOps();
// Null if there is no operation of this name.
const OpInfo* findOp(std::string_view name);

constexpr bool isVariadic(const OpInfo& info) {
  for (Constraint c : info.operands)
    if (c == Constraint::Variadic) return true;
  return false;
}
// Whether a value of type `actual` satisfies `constraint` for an operation of type `own`.
constexpr bool satisfies(Constraint constraint, Type own, Type actual) {
  switch (constraint) {
  case Constraint::None: return false;
  case Constraint::Same: return actual == own;
  case Constraint::Bit: return actual == Type::Bit;
  case Constraint::I32: return actual == Type::I32;
  case Constraint::I64: return actual == Type::I64;
  case Constraint::F64: return actual == Type::F64;
  case Constraint::Narrower: return actual != Type::F64 && bitWidth(actual) < bitWidth(own);
  case Constraint::Wider: return isInt(actual) && bitWidth(actual) > bitWidth(own);
  case Constraint::AnyInt: return isInt(actual);
  case Constraint::Any:
  case Constraint::Variadic: return true;
  }
  return false;
}
// The type of a result; None if there is no result or the row does not determine its type.
constexpr Type resultType(Constraint constraint, Type own) {
  switch (constraint) {
  case Constraint::Bit: return Type::Bit;
  case Constraint::I32: return Type::I32;
  case Constraint::I64: return Type::I64;
  case Constraint::F64: return Type::F64;
  case Constraint::Same: return own;
  case Constraint::None:
  case Constraint::Narrower:
  case Constraint::Wider:
  case Constraint::AnyInt:
  case Constraint::Any:
  case Constraint::Variadic: return Type::None;
  }
  return Type::None;
}
// Whether the host may read memory meanwhile: all stores above must have been executed, and none below.
constexpr bool hostReads(const OpInfo& info) { return (info.effects & kHost) != 0 && (info.effects & kReads) != 0; }
constexpr bool isPure(const OpInfo& info) { return info.effects == kPure || info.effects == kClock; }
// Whether it is a value operation, which evalPure computes: its value depends on its operands only.
constexpr bool isEvaluable(const OpInfo& info) { return !info.function.empty(); }
// Whether it does nothing but read for its result.
constexpr bool onlyReads(const OpInfo& info) { return isPure(info) || info.effects == kReads; }

} // namespace rung::ir
