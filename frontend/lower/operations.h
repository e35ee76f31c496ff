// Operations that the lowerings of several dialects share: arithmetic, comparisons, edges, requests.
#pragma once
#include "ir/core/builder.h"

namespace rung::frontend {

// Instructions that compute a value from two of the same type: the variants of their rows, and the operations.

enum Arithmetic : int { kAdd, kSubtract, kMultiply, kDivide };
enum Logic : int { kAnd, kOr, kXor };

// For signed integers, modulo their width, or for floating-point numbers.
ir::ValueId compute(ir::RungBuilder& b, int arithmetic, ir::ValueId x, ir::ValueId y);
// For bits, or for integers bit by bit.
ir::ValueId combine(ir::RungBuilder& b, int logic, ir::ValueId x, ir::ValueId y);

// Comparisons of two values of the same type: signed integers or floating-point numbers.

enum Relation : int { kLess, kLessEqual, kEqual, kNotEqual, kGreaterEqual, kGreater };

// With a NaN only kNotEqual holds.
ir::ValueId compare(ir::RungBuilder& b, int relation, ir::ValueId x, ir::ValueId y);

// Edges: a bit compared with its value at the last run of the instruction. The former value is in a slot of the
// instruction, or where the dialect's manual puts it.

enum Edge : int { kRising, kFalling };

// Stores a new value in the slot, and returns the former one.
inline ir::ValueId exchange(ir::RungBuilder& b, ir::SlotId slot, ir::ValueId value) {
  const ir::ValueId before = b.slotLoad(slot);
  b.slotStore(slot, value);
  return before;
}

inline ir::ValueId edge(ir::RungBuilder& b, ir::ValueId before, ir::ValueId now, int which = kRising) {
  return which == kRising ? b.and_(now, b.not_(before)) : b.and_(before, b.not_(now));
}

// The edge since the last run of the instruction; stores the value.
inline ir::ValueId pulse(ir::RungBuilder& b, ir::SlotId slot, ir::ValueId now, int which = kRising) {
  return edge(b, exchange(b, slot, now), now, which);
}

// Requests to the control that take several runs of the instruction.

// The state of such an instruction. The dialect's manual defines the transitions.
enum RequestState : uint8_t {
  kIdle,
  kPending,   // sent
  kDone,      // answered; the condition has been on since
  kAbandoned, // the condition went off while the request was pending; the answer will be discarded
};

inline ir::ValueId isAnswered(ir::RungBuilder& b, ir::ValueId ticket) {
  return b.ne(b.servicePoll(ticket), b.i32(RUNG_SERVICE_PENDING));
}

// Whether the request was answered without an error; the results are available.
inline ir::ValueId isExecuted(ir::RungBuilder& b, ir::ValueId ticket) {
  return b.eq(b.servicePoll(ticket), b.i32(RUNG_SERVICE_DONE));
}

} // namespace rung::frontend
