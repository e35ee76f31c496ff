// See window.h.
#include "sim/fanuc/window.h"

#include <array>
#include <cmath>
#include <string_view>

#include "rtlib/nc/fanuc/services.h"
#include "rtlib/nc/fanuc/window_functions.h"

namespace rung::sim::fanuc {
namespace {

using namespace pmc;
using namespace nc::fanuc; // completion codes

constexpr int64_t kUnitsPerStep = 10; // 0.0001 mm in 0.001 mm
constexpr uint32_t kLastWorkOffset = 54;
constexpr uint32_t kOffsetKinds = 4;

// A request. Data are read and written in order.
struct Request {
  uint32_t code, length, number;
  int32_t attribute; // -1: all axes
  std::array<uint8_t, kWindowMaxLength> data = {};
};

Request requestOf(const core::ServiceRequest& asked, bool isWrite) {
  const auto at = [&](size_t i) { return static_cast<uint32_t>(asked.args[i]); };
  Request request{at(0), at(1), at(2), static_cast<int16_t>(at(3))};
  for (size_t i = 0; isWrite && i < kWindowMaxLength; ++i)
    request.data[i] = static_cast<uint8_t>(asked.args[kWriteDataAt + i / 4] >> 8 * (i % 4));
  return request;
}

class Answer {
public:
  // A value of 1, 2 or 4 bytes; one that does not fit ends the request.
  void put(int64_t value, uint32_t bytes) {
    const int64_t limit = int64_t{1} << (8 * bytes - 1);
    if (value < -limit || value >= 2 * limit || (bytes == 4 && value >= limit)) end = kWindowBadForm;
    if (size_ + bytes > data_.size()) end = kWindowBadForm;
    for (uint32_t i = 0; end == kWindowDone && i < bytes; ++i) data_[size_++] = static_cast<uint8_t>(value >> 8 * i);
  }
  void putText(std::string_view text) {
    for (const char c : text) put(static_cast<uint8_t>(c), 1);
  }
  void write(core::ServiceReply& reply, bool isWrite) const {
    reply.results[0] = end;
    if (isWrite) return;
    const uint32_t size = end == kWindowDone ? size_ : 0;
    reply.results[1] = size;
    for (uint32_t word = 0; word < kWindowWords; ++word) reply.results[kReadDataAt + word] = wordAt(4 * word, size);
  }

  WindowEnd end = kWindowDone;

private:
  // Up to four bytes from there on; of one or two bytes, with their sign.
  int64_t wordAt(uint32_t first, uint32_t size) const {
    uint32_t word = 0, bytes = 0;
    for (; bytes < 4 && first + bytes < size; ++bytes) word |= uint32_t{data_[first + bytes]} << 8 * bytes;
    if (first != 0 || bytes == 4) return static_cast<int32_t>(word);
    return bytes == 1 ? static_cast<int8_t>(word) : static_cast<int16_t>(word);
  }

  std::array<uint8_t, kWindowMaxLength> data_ = {};
  uint32_t size_ = 0;
};

int64_t valueIn(const Request& request, uint32_t at, uint32_t bytes) {
  uint32_t value = 0;
  for (uint32_t i = 0; i < bytes && at + i < kWindowMaxLength; ++i) value |= uint32_t{request.data[at + i]} << 8 * i;
  return bytes == 1   ? static_cast<int8_t>(value)
         : bytes == 2 ? static_cast<int16_t>(value)
                      : static_cast<int32_t>(value);
}

// Calls see(axis, index of the element) for the axes of the attribute. False if the axis does not exist.
template <class See>
bool forAxes(const Request& request, const Machine& machine, See see) {
  const auto count = static_cast<int32_t>(machine.axes.count());
  if (request.attribute != -1 && (request.attribute < 1 || request.attribute > count)) return false;
  if (request.attribute != -1) return see(static_cast<uint32_t>(request.attribute - 1), 0u), true;
  for (int32_t axis = 0; axis < count; ++axis) see(static_cast<uint32_t>(axis), static_cast<uint32_t>(axis));
  return true;
}

template <class Value>
void putAxes(const Request& request, const Machine& machine, Answer& answer, Value value) {
  const bool exists = forAxes(request, machine, [&](uint32_t axis, uint32_t) { answer.put(value(axis), 4); });
  if (!exists) answer.end = kWindowBadNumber;
}

int64_t steps(int64_t units) { return std::llround(static_cast<double>(units) / kUnitsPerStep); }

// The wanted length where it is a whole number of bytes of one value, else `otherwise`.
uint32_t bytesOf(const Request& request, uint32_t elements, uint32_t otherwise) {
  const uint32_t bytes = request.length / elements;
  return bytes * elements == request.length && (bytes == 1 || bytes == 2 || bytes == 4) ? bytes : otherwise;
}

// ---- tables --------------------------------------------------------------------------------------------------------

// The attribute of an offset counts from radius wear, the table from length.
uint32_t kindOf(const Request& r) { return kOffsetKinds - 1 - static_cast<uint32_t>(r.attribute); }
bool hasOffset(const Request& r) {
  return r.number >= 1 && r.number <= kToolOffsets && r.attribute >= 0 &&
         r.attribute < static_cast<int32_t>(kOffsetKinds);
}

void parameters(const Request& r, Machine& m, Answer& answer, bool isWrite) {
  Request axes = r;
  if (axes.attribute == 0) axes.attribute = 1; // a parameter without axes
  const uint32_t bytes = bytesOf(r, r.attribute == -1 ? m.axes.count() : 1, 4);
  const bool exists =
      r.number <= kMaxParameter && forAxes(axes, m, [&](uint32_t axis, uint32_t element) {
        if (isWrite)
          m.tables.set(Table::Parameter, r.number, axis, valueIn(r, element * bytes, bytes) * kTableScale);
        else
          answer.put(m.tables.parameter(r.number, axis), bytes);
      });
  if (!exists) answer.end = kWindowBadNumber;
}

void workOffsets(const Request& r, Machine& m, Answer& answer, bool isWrite) {
  const bool exists = r.number <= kLastWorkOffset && forAxes(r, m, [&](uint32_t axis, uint32_t element) {
                        if (isWrite)
                          m.tables.set(Table::WorkOffset, r.number, axis, valueIn(r, 4 * element, 4) * kUnitsPerStep);
                        else
                          answer.put(steps(m.tables.get(Table::WorkOffset, r.number, axis)), 4);
                      });
  if (!exists) answer.end = kWindowBadNumber;
}

void toolOffset(const Request& r, Machine& m, Answer& answer, bool isWrite) {
  if (!hasOffset(r))
    answer.end = kWindowBadNumber;
  else if (isWrite)
    m.tables.set(Table::ToolOffset, r.number - 1, kindOf(r), valueIn(r, 0, 4) * kUnitsPerStep);
  else
    answer.put(steps(m.tables.get(Table::ToolOffset, r.number - 1, kindOf(r))), 4);
}

// A value and its decimal places.
void macro(const Request& r, const Window& window, Answer& answer, bool isWrite) {
  constexpr int64_t kMostPlaces = 7, kPlacesOfTable = 4;
  const int64_t places = isWrite && r.length >= 6 ? valueIn(r, 4, 2) : r.attribute;
  const bool mayWrite = r.number >= 100 && r.number <= 999;
  if (isWrite ? !mayWrite : !window.machine.isMacro(r.number)) {
    answer.end = kWindowBadNumber;
  } else if (places < 0 || places > kMostPlaces) {
    answer.end = kWindowBadData;
  } else if (isWrite) {
    const double value =
        static_cast<double>(valueIn(r, 0, 4)) * std::pow(10.0, static_cast<double>(kPlacesOfTable - places));
    window.machine.setMacro(r.number, std::llround(value), window.io);
  } else {
    const auto value = static_cast<double>(window.machine.macro(r.number, window.io));
    answer.put(std::llround(value * std::pow(10.0, static_cast<double>(places - kPlacesOfTable))), 4);
    answer.put(places, 2);
  }
}

// ---- state ---------------------------------------------------------------------------------------------------------

void systemInformation(const Machine& m, Answer& answer) {
  answer.putText("30 MRUNG0001"); // type, kind, series, version
  answer.put('0', 1);
  answer.put('0' + static_cast<int64_t>(m.axes.count()), 1);
}

// One bit for each kind of alarms.
int64_t alarmBits(const Machine& m) {
  constexpr int64_t kProgram = 1 << 3, kOverTravel = 1 << 4, kExternal = 1 << 15;
  const AlarmNumbers& numbers = m.cnc->alarms;
  int64_t bits = m.messageAlarm ? kExternal : 0;
  for (const uint32_t alarm : m.alarms.active())
    bits |= alarm == numbers.overTravelPositive || alarm == numbers.overTravelNegative ? kOverTravel : kProgram;
  return bits;
}

// Year, month and day, or hour, minute and second, each two bytes: a clock that begins with the power-on at the
// beginning of the year 2000, so that every run is the same. Its first month suffices for any scenario.
void clock(const Request& r, uint64_t slots, Answer& answer) {
  constexpr uint64_t kDay = 24 * 60 * 60;
  const uint64_t seconds = slots * kSlotMs / 1000;
  const uint64_t ofDay = seconds % kDay;
  if (r.attribute < -1 || r.attribute > 1) return void(answer.end = kWindowBadData);
  if (r.attribute != 1)
    for (const uint64_t part : {uint64_t{2000}, uint64_t{1}, 1 + seconds / kDay})
      answer.put(static_cast<int64_t>(part), 2);
  if (r.attribute != 0)
    for (const uint64_t part : {ofDay / 3600, ofDay / 60 % 60, ofDay % 60}) answer.put(static_cast<int64_t>(part), 2);
}

void read(const Request& r, const Window& window, Answer& answer) {
  Machine& m = window.machine;
  switch (r.code) {
  case 0: return systemInformation(m, answer);
  case 13: return toolOffset(r, m, answer, false);
  case 15: return workOffsets(r, m, answer, false);
  case 17:
  case 154: return parameters(r, m, answer, false);
  case 21: return macro(r, window, answer, false);
  case 23: return answer.put(alarmBits(m), 2);
  case 24:
    answer.put(window.operation.programNumber(), 2);
    return answer.put(window.operation.programNumber(), 2); // there are no subprograms
  case 25: return answer.put(window.operation.sequence(), 4);
  case 26: return answer.put(std::llround(window.operation.speed()), bytesOf(r, 1, 2));
  case 27:
    return putAxes(r, m, answer,
                   [&](uint32_t axis) { return std::llround(window.operation.absolute(m, axis) * 1000); });
  case 28: return putAxes(r, m, answer, [&](uint32_t axis) { return steps(m.axes[axis].machine); });
  case 50: return answer.put(std::llround(std::fabs(m.spindle.actual())), bytesOf(r, 1, 2));
  case 74: return putAxes(r, m, answer, [&](uint32_t axis) { return steps(m.axes[axis].relative); });
  case 75: return putAxes(r, m, answer, [&](uint32_t axis) { return steps(window.operation.distanceToGo(m, axis)); });
  case 151: return clock(r, window.slots, answer);
  case 153: return answer.put(m.spindle.actual() != 0 ? 20 : 0, bytesOf(r, 1, 2)); // no load is modelled
  default: answer.end = kWindowBadData;
  }
}

void write(const Request& r, const Window& window, Answer& answer) {
  Machine& m = window.machine;
  switch (r.code) {
  case 14: return toolOffset(r, m, answer, true);
  case 16: return workOffsets(r, m, answer, true);
  case 18: return parameters(r, m, answer, true);
  case 22: return macro(r, window, answer, true);
  default: answer.end = kWindowBadData;
  }
}

} // namespace

void answerWindow(const core::ServiceRequest& asked, const Window& window, core::ServiceReply& reply) {
  const bool isWrite = static_cast<nc::pmc::ServiceKind>(asked.name->kind) == nc::pmc::ServiceKind::WriteWindow;
  const Request request = requestOf(asked, isWrite);
  const nc::pmc::WindowFunction* function = nc::pmc::findWindowFunction(windowFunctions(), request.code);
  Answer answer;
  if (function == nullptr || (function->access == nc::pmc::WindowAccess::Write) != isWrite)
    answer.end = kWindowNoFunction;
  else if (isWrite)
    write(request, window, answer);
  else
    read(request, window, answer);
  answer.write(reply, isWrite);
}

} // namespace rung::sim::fanuc
