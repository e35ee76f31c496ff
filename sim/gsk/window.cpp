// The window requests.
#include "sim/gsk/window.h"

namespace rung::sim::gsk {

namespace {

constexpr uint32_t kLastWorkOffset = 54; // 0 EXT, 1-6 G54-G59, 7-54 G54.1 P1-P48 (l.8727)

bool fits(int64_t value, uint32_t length) {
  const int64_t limit = int64_t{1} << (8 * length - 1);
  return value >= -limit && value < limit;
}

// Whether the data number M exists; else the end code is 3.
bool numberExists(const WindowRequest& r) {
  switch (r.function) {
  case 1:
  case 2: return r.number < kToolOffsets;
  case 3:
  case 4: return r.number <= kLastWorkOffset;
  case 5:
  case 6: return r.number <= kMaxParameter;
  case 9:
    return (r.number >= 100 && r.number <= 999) || (r.number >= 1000 && r.number <= 1035) ||
           (r.number >= 1100 && r.number <= 1135);
  case 10: return r.number >= 100 && r.number <= 999; // l.8800
  case 11:
  case 12: return r.number <= kMaxPitch;
  case 31: return r.number <= 1;
  default: return true;
  }
}

// Whether the attribute N exists; else the end code is 4.
bool attributeExists(const WindowRequest& r, uint32_t axes) {
  switch (r.function) {
  case 1:
  case 2: return r.attribute <= 3;
  case 3:
  case 4:
  case 5:
  case 6: return r.attribute < axes;
  case 11:
  case 12: return r.attribute <= 1;
  case 17: return r.attribute >= 1 && r.attribute <= axes; // counts from 1 (l.8888)
  default: return true;
  }
}

WindowAnswer read(const WindowRequest& r, Machine& m, const nc::gsk::SignalsIo& io, uint32_t sequence) {
  switch (r.function) {
  case 1: return {nc::gsk::kWindowDone, m.tables.get(Table::ToolOffset, r.number, r.attribute)};
  case 3: return {nc::gsk::kWindowDone, m.tables.get(Table::WorkOffset, r.number, r.attribute)};
  case 5: return {nc::gsk::kWindowDone, m.tables.get(Table::Parameter, r.number, r.attribute)};
  case 9: return {nc::gsk::kWindowDone, m.macro(r.number, io)};
  case 11: return {nc::gsk::kWindowDone, m.tables.get(Table::Pitch, r.number, r.attribute)};
  case 14: return {nc::gsk::kWindowDone, int64_t{sequence} * kTableScale};
  case 17: return {nc::gsk::kWindowDone, m.axes[r.attribute - 1].machine / 10}; // 0.001 mm (l.8889)
  default: return {nc::gsk::kWindowNotProvided, 0};
  }
}

WindowAnswer write(const WindowRequest& r, Machine& m, const nc::gsk::SignalsIo& io) {
  switch (r.function) {
  case 2: m.tables.set(Table::ToolOffset, r.number, r.attribute, r.data); return {};
  case 4: m.tables.set(Table::WorkOffset, r.number, r.attribute, r.data); return {};
  case 6: m.tables.set(Table::Parameter, r.number, r.attribute, r.data); return {};
  case 10: m.setMacro(r.number, r.data, io); return {};
  case 12: m.tables.set(Table::Pitch, r.number, r.attribute, r.data); return {};
  case 31: m.tables.set(Table::Tool, r.number, 0, r.data); return {};
  default: return {nc::gsk::kWindowNotProvided, 0};
  }
}

} // namespace

// Errors are checked in the order of the end codes; 6 and 7 apply only if lower codes do not.
WindowAnswer answerWindow(const WindowRequest& request, Machine& machine, const nc::gsk::SignalsIo& io,
                          uint32_t sequence, bool locked) {
  const nc::gsk::WindowFunction* function = nc::gsk::findWindowFunction(request.function);
  if (function == nullptr || (function->access == nc::gsk::WindowAccess::Write) != request.write)
    return {nc::gsk::kWindowBadFunction, 0};
  if (!nc::gsk::isWindowLength(request.length)) return {nc::gsk::kWindowBadLength, 0};
  if (function->status != nc::gsk::WindowStatus::Open) return {nc::gsk::kWindowNotProvided, 0};
  if (!numberExists(request)) return {nc::gsk::kWindowBadCount, 0};
  if (!attributeExists(request, machine.axes.count())) return {nc::gsk::kWindowBadAttribute, 0};
  if (!request.write) {
    const WindowAnswer answer = read(request, machine, io, sequence);
    return answer.end == nc::gsk::kWindowDone && !fits(answer.data, request.length)
               ? WindowAnswer{nc::gsk::kWindowBadLength, 0}
               : answer;
  }
  if (!fits(request.data, request.length)) return {nc::gsk::kWindowBadData, 0};
  if (function->wholeOnly && request.data % function->scale != 0) return {nc::gsk::kWindowBadData, 0}; // l.8832, 8945
  if (function->code == 31 && request.data < 0) return {nc::gsk::kWindowBadData, 0};
  if (locked) return {nc::gsk::kWindowProtected, 0};
  return write(request, machine, io);
}

// External data input.

// Handshake: ESTC, then EREND when the data have been read, and ESEND when the function has been executed; both fall
// with ESTC.
void ExternalData::step(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation, bool resetting) {
  const bool start = io.g(13, 7);
  if (!start) phase_ = Phase::Idle;
  bool cancelled = io.f(60, 2) && start;
  if (start && phase_ == Phase::Idle && !resetting) {
    address_ = io.gByte(13) & 0x7F;
    data_ = io.gDword(0);
    phase_ = Phase::Read;
  } else if (phase_ == Phase::Read || phase_ == Phase::Waiting) {
    if (resetting && machine.tables.parameterBit(kParamExternal, 7)) { // l.7533-7537
      cancelled = true;
      phase_ = Phase::Done;
    } else {
      phase_ = carryOut(io, machine, operation) ? Phase::Done : Phase::Waiting;
    }
  }
  io.setF(60, 0, phase_ != Phase::Idle);
  io.setF(60, 1, phase_ == Phase::Done && !cancelled);
  io.setF(60, 2, cancelled);
}

// False: the function waits for its condition.
bool ExternalData::carryOut(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation) {
  const uint32_t kind = address_ >> 4;
  const uint32_t low = address_ & 0xF;
  const int64_t value = static_cast<int32_t>(data_);
  switch (kind) {
  case 0: { // program search, in an automatic mode at rest (l.7545)
    const Mode needed = io.g(85, 0) ? Mode::Mdi : Mode::Auto;
    if (operation.mode() != needed || operation.state() != RunState::Reset) return false;
    operation.select(data_, needed == Mode::Mdi);
    return true;
  }
  case 1: machine.tables.set(Table::ToolOffset, low, 0, value); return true;
  case 2: // the axis from 0 (P58)
    if (low < kAxes) machine.tables.set(Table::WorkOffset, 0, low, value);
    return true;
  case 6:
  case 7: ((low & 1) == 0 ? preset_ : parts_) = data_; return true;
  default: return true;
  }
}

} // namespace rung::sim::gsk
