// What the lowerings of dialects compute alike: arithmetic, comparisons, edges, requests.
#pragma once
#include "ir/core/builder.h"

namespace rung::frontend {

// Instructions that compute a value of two of one type: the variants of their rows, and the operations.

enum Arithmetic : int { kAdd, kSubtract, kMultiply, kDivide };
enum Logic : int { kAnd, kOr, kXor };

// Of integers with their signs, modulo their width, or of floating-point numbers.
ir::ValueId compute(ir::RungBuilder& b, int arithmetic, ir::ValueId x, ir::ValueId y);
// Of bits, or of integers bit by bit.
ir::ValueId combine(ir::RungBuilder& b, int logic, ir::ValueId x, ir::ValueId y);

// Comparisons of two values of one type: integers with their signs, or floating-point numbers.

enum Relation : int { kLess, kLessEqual, kEqual, kNotEqual, kGreaterEqual, kGreater };

// With a NaN only kNotEqual holds.
ir::ValueId compare(ir::RungBuilder& b, int relation, ir::ValueId x, ir::ValueId y);

// Edges: what a bit is now against what it was when the instruction ran last. The former value is in a slot of the
// instruction, or where the dialect's manual puts it.

enum Edge : int { kRising, kFalling };

// Gives the slot a new value, and what it held before.
inline ir::ValueId exchange(ir::RungBuilder& b, ir::SlotId slot, ir::ValueId value) {
  const ir::ValueId before = b.slotLoad(slot);
  b.slotStore(slot, value);
  return before;
}

inline ir::ValueId edge(ir::RungBuilder& b, ir::ValueId before, ir::ValueId now, int which = kRising) {
  return which == kRising ? b.and_(now, b.not_(before)) : b.and_(before, b.not_(now));
}

// The edge since the last run of the instruction, which remembers the value.
inline ir::ValueId pulse(ir::RungBuilder& b, ir::SlotId slot, ir::ValueId now, int which = kRising) {
  return edge(b, exchange(b, slot, now), now, which);
}

// Requests to the control that last several runs of the instruction.

// Where such an instruction is. How it goes from one to the next is for the dialect's manual to say.
enum RequestState : uint8_t {
  kIdle,
  kPending,   // asked
  kDone,      // answered; what asks has not been taken away since
  kAbandoned, // what asks was taken away while the request was pending; the answer will be thrown away
};

inline ir::ValueId isAnswered(ir::RungBuilder& b, ir::ValueId ticket) {
  return b.ne(b.servicePoll(ticket), b.i32(RUNG_SERVICE_PENDING));
}

// Answered, and not with an error; the results are there.
inline ir::ValueId isExecuted(ir::RungBuilder& b, ir::ValueId ticket) {
  return b.eq(b.servicePoll(ticket), b.i32(RUNG_SERVICE_DONE));
}

} // namespace rung::frontend
