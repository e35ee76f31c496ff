// Requests to the control that last several runs of the instruction.
#pragma once
#include "ir/core/builder.h"

namespace rung::frontend {

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
