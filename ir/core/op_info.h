// The table of operations: what each takes, gives and does. Verifier, printer, parser, builder, docs and the random
// generator read it; engines switch over OpCode without a default, so a new name stops the build where it is missing.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "ir/core/type.h"

namespace rung::ir {

enum class OpCode : uint8_t {
#define RUNG_OP(name, text) name,
#include "ir/core/ops.def"
};

inline constexpr int kOpCount = 0
#define RUNG_OP(name, text) +1 // NOLINT(bugprone-macro-parentheses): a sum is made of them
#include "ir/core/ops.def"
    ;

// What an operand or the result must be, in terms of the operation's own type T (`Op::type`).
enum class Constraint : uint8_t {
  None,     // not there
  Same,     // T
  Bit,      // bit
  I32,      // i32
  I64,      // i64
  F64,      // f64
  Narrower, // bit or an integer narrower than T
  Wider,    // an integer wider than T
  AnyInt,   // any integer type but bit
  Any,      // any type
  Variadic, // last entry only: any number of operands, each of any type
};

// What follows the operands, and which fields of Op carry it.
enum class Attr : uint8_t {
  None,
  Literal,   // imm: the constant's bits
  Place,     // ref: space, imm: bit offset of the accessed bit or first byte in the space
  Window,    // ref: space, imm: bit offset of element 0, count: elements that may be addressed
  Slot,      // ref: slot
  Count,     // count: iterations
  MessageOp, // ref: enum rung_message_op
  Service,   // ref: service
  ResultNo,  // imm: index of the result
  Fault,     // ref: fault
  Text,      // ref: text in Rung::notes
  Odds,      // ref: enum Odds
};

// How often the condition of an if is 1 where it is reached. Only the order of the code depends on it.
enum Odds : uint8_t {
  kEven = 0, // nothing is known
  kMostly = 1,
  kSeldom = 2,
};

enum Effect : uint8_t {
  kPure = 0,
  kReads = 1,      // memory or slots; with kHost: the host may read any space, and no slot
  kWrites = 2,     // memory or slots
  kTraps = 4,      // may leave the rung
  kHost = 8,       // calls the host; order matters
  kStructure = 16, // opens, divides or closes a region
  kClock = 32,     // fixed within a scan
};

struct OpInfo {
  OpCode code;
  std::string_view name;
  TypeSet types; // legal T; kNoTypes where the operation has no type
  std::array<Constraint, 4> operands;
  Constraint result;
  Attr attr;
  uint8_t effects;      // Effect
  std::string_view doc; // one or two sentences, with the result of every odd input
};

const OpInfo& opInfo(OpCode code);
std::span<const OpInfo> allOps();
// Null when there is no operation of this name.
const OpInfo* findOp(std::string_view name);

// Fixed operands of the row, without a Variadic one.
constexpr int fixedOperands(const OpInfo& info) {
  int n = 0;
  for (Constraint c : info.operands) n += (c != Constraint::None && c != Constraint::Variadic) ? 1 : 0;
  return n;
}
constexpr bool isVariadic(const OpInfo& info) {
  for (Constraint c : info.operands)
    if (c == Constraint::Variadic) return true;
  return false;
}
// Whether a value of type `actual` satisfies `constraint` for an operation of type `own`.
bool satisfies(Constraint constraint, Type own, Type actual);
// The type of a result; None where there is none or the row does not fix it.
Type resultType(Constraint constraint, Type own);
// Whether the host may look at memory meanwhile: every store above must have been done, and none below.
constexpr bool hostReads(const OpInfo& info) { return (info.effects & kHost) != 0 && (info.effects & kReads) != 0; }
constexpr bool isPure(const OpInfo& info) { return info.effects == kPure || info.effects == kClock; }
// Nothing but reading to do for the result.
constexpr bool onlyReads(const OpInfo& info) { return isPure(info) || info.effects == kReads; }

} // namespace rung::ir
