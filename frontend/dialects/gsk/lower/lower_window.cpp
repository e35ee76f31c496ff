// Window functions: data of the CNC, accessed through a control block (§8; man. l.3089-3239, 8482-8682).
#include <algorithm>
#include <array>

#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/lower/operations.h"
#include "rtlib/nc/gsk/services.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::frontend::gsk {
namespace {

using ir::Type;
using ir::ValueId;
namespace window = nc::gsk;

using enum frontend::RequestState; // states of a low-speed function (P48); one with a request holds the lock
// The answer is used in the second scan after the request at the earliest (P48).
constexpr uint32_t kAnswerAfterRuns = 2;

// Result of one run of the instruction. If `finished`, end code, data and result are stored in the block.
struct Step {
  ValueId out, finished, end, data, length;
};

class WindowLowering {
public:
  explicit WindowLowering(Lowering& f) : f_(f), b_(f.b) {}
  void run();

private:
  bool writes() const { return f_.variant() == kWindowWrite; }
  network::Address at(uint32_t offset) const { return plus(f_.param(0).address, offset); }
  ValueId word(uint32_t offset) { return f_.load(Type::I16, at(offset)); }
  ir::SlotId ticket() { return f_.slot("ticket", Type::I32); }
  ir::SlotId length() { return f_.slot("length", Type::I16); }
  // One lock for all low-speed functions of the program. The instruction that holds it has a state other than idle:
  // when a program is replaced, the key shows that a removed instruction held the lock (rtlib/change/state_transfer.h).
  static constexpr const char* kLock = "@window/lock";
  ir::SlotId lock() { return f_.shared(kLock, Type::Bit); }
  ir::SlotId state() { return f_.slot(std::string("state") + kLock, Type::I8); }

  uint32_t room() const;
  ValueId refusal(ValueId function, ValueId length);
  ValueId dataToWrite(ValueId length);
  ValueId request(ValueId function, ValueId length);
  ValueId endOf(ValueId ticket);
  void setState(uint8_t state) { b_.slotStore(state_, b_.constant(Type::I8, state)); }
  void release();

  Step nothing(ValueId out);
  Step fork(ValueId condition, Step (WindowLowering::*yes)(), Step (WindowLowering::*no)());
  Step underWay();
  Step whenDone();
  Step whenPending();
  Step awaited();
  Step unwanted();
  Step begin();
  Step start();
  Step immediate();
  Step lowSpeed();
  void ask();
  Step rest() { return nothing(b_.bit(false)); }
  void finish(const Step& step);

  Lowering& f_;
  ir::RungBuilder& b_;
  ir::SlotId state_;
  ValueId oldState_, function_, length_, refusal_;
};

// The set of functions for which `belongs` is true, as bits by function code.
template <class Belongs>
uint64_t setOf(Belongs belongs) {
  uint64_t set = 0;
  for (const nc::pmc::WindowFunction& function : window::windowFunctions())
    if (belongs(function)) set |= uint64_t{1} << function.code;
  return set;
}

// Bytes from the data to the end of the area, limited to the longest data; parameters.cpp ensures at least one.
uint32_t WindowLowering::room() const {
  const network::Address data = at(nc::pmc::kWindowDataAt);
  return std::min(kLanguage.at(data.area).bytes - data.byte, window::kWindowMaxLength);
}

// P49: end code of a request that is refused without asking the CNC. Data beyond the end of the area have no valid
// length (end code 2, man. l.8671).
ValueId WindowLowering::refusal(ValueId function, ValueId length) {
  const auto access = writes() ? nc::pmc::WindowAccess::Write : nc::pmc::WindowAccess::Read;
  const uint64_t known = setOf([&](const auto& f) { return f.access == access; });
  const uint64_t closed = setOf([](const auto& f) { return f.status == nc::pmc::WindowStatus::ClosedInList; });
  uint64_t lengths = 0;
  for (uint32_t bytes = 1; bytes <= room(); ++bytes)
    if (window::isWindowLength(bytes)) lengths |= uint64_t{1} << bytes;
  const auto code = [&](uint16_t end) { return b_.constant(Type::I64, end); };
  const ValueId badLength =
      b_.select(isIn(b_, length, lengths), code(window::kWindowDone), code(window::kWindowBadLength));
  const ValueId badStatus = b_.select(isIn(b_, function, closed), code(window::kWindowNotProvided), badLength);
  return b_.select(isIn(b_, function, known), badStatus, code(window::kWindowBadFunction));
}

ValueId WindowLowering::dataToWrite(ValueId length) {
  ValueId data = b_.sextOrTrunc(Type::I64, f_.load(Type::I8, at(nc::pmc::kWindowDataAt)));
  for (uint32_t bytes : {2u, 4u}) {
    if (bytes > room()) break;
    const ValueId wider = b_.sextOrTrunc(Type::I64, f_.load(ir::intOfBytes(bytes), at(nc::pmc::kWindowDataAt)));
    data = b_.select(b_.eq(length, b_.constant(Type::I16, bytes)), wider, data);
  }
  return data;
}

ValueId WindowLowering::request(ValueId function, ValueId length) {
  const auto raw = [&](ValueId value) { return b_.zextOrTrunc(Type::I64, value); };
  std::vector<ValueId> args{raw(function), raw(length), raw(word(nc::pmc::kWindowNumberAt)),
                            raw(word(nc::pmc::kWindowAttributeAt))};
  if (writes()) args.push_back(dataToWrite(length));
  const auto kind = writes() ? nc::pmc::ServiceKind::WriteWindow : nc::pmc::ServiceKind::ReadWindow;
  return b_.serviceRequest(f_.service(nc::gsk::service(kind)), args);
}

// End code of an answer. A host that answers with an error, or does not answer although it must, does not provide the
// function.
ValueId WindowLowering::endOf(ValueId ticket) {
  const ValueId executed = frontend::isExecuted(b_, ticket);
  const ValueId end = b_.and_(b_.serviceResult(ticket, 0), b_.constant(Type::I64, UINT16_MAX));
  return b_.select(executed, end, b_.constant(Type::I64, window::kWindowNotProvided));
}

void WindowLowering::release() {
  setState(kIdle);
  b_.slotStore(lock(), b_.bit(false));
}

Step WindowLowering::nothing(ValueId out) {
  const ValueId none = b_.constant(Type::I64, 0);
  return {out, b_.bit(false), none, none, b_.constant(Type::I16, 0)};
}

Step WindowLowering::fork(ValueId condition, Step (WindowLowering::*yes)(), Step (WindowLowering::*no)()) {
  return b_.choose(condition, [&] { return (this->*yes)(); }, [&] { return (this->*no)(); });
}

void WindowLowering::run() {
  state_ = state();
  oldState_ = b_.slotLoad(state_);
  const ValueId idle = b_.eq(oldState_, b_.constant(Type::I8, kIdle));
  finish(fork(idle, &WindowLowering::begin, &WindowLowering::underWay));
}

// ---- a low-speed function that has begun ---------------------------------------------------------------------------

Step WindowLowering::underWay() {
  return fork(b_.eq(oldState_, b_.constant(Type::I8, kDone)), &WindowLowering::whenDone, &WindowLowering::whenPending);
}

// ACT must become 0 once before the next call (man. l.3139, 8499).
Step WindowLowering::whenDone() {
  b_.when(b_.not_(f_.act()), [&] { release(); });
  return nothing(f_.act());
}

Step WindowLowering::whenPending() {
  const ValueId wanted = b_.and_(f_.act(), b_.eq(oldState_, b_.constant(Type::I8, kPending)));
  return fork(wanted, &WindowLowering::awaited, &WindowLowering::unwanted);
}

Step WindowLowering::awaited() {
  const ValueId asked = b_.slotLoad(ticket());
  const ValueId there = frontend::isAnswered(b_, asked);
  const ValueId ripe = b_.leS(b_.i32(kAnswerAfterRuns), f_.runsSinceMark());
  const ValueId finished = b_.and_(there, ripe);
  b_.when(finished, [&] { setState(kDone); });
  return {finished, finished, endOf(asked), b_.serviceResult(asked, 1), b_.slotLoad(length())};
}

// The call was withdrawn: its answer is discarded and releases the lock when it arrives.
Step WindowLowering::unwanted() {
  const ValueId there = frontend::isAnswered(b_, b_.slotLoad(ticket()));
  setState(kAbandoned);
  b_.when(there, [&] { release(); });
  return rest();
}

// ---- a new call ----------------------------------------------------------------------------------------------------

Step WindowLowering::begin() { return fork(f_.act(), &WindowLowering::start, &WindowLowering::rest); }

// WINDW is always low speed (man. l.3152). A code that WINDR does not know has no speed and is refused at once.
Step WindowLowering::start() {
  function_ = word(nc::pmc::kWindowFunctionAt);
  length_ = word(nc::pmc::kWindowLengthAt);
  refusal_ = refusal(function_, length_);
  if (writes()) return lowSpeed();
  const uint64_t low = setOf([](const nc::pmc::WindowFunction& f) {
    return f.access == nc::pmc::WindowAccess::Read && f.speed == nc::pmc::WindowSpeed::Low;
  });
  return fork(isIn(b_, function_, low), &WindowLowering::lowSpeed, &WindowLowering::immediate);
}

// High speed: completes in the scan of the call (man. l.8505).
Step WindowLowering::immediate() {
  const auto ask = [&] {
    const ValueId asked = request(function_, length_);
    return std::array{endOf(asked), b_.serviceResult(asked, 1)};
  };
  const auto [end, data] = b_.choose(b_.eq(refusal_, b_.constant(Type::I64, window::kWindowDone)), ask,
                                     [&] { return std::array{refusal_, b_.constant(Type::I64, 0)}; });
  return {b_.bit(true), b_.bit(true), end, data, length_};
}

// Waits while another instruction has ACT=1, even if its OUT is 1 (man. l.8495-8501).
Step WindowLowering::lowSpeed() {
  const ValueId free = b_.not_(b_.slotLoad(lock()));
  const ValueId good = b_.eq(refusal_, b_.constant(Type::I64, window::kWindowDone));
  const ValueId refused = b_.and_(free, b_.not_(good));
  b_.when(free, [&] { b_.slotStore(lock(), b_.bit(true)); });
  b_.when(b_.and_(free, good), [&] { ask(); });
  b_.when(refused, [&] { setState(kDone); });
  return {refused, refused, refusal_, b_.constant(Type::I64, 0), length_};
}

void WindowLowering::ask() {
  b_.slotStore(ticket(), request(function_, length_));
  b_.slotStore(length(), length_);
  f_.markRun();
  setState(kPending);
}

// P47: bit 0 of the result reports an error. Data are valid only with end code 0 (man. l.8665).
void WindowLowering::finish(const Step& step) {
  f_.setOutput(step.out);
  b_.when(step.finished, [&] {
    f_.store(at(nc::pmc::kWindowEndAt), b_.zextOrTrunc(Type::I16, step.end));
    const ValueId good = b_.eq(step.end, b_.constant(Type::I64, window::kWindowDone));
    f_.store(f_.param(1).address, b_.zextOrTrunc(Type::I8, b_.not_(good)));
    if (writes()) return;
    for (uint32_t bytes : {1u, 2u, 4u}) {
      if (bytes > room()) break;
      b_.when(b_.and_(good, b_.eq(step.length, b_.constant(Type::I16, bytes))),
              [&] { f_.store(at(nc::pmc::kWindowDataAt), b_.zextOrTrunc(ir::intOfBytes(bytes), step.data)); });
    }
  });
}

} // namespace

void lowerWindow(Lowering& f) { WindowLowering(f).run(); }

} // namespace rung::frontend::gsk
