// Instructions of axes.
#include "machine/io/axes/axis_requests.h"

#include "machine/io/analog/analog.h"
#include "machine/io/axes/motion.h"
#include "machine/io/device_call.h"
#include "rtlib/nc/control/technol/cells.h"

namespace rung::io {

namespace {

using enum ServiceKind;

// Ranges of arguments that may come from a cell, of the services `first` to `last`.
struct Limit {
  ServiceKind first, last;
  uint8_t argument;
  int64_t least, most;
};
constexpr auto kMostRole = static_cast<int64_t>(SpindleRole::Assistant);
constexpr Limit kLimits[] = {
    {AnalogPort, AnalogPort, 0, 1, kAnalogPorts},
    {AnalogOfAxis, AnalogOfAxis, 1, 1, kMaxAxes},
    {AnalogOfAxis, AnalogOfAxis, 2, 0, kMostRole},
    {AnalogSpindle, AnalogSpindle, 1, 1, kMaxAxes},
    {ToSpindle, MainSpindle, 0, 1, kMaxAxes},
    {ToSpindle, ToSpindle, 1, nc::technol::kFirstSpindleWord, kMostRole},
    {ToAxis, ToAxis, 4, 1, kMaxAxes},
    {RegulatorX, Regulator6, 0, 1, kRegulatorSets},
    {PositionInit, PositionReset, 0, 1, kMaxAxes},
    {PositionInit, PositionInit, 1, 0, kLastSpace},
    {PositionMode, PositionControl, 2, 1, kMaxAxes},
};

} // namespace

std::optional<WrongOperand> outOfRange(const core::ServiceRequest& request) {
  const ServiceKind kind = kindOf(request);
  for (const Limit& limit : kLimits) {
    if (kind < limit.first || kind > limit.last) continue;
    const int64_t value = request.args[limit.argument];
    if (value == nc::technol::kNotGiven || (value >= limit.least && value <= limit.most)) continue;
    return WrongOperand{nc::technol::deviceService(kind).service.arguments[limit.argument].name, value};
  }
  return std::nullopt;
}

void answerNothing(DeviceCall& call) {
  if (call.kind() != PositionMode && call.kind() != PositionControl) return;
  call.set(0, nc::technol::kNotGiven);
  call.set(1, nc::technol::kNotGiven);
}

// Cells of axes.

std::string nameOfAxis(std::string_view pattern, uint32_t axis) {
  constexpr const char* kLetters[] = {"X", "Y", "Z"};
  const size_t at = pattern.find_first_of("#%");
  const bool letter = pattern[at] == '#' && axis <= 3;
  return std::string(pattern.substr(0, at)) + (letter ? kLetters[axis - 1] : std::to_string(axis)) +
         std::string(pattern.substr(at + 1));
}

AxisBits::AxisBits(const rung_program& program, std::string_view pattern) {
  for (uint32_t axis = 1; axis <= kMaxAxes; ++axis)
    places_[axis - 1] = nc::technol::locateSignal(program, nameOfAxis(pattern, axis));
}

AxisMask AxisBits::read(const core::Memory& memory) const {
  AxisMask mask = 0;
  for (uint32_t i = 0; i < kMaxAxes; ++i)
    if (memory.read(places_[i]) != 0) setBit(mask, i);
  return mask;
}

void AxisBits::write(const core::Memory& memory, AxisMask which, AxisMask mask) const {
  for (uint32_t i = 0; i < kMaxAxes; ++i)
    if (has(which, i)) memory.write(places_[i], has(mask, i) ? 1 : 0);
}

AxisCells::AxisCells(const rung_program& program)
    : enabled_(program, "MP#PI"), limitPlus_(program, "KH#0"), limitMinus_(program, "KH#1"), loops_(program, "VAZBA_#"),
      motions_(program, "PO_OS#PI"), directions_(program, "SM_PO#PI") {
  nc::technol::locateElements(program, "B_POL_EX", positionEx_);
  nc::technol::locateElements(program, "B_POL", positionShort_);
  nc::technol::locateElements(program, "B_INK_EX", incrementEx_);
  nc::technol::locateElements(program, "B_INK", incrementShort_);
  for (uint32_t space = 1; space <= positionOfSpaces_.size(); ++space)
    nc::technol::locateElements(program, "POSITION_POS" + std::to_string(space) + "_EX", positionOfSpaces_[space - 1]);
}

void AxisCells::read(const core::Memory& memory, AxisPermits& permits) const {
  permits.enabled = enabled_.read(memory);
  permits.limitPlus = limitPlus_.read(memory);
  permits.limitMinus = limitMinus_.read(memory);
}

// A position is the sum of both buffers (l.5988); here B_POL contains all of it.
void AxisCells::write(const core::Memory& memory, AxisMask which, const AxisReport& report) const {
  motions_.write(memory, which, report.motion);
  directions_.write(memory, which, report.negative);
  for (uint32_t i = 0; i < kMaxAxes; ++i) {
    if (!has(which, i)) continue;
    if (i < positionShort_.size()) {
      memory.write(positionShort_[i], static_cast<uint64_t>(report.positionShort[i]));
      memory.write(incrementShort_[i], 0);
    }
    memory.write(positionEx_[i], static_cast<uint64_t>(report.positionEx[i]));
    memory.write(incrementEx_[i], 0);
    for (const auto& places : positionOfSpaces_) memory.write(places[i], static_cast<uint64_t>(report.positionEx[i]));
  }
}

// Requests to positioning units.

namespace {

void init(PositionTarget& target, const AxisCells& cells, const DeviceCall& call) {
  const int64_t axis = call.arg(0);
  const bool known = axis >= 1 && axis <= kMaxAxes;
  target.posInit(axis, call.argOr(1, 0), known && cells.loops().read(call.memory(), static_cast<uint32_t>(axis)));
}

void mode(PositionTarget& target, DeviceCall& call) {
  const PositioningUnits::Mode mode =
      target.posMode(call.arg(2), static_cast<int32_t>(call.arg(0)), static_cast<uint16_t>(call.arg(1)));
  call.set(0, mode.accepted ? mode.control : nc::technol::kNotGiven);
}

void control(PositionTarget& target, DeviceCall& call) {
  const PositioningUnits::State state =
      target.posControl(call.arg(2), static_cast<uint32_t>(call.arg(0)), call.arg(1) != 0);
  call.set(0, state.status);
  call.set(1, state.programmed ? state.control : nc::technol::kNotGiven);
}

} // namespace

std::optional<int64_t> positionedAxis(const core::ServiceRequest& request) {
  switch (kindOf(request)) {
  case PositionInit:
  case PositionReset: return request.args[0];
  case PositionMode:
  case PositionControl: return request.args[2];
  default: return std::nullopt;
  }
}

bool answerPosition(PositionTarget& target, const AxisCells& cells, DeviceCall& call) {
  switch (call.kind()) {
  case PositionInit: init(target, cells, call); return true;
  case PositionReset: target.posReset(call.arg(0)); return true;
  case PositionMode: mode(target, call); return true;
  case PositionControl: control(target, call); return true;
  default: return false;
  }
}

} // namespace rung::io
