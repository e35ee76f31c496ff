// The window requests.
#include "sim/gsk/window.h"

#include "rtlib/nc/gsk/window_functions.h"

namespace rung::sim::gsk {

namespace {

using namespace pmc;

struct WindowRequest {
  bool write = false;
  uint32_t function = 0;
  uint32_t length = 0;
  uint32_t number = 0;
  uint32_t attribute = 0;
  int64_t data = 0;
};

struct WindowAnswer {
  nc::gsk::WindowEnd end = nc::gsk::kWindowDone;
  int64_t data = 0;
};

constexpr uint32_t kLastWorkOffset = 54; // 0 EXT, 1-6 G54-G59, 7-54 G54.1 P1-P48 (l.8727)

bool fits(int64_t value, uint32_t length) {
  const int64_t limit = int64_t{1} << (8 * length - 1);
  return value >= -limit && value < limit;
}

// Whether the data number M exists; else the end code is 3.
bool numberExists(const WindowRequest& r, const Machine& m) {
  switch (r.function) {
  case 1:
  case 2: return r.number < kToolOffsets;
  case 3:
  case 4: return r.number <= kLastWorkOffset;
  case 5:
  case 6: return r.number <= kMaxParameter;
  case 9: return m.isMacro(r.number);
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

WindowAnswer read(const WindowRequest& r, Machine& m, const nc::pmc::SignalsIo& io, uint32_t sequence) {
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

WindowAnswer write(const WindowRequest& r, Machine& m, const nc::pmc::SignalsIo& io) {
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

// Errors are checked in the order of the end codes; 6 and 7 apply only if lower codes do not.
WindowAnswer answerTo(const WindowRequest& request, const Window& window) {
  Machine& machine = window.machine;
  const nc::pmc::WindowFunction* function = nc::pmc::findWindowFunction(nc::gsk::windowFunctions(), request.function);
  if (function == nullptr || (function->access == nc::pmc::WindowAccess::Write) != request.write)
    return {nc::gsk::kWindowBadFunction, 0};
  if (!nc::gsk::isWindowLength(request.length)) return {nc::gsk::kWindowBadLength, 0};
  if (function->status != nc::pmc::WindowStatus::Open) return {nc::gsk::kWindowNotProvided, 0};
  if (!numberExists(request, machine)) return {nc::gsk::kWindowBadCount, 0};
  if (!attributeExists(request, machine.axes.count())) return {nc::gsk::kWindowBadAttribute, 0};
  if (!request.write) {
    const WindowAnswer answer = read(request, machine, window.io, window.operation.sequence());
    return answer.end == nc::gsk::kWindowDone && !fits(answer.data, request.length)
               ? WindowAnswer{nc::gsk::kWindowBadLength, 0}
               : answer;
  }
  if (!fits(request.data, request.length)) return {nc::gsk::kWindowBadData, 0};
  if (function->wholeOnly && request.data % function->scale != 0) return {nc::gsk::kWindowBadData, 0}; // l.8832, 8945
  if (function->code == 31 && request.data < 0) return {nc::gsk::kWindowBadData, 0};
  if (window.locked) return {nc::gsk::kWindowProtected, 0};
  return write(request, machine, window.io);
}

} // namespace

void answerWindow(const core::ServiceRequest& request, const Window& window, core::ServiceReply& reply) {
  const auto at = [&](size_t i) { return static_cast<uint32_t>(request.args[i]); };
  const bool isWrite = static_cast<nc::pmc::ServiceKind>(request.name->kind) == nc::pmc::ServiceKind::WriteWindow;
  const WindowAnswer answer = answerTo({isWrite, at(0), at(1), at(2), at(3), isWrite ? request.args[4] : 0}, window);
  reply.results[0] = answer.end;
  if (!isWrite) reply.results[1] = answer.data;
}

} // namespace rung::sim::gsk
