// Requested states of the master (see state_requests.h).
#include "machine/io/ethercat/state_requests.h"

namespace rung::io::ethercat {
namespace {

struct Request {
  bool StateBits::* bit;
  State state;
};
constexpr Request kRequests[] = {{&StateBits::initRequest, State::Init},
                                 {&StateBits::bootstrapRequest, State::Bootstrap},
                                 {&StateBits::preOperationalRequest, State::PreOperational},
                                 {&StateBits::safeOperationalRequest, State::SafeOperational},
                                 {&StateBits::operationalRequest, State::Operational}};

} // namespace

void StateRequests::reset(bool byProgram) noexcept {
  if (ticket_ != 0) master_.forget(ticket_);
  ticket_ = current_ = next_ = 0;
  byProgram_ = byProgram;
  startSeen_ = start_ = false;
}

// The bit stays set after the start, so that its rise alone counts.
void StateRequests::tick(StateBits& bits) noexcept {
  if (byProgram_ && bits.startCyclicOperation && !startSeen_) start_ = true;
  startSeen_ = bits.startCyclicOperation;
  finish(bits);
  if (ticket_ == 0) begin(bits);
  bits.isOperational = master_.state() == State::Operational;
}

void StateRequests::finish(StateBits& bits) noexcept {
  if (ticket_ == 0) return;
  const Answer answer = master_.poll(ticket_);
  if (!answer.isDone) return;
  master_.forget(ticket_);
  ticket_ = 0;
  const bool reached = answer.code == kDone;
  next_ = reached ? 0 : current_ + 1;
  if (current_ == kStart) start_ = false;
  if (reached && current_ != kStart) bits.*kRequests[current_].bit = false;
}

bool StateRequests::isWanted(uint32_t request, const StateBits& bits) const noexcept {
  return request == kStart ? start_ : bits.*kRequests[request].bit;
}

void StateRequests::begin(const StateBits& bits) noexcept {
  for (uint32_t i = 0; i <= kStart; ++i) {
    current_ = (next_ + i) % (kStart + 1);
    if (!isWanted(current_, bits)) continue;
    const State target = current_ == kStart ? State::Operational : kRequests[current_].state;
    ticket_ = master_.command({}, static_cast<uint32_t>(target));
    return;
  }
}

} // namespace rung::io::ethercat
