// Window requests (see window.h).
#include "tools/sim/gsk/window.h"

namespace rung::nc::gsk {
namespace {

constexpr uint32_t kLastWorkOffset = 54; // 0 EXT, 1-6 G54-G59, 7-54 G54.1 P1-P48 (l.8727)

bool fits(int64_t value, uint32_t length) {
  const int64_t limit = int64_t{1} << (8 * length - 1);
  return value >= -limit && value < limit;
}

// The data number M: 3 where there is no such cell.
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

// The attribute N: 4 where there is none such.
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

WindowAnswer read(const WindowRequest& r, Machine& m, const SignalsIo& io, uint32_t sequence) {
  switch (r.function) {
  case 1: return {kWindowDone, m.tables.get(Table::ToolOffset, r.number, r.attribute)};
  case 3: return {kWindowDone, m.tables.get(Table::WorkOffset, r.number, r.attribute)};
  case 5: return {kWindowDone, m.tables.get(Table::Parameter, r.number, r.attribute)};
  case 9: return {kWindowDone, m.macro(r.number, io)};
  case 11: return {kWindowDone, m.tables.get(Table::Pitch, r.number, r.attribute)};
  case 14: return {kWindowDone, int64_t{sequence} * kTableScale};
  case 17: return {kWindowDone, m.axes[r.attribute - 1].machine / 10}; // 0.001 mm (l.8889)
  default: return {kWindowNotProvided, 0};
  }
}

WindowAnswer write(const WindowRequest& r, Machine& m, const SignalsIo& io) {
  switch (r.function) {
  case 2: m.tables.set(Table::ToolOffset, r.number, r.attribute, r.data); return {};
  case 4: m.tables.set(Table::WorkOffset, r.number, r.attribute, r.data); return {};
  case 6: m.tables.set(Table::Parameter, r.number, r.attribute, r.data); return {};
  case 10: m.setMacro(r.number, r.data, io); return {};
  case 12: m.tables.set(Table::Pitch, r.number, r.attribute, r.data); return {};
  case 31: m.tables.set(Table::Tool, r.number, 0, r.data); return {};
  default: return {kWindowNotProvided, 0};
  }
}

} // namespace

// Errors in the order of the end codes' numbers; 6 and 7 where the codes before them do not apply.
WindowAnswer answerWindow(const WindowRequest& request, Machine& machine, const SignalsIo& io, uint32_t sequence,
                          bool locked) {
  const WindowFunction* function = findWindowFunction(request.function);
  if (function == nullptr || (function->access == WindowAccess::Write) != request.write) return {kWindowBadFunction, 0};
  if (!isWindowLength(request.length)) return {kWindowBadLength, 0};
  if (function->status != WindowStatus::Open) return {kWindowNotProvided, 0};
  if (!numberExists(request)) return {kWindowBadCount, 0};
  if (!attributeExists(request, machine.axes.count())) return {kWindowBadAttribute, 0};
  if (!request.write) {
    const WindowAnswer answer = read(request, machine, io, sequence);
    return answer.end == kWindowDone && !fits(answer.data, request.length) ? WindowAnswer{kWindowBadLength, 0} : answer;
  }
  if (!fits(request.data, request.length)) return {kWindowBadData, 0};
  if (function->wholeOnly && request.data % function->scale != 0) return {kWindowBadData, 0}; // l.8832, 8945
  if (function->code == 31 && request.data < 0) return {kWindowBadData, 0};
  if (locked) return {kWindowProtected, 0};
  return write(request, machine, io);
}

} // namespace rung::nc::gsk
