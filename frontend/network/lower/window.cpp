// See window.h.
#include "frontend/network/lower/window.h"

#include <algorithm>
#include <array>

#include "frontend/lower/operations.h"

namespace rung::frontend::network {

using ir::Type;
using ir::ValueId;

using enum frontend::RequestState; // states of a low-speed function (P48); one with a request holds the lock

namespace {

// The answer is used in the second scan after the request at the earliest (P48).
constexpr uint32_t kAnswerAfterRuns = 2;
constexpr uint16_t kBits = 64;

} // namespace

// Result of one run of the instruction: the output, and an Answer.
struct WindowLowering::Step {
  ValueId out, finished, end, ticket, length;
};

ValueId WindowLowering::isOneOf(ValueId function, const std::vector<uint16_t>& codes) {
  uint64_t low = 0;
  for (const uint16_t code : codes)
    if (code < kBits) low |= uint64_t{1} << code;
  ValueId found = isIn(b_, function, low);
  for (const uint16_t code : codes)
    if (code >= kBits) found = b_.or_(found, b_.eq(function, b_.constant(Type::I16, code)));
  return found;
}

// End code of an answer. A host that answers with an error, or does not answer although it must, does not provide the
// function.
ValueId WindowLowering::endOf(ValueId ticket) {
  const ValueId executed = frontend::isExecuted(b_, ticket);
  const ValueId end = b_.and_(b_.serviceResult(ticket, 0), b_.constant(Type::I64, UINT16_MAX));
  return b_.select(executed, end, b_.constant(Type::I64, notProvided()));
}

void WindowLowering::release() {
  setState(kIdle);
  b_.slotStore(lock(), b_.bit(false));
}

WindowLowering::Step WindowLowering::nothing(ValueId out) {
  return {out, b_.bit(false), b_.constant(Type::I64, 0), b_.i32(0), b_.constant(Type::I16, 0)};
}

WindowLowering::Step WindowLowering::fork(ValueId condition, Step (WindowLowering::*yes)(),
                                          Step (WindowLowering::*no)()) {
  return b_.choose(condition, [&] { return (this->*yes)(); }, [&] { return (this->*no)(); });
}

void WindowLowering::run() {
  state_ = state();
  oldState_ = b_.slotLoad(state_);
  const ValueId idle = b_.eq(oldState_, b_.constant(Type::I8, kIdle));
  const Step step = fork(idle, &WindowLowering::begin, &WindowLowering::underWay);
  f_.setOutput(step.out);
  finish({step.finished, step.end, step.ticket, step.length});
}

// ---- a low-speed function that has begun ---------------------------------------------------------------------------

WindowLowering::Step WindowLowering::underWay() {
  return fork(b_.eq(oldState_, b_.constant(Type::I8, kDone)), &WindowLowering::whenDone, &WindowLowering::whenPending);
}

// ACT must become 0 once before the next call (man. l.3139, 8499).
WindowLowering::Step WindowLowering::whenDone() {
  b_.when(b_.not_(f_.act()), [&] { release(); });
  return nothing(f_.act());
}

WindowLowering::Step WindowLowering::whenPending() {
  const ValueId wanted = b_.and_(f_.act(), b_.eq(oldState_, b_.constant(Type::I8, kPending)));
  return fork(wanted, &WindowLowering::awaited, &WindowLowering::unwanted);
}

WindowLowering::Step WindowLowering::awaited() {
  const ValueId asked = b_.slotLoad(ticket());
  const ValueId there = frontend::isAnswered(b_, asked);
  const ValueId ripe = b_.leS(b_.i32(kAnswerAfterRuns), f_.runsSinceMark());
  const ValueId finished = b_.and_(there, ripe);
  b_.when(finished, [&] { setState(kDone); });
  return {finished, finished, endOf(asked), asked, b_.slotLoad(length())};
}

// The call was withdrawn: its answer is discarded and releases the lock when it arrives.
WindowLowering::Step WindowLowering::unwanted() {
  const ValueId there = frontend::isAnswered(b_, b_.slotLoad(ticket()));
  setState(kAbandoned);
  b_.when(there, [&] { release(); });
  return rest();
}

// ---- a new call ----------------------------------------------------------------------------------------------------

WindowLowering::Step WindowLowering::rest() { return nothing(b_.bit(false)); }

WindowLowering::Step WindowLowering::begin() { return fork(f_.act(), &WindowLowering::start, &WindowLowering::rest); }

// WINDW is always low speed (man. l.3152). A code that WINDR does not know has no speed and is refused at once.
WindowLowering::Step WindowLowering::start() {
  function_ = word(nc::pmc::kWindowFunctionAt);
  length_ = word(nc::pmc::kWindowLengthAt);
  refusal_ = refusal(function_, length_);
  if (writes()) return lowSpeed();
  const ValueId isLow = isOneOf(codeOf(function_), [](const nc::pmc::WindowFunction& f) {
    return f.access == nc::pmc::WindowAccess::Read && f.speed == nc::pmc::WindowSpeed::Low;
  });
  return fork(isLow, &WindowLowering::lowSpeed, &WindowLowering::immediate);
}

// High speed: completes in the scan of the call (man. l.8505).
WindowLowering::Step WindowLowering::immediate() {
  const auto ask = [&] {
    const ValueId asked = request(function_, length_);
    return std::array{endOf(asked), asked};
  };
  const auto [end, asked] = b_.choose(b_.eq(refusal_, b_.constant(Type::I64, kNoError)), ask,
                                      [&] { return std::array{refusal_, b_.i32(0)}; });
  return {b_.bit(true), b_.bit(true), end, asked, length_};
}

// Waits while another instruction has ACT=1, even if its OUT is 1 (man. l.8495-8501).
WindowLowering::Step WindowLowering::lowSpeed() {
  const ValueId free = b_.not_(b_.slotLoad(lock()));
  const ValueId good = b_.eq(refusal_, b_.constant(Type::I64, kNoError));
  const ValueId refused = b_.and_(free, b_.not_(good));
  b_.when(free, [&] { b_.slotStore(lock(), b_.bit(true)); });
  b_.when(b_.and_(free, good), [&] { ask(); });
  b_.when(refused, [&] { setState(kDone); });
  return {refused, refused, refusal_, b_.i32(0), length_};
}

void WindowLowering::ask() {
  b_.slotStore(ticket(), request(function_, length_));
  b_.slotStore(length(), length_);
  f_.markRun();
  setState(kPending);
}

} // namespace rung::frontend::network
