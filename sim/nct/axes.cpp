// The axes: state, MW 90, configuration and quantities (see axes.h).
#include "sim/nct/axes.h"

#include <cmath>

#include "sim/nct/bits.h"

namespace rung::sim::nct {

Axes::Axes(Links& links) : Topic(links) {
  name("XYZABCUV"); // Parameters is before it in the Simulator
  for (uint32_t i = 0; i < 32; ++i) {
    switchAxis_.emplace_back(1101 + i);
    switchLow_.emplace_back(1133 + i);
    switchHigh_.emplace_back(1165 + i);
  }
}

bool Axes::exists(uint32_t axis) const { return axis < nc::nct::kAxes && assigned(axis) && !axes_[axis].detached; }

bool Axes::plcOwns(uint32_t axis) const {
  return axis < nc::nct::kAxes && get(signals_.plcRequest, axis) && get(signals_.plcOwns, axis);
}

uint32_t Axes::channelOf(uint32_t axis) const {
  const int32_t number = parameter(parameters_.assign, axis);
  return number >= 1 && number <= static_cast<int32_t>(nc::nct::kChannels) ? static_cast<uint32_t>(number) - 1 : 0;
}

// The manual's tables halve nothing but the unit of rotary axes: A, B, C by their names (N0100).
bool Axes::rotary(uint32_t axis) const {
  const int32_t letter = parameter(parameters_.name, axis);
  return letter >= 'A' && letter <= 'C';
}

// ---- commands ----------------------------------------------------------------------------------------------------

Axes::Load Axes::load(int64_t axis, int64_t code, double speed, double distance) {
  if (axis < 0 || axis >= nc::nct::kAxes || code < 0 || code >= static_cast<int64_t>(nc::nct::axisCodes().size()))
    return Load::Refused;
  const nc::nct::AxisCode& row = nc::nct::axisCodes()[static_cast<size_t>(code)];
  const auto index = static_cast<uint32_t>(axis);
  if (!plcOwns(index) || (row.needsSpeed() && speed == 0)) return Load::Refused;
  const bool usesDistance = row.distance != nc::nct::AxisDistance::Unused;
  if ((usesDistance && !std::isfinite(distance)) || (row.speed != nc::nct::AxisSpeed::Unused && !std::isfinite(speed)))
    return Load::Refused;
  Axis& state = axes_[index];
  if (state.buffer.kind != AxisCommand::Kind::None) return Load::Full;
  AxisCommand command;
  command.rapid = row.speed == nc::nct::AxisSpeed::Unused;
  command.perRevolution = row.speed == nc::nct::AxisSpeed::PerRevolution;
  command.machine = row.distance == nc::nct::AxisDistance::Machine;
  command.speed = std::abs(speed);
  command.distance = distance;
  switch (row.distance) {
  case nc::nct::AxisDistance::Absolute:
  case nc::nct::AxisDistance::Machine: command.kind = AxisCommand::Kind::Move; break;
  case nc::nct::AxisDistance::Incremental: command.kind = AxisCommand::Kind::Incremental; break;
  case nc::nct::AxisDistance::Seconds: command.kind = AxisCommand::Kind::Dwell; break;
  case nc::nct::AxisDistance::Revolutions: command.kind = AxisCommand::Kind::DwellTurns; break;
  case nc::nct::AxisDistance::Unused:
    if (code == 13) command.kind = AxisCommand::Kind::Jog;
    if (code == 14) command.kind = AxisCommand::Kind::Handwheel;
    if (code >= 7 && code <= 10) { // G28, G30 P2 to P4
      command.kind = AxisCommand::Kind::Move;
      command.machine = true;
      command.toReference = code == 7;
      command.distance = real(parameters_.reference[code - 7], index);
    }
    break;
  }
  state.buffer = command;
  if (state.active.kind == AxisCommand::Kind::None) take(index); // the interpolator takes it at once (l.3150)
  set(signals_.bufferEmpty, index, state.buffer.kind == AxisCommand::Kind::None);
  set(signals_.motionDone, index, false);
  return Load::Accepted;
}

void Axes::moveTo(uint32_t axis, double target, double perMinute) {
  AxisCommand& command = axes_[axis].program;
  command = {.kind = AxisCommand::Kind::Move, .rapid = perMinute == 0, .machine = true};
  command.distance = target;
  command.speed = perMinute;
}

void Axes::cancel(uint32_t axis) { axes_[axis].program = {}; }

// ---- MW 90 -------------------------------------------------------------------------------------------------------

bool Axes::serves(bool write, uint32_t function) const { return write && function == 90; }

// l.4252-4293. Code 90 has no condition in the manual: here a position that is not a number.
std::optional<int32_t> Axes::service(uint32_t, Block& block) {
  if (block.amount() != 3) return 2;
  const int32_t index = block.word(2);
  if (index < 0 || index >= static_cast<int32_t>(nc::nct::kAxes)) return 30;
  const auto axis = static_cast<uint32_t>(index);
  const bool disabled = get(signals_.encoderDisabled, axis) || option(parameters_.servoControl, 4, axis);
  if (!exists(axis) || !get(signals_.open, axis) || !disabled) return 91;
  if (!std::isfinite(block.real(3))) return 90;
  axes_[axis].position = block.real(3);
  axes_[axis].referenced = true;
  return 0;
}

// ---- power-on and time -------------------------------------------------------------------------------------------

void Axes::powerOn(nc::PowerOn kind) {
  for (Axis& state : axes_) {
    Axis fresh;
    if (kind == nc::PowerOn::Warm) {
      fresh.position = state.position;
      fresh.zeroPoint = state.zeroPoint;
    }
    fresh.referenced = absolute_;
    state = fresh;
  }
  programHold_ = {};
  pulses_ = {};
  turned_ = {};
  readParameters();
  for (uint32_t i = 0; i < nc::nct::kAxes; ++i) {
    axes_[i].referenced = absolute_ && assigned(i);
    writePositionSignals(i);
  }
  writeSwitches();
}

void Axes::readParameters() {
  if (revision_ == links().parameters->revision()) return;
  revision_ = links().parameters->revision();
  assigned_ = switches_ = 0;
  for (uint32_t i = 0; i < nc::nct::kAxes; ++i) assigned_ |= uint32_t{assigned(i)} << i;
  for (uint32_t i = 0; i < switchAxis_.size(); ++i) {
    const int32_t number = links().parameters->dword(switchAxis_[i]);
    switches_ |= uint32_t{number >= 1 && number <= static_cast<int32_t>(nc::nct::kAxes)} << i;
  }
}

void Axes::cycle() {
  readParameters();
  forBits(assigned_, [&](uint32_t i) {
    acknowledge(i);
    writePositionSignals(i);
  });
  writeSwitches();
}

void Axes::timeSlice() {
  turned_ = pulses_;
  pulses_ = {};
  for (int32_t wheel = 0; wheel < kHandwheels; ++wheel)
    links().signals.set(signals_.handwheelMove, static_cast<uint32_t>(wheel), turned_[static_cast<size_t>(wheel)]);
  for (Axis& state : axes_) {
    state.velocity = 0;
    state.wantsPositive = state.wantsNegative = state.wantsRapid = false;
  }
  readParameters();
  forBits(assigned_, [&](uint32_t i) {
    if (axes_[i].detached) return;
    const bool lock = get(signals_.lock, i);
    if (lock && !axes_[i].locked) axes_[i].lockedAt = axes_[i].position;
    if (!lock && axes_[i].locked) axes_[i].position = axes_[i].lockedAt; // from the measuring system (l.8596)
    axes_[i].locked = lock;
    if (get(signals_.plcOwns, i))
      stepPlc(i);
    else if (axes_[i].program.kind != AxisCommand::Kind::None)
      stepProgram(i);
    else
      stepManual(i);
    writeMotionSignals(i);
  });
}

void Axes::keep(Kept& kept) {
  for (Axis& state : axes_) {
    kept.value(state.position);
    kept.value(state.zeroPoint);
  }
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

// N0002 Axis Assign, N0100 Axis Name1, and drives of the axes' numbers (N0501, N0503).
void Axes::name(std::string_view names) {
  for (uint32_t i = 0; i < nc::nct::kAxes; ++i) {
    const bool there = i < names.size();
    links().parameters->setInitial(2, i, there ? 1 : 0);
    links().parameters->setInitial(100, i, there ? names[i] : 0);
    links().parameters->setInitial(501, i, there ? i + 1 : 0);
    links().parameters->setInitial(503, i, there ? i + 1 : 0);
  }
}

Handled Axes::config(std::string_view key, std::string_view value) {
  const std::string expected = std::string(key) + ": expected ";
  const std::string found = ", found '" + std::string(value) + "'";
  if (key == "axes") {
    if (value.empty() || value.size() > nc::nct::kAxes) return expected + "1 to 32 letters" + found;
    for (const char letter : value)
      if (letter < 'A' || letter > 'Z') return expected + "letters A to Z" + found;
    name(value);
    return "";
  }
  if (key == "encoders") {
    absolute_ = value == "absolute";
    return "";
  }
  if (key != "rapid" && key != "jog") return std::nullopt;
  const std::optional<double> speed = text::realIn(value);
  if (!speed || *speed <= 0) return expected + "a speed per minute" + found;
  (key == "rapid" ? rapid_ : jog_) = *speed;
  return "";
}

Handled Axes::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (name == "handwheel") {
    if (std::string wrong = unknownKey(name, keys, {"pulses", "wheel"}); !wrong.empty()) return wrong;
    const int64_t wheel = integerKey(keys, "wheel", 4); // the built-in one (l.6746)
    const int64_t pulses = integerKey(keys, "pulses", INT32_MAX);
    if (wheel < 1 || wheel > kHandwheels || pulses <= -1'000'000 || pulses >= 1'000'000)
      return "event handwheel takes pulses=N and wheel=1 to 4";
    pulses_[static_cast<size_t>(wheel) - 1] += static_cast<int32_t>(pulses);
    return "";
  }
  if (std::string wrong = unknownKey(name, keys, {"axis", "on"}); !wrong.empty()) return wrong;
  const int64_t axis = integerKey(keys, "axis", 0);
  if (axis < 1 || axis > nc::nct::kAxes) return "event axis_alarm takes axis=1 to 32 and on=0 or on=1";
  axes_[static_cast<size_t>(axis) - 1].alarm = integerKey(keys, "on", 1) != 0;
  return "";
}

std::optional<double> Axes::quantity(std::string_view name) const {
  const auto axisOf = [&](std::string_view prefix) -> std::optional<uint32_t> {
    const auto key = numbersAfter(name, prefix);
    if (!key || key->size() != 1 || (*key)[0] < 1 || (*key)[0] > nc::nct::kAxes) return std::nullopt;
    return (*key)[0] - 1;
  };
  if (const auto axis = axisOf("MPOS.")) return axes_[*axis].position;
  if (const auto axis = axisOf("APOS.")) return axes_[*axis].position - axes_[*axis].zeroPoint;
  if (const auto axis = axisOf("ZERO.")) return axes_[*axis].zeroPoint;
  if (const auto axis = axisOf("SPEED.")) return axes_[*axis].velocity * 60;
  return std::nullopt;
}

Handled Axes::setQuantity(std::string_view name, double value) {
  const bool position = name.starts_with("MPOS.");
  if (!position && !name.starts_with("ZERO.")) return std::nullopt;
  const auto key = numbersAfter(name, position ? "MPOS." : "ZERO.");
  if (!key || key->size() != 1 || (*key)[0] < 1 || (*key)[0] > nc::nct::kAxes) return "there are axes 1 to 32";
  Axis& state = axes_[(*key)[0] - 1];
  (position ? state.position : state.zeroPoint) = value;
  return "";
}

} // namespace rung::sim::nct
