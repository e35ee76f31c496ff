// Instructions of the program and what the operator does (see axes.h).
#include <algorithm>
#include <iterator>

#include "sim/technol/devices/axes.h"

namespace rung::sim::technol {
namespace {

constexpr std::string_view kRegul[] = {"REGUL_X", "REGUL_Y", "REGUL_Z", "REGUL_4", "REGUL_5", "REGUL_6"};

constexpr std::string_view kReferences[] = {"single", "plc", "group", "pseudo", "simul", "clear"}; // as ReferenceKind

} // namespace

bool Axes::inRange(std::string_view instruction, int64_t axis) {
  if (axis >= 1 && axis <= kMaxAxes) return true;
  complaints_.add({instruction, "axis", axis, {}});
  return false;
}

bool Axes::usable(std::string_view instruction, int64_t axis) {
  if (!inRange(instruction, axis)) return false;
  if (axis <= count()) return true;
  complaints_.add({instruction, "axis", axis, " does not exist"});
  return false;
}

void Axes::analogPort(int64_t port) {
  if (port >= 1 && port <= kPorts)
    spindles_.selectPort(static_cast<uint32_t>(port));
  else
    complaints_.add({"ANALOG_PORT", "port", port, {}});
}

AnalogOutput Axes::analogOnSpindle(int64_t value, int64_t axis, int64_t spi) {
  if (spi < 0 || spi > 2) {
    complaints_.add({"ANALOG", "spi", spi, {}});
    return {};
  }
  // A role says which axis, whatever the operand says (l.8130).
  if (!(spi == 0 ? usable("ANALOG", axis) : inRange("ANALOG", axis))) return {};
  return spindles_.putOnSpindle(value, static_cast<uint32_t>(axis), static_cast<uint32_t>(spi));
}

AnalogOutput Axes::analogSpi(int64_t value, int64_t axis) {
  return usable("ANALOG_SPI", axis) ? spindles_.putOn(static_cast<uint32_t>(axis), value) : AnalogOutput{};
}

void Axes::dropPositioning(uint32_t index) {
  if (!positioning_[index].active()) return;
  positioning_[index].drop(axes_[index]);
  setBit(aborted_, index);
}

AnalogOutput Axes::axSpi(int64_t axis, SpindleRole role) {
  if (!usable("AX_SPI", axis)) return {};
  const auto number = static_cast<uint32_t>(axis);
  Axis& taken = axes_[number - 1];
  dropPositioning(number - 1);
  reference_.drop(taken, number - 1);
  manual_.drop(taken, number - 1);
  units_.lose(taken, number);
  return spindles_.switchTo(taken, number, role);
}

void Axes::spiMain(int64_t axis) {
  if (!usable("SPI_MAIN", axis)) return;
  const auto number = static_cast<uint32_t>(axis);
  if (!axes_[number - 1].spindle) axSpi(axis, SpindleRole::Keep);
  spindles_.makeMain(number);
}

bool Axes::spiAx(int64_t axis, const SpindlePositioningOrder& order) {
  if (!usable("SPI_AX", axis)) return false;
  const auto number = static_cast<uint32_t>(axis);
  if (units_.holds(number)) {
    complaints_.add({"SPI_AX", "axis", axis, " belongs to a positioning unit"});
    return false;
  }
  Axis& taken = axes_[number - 1];
  reference_.drop(taken, number - 1);
  manual_.drop(taken, number - 1);
  spindles_.leave(number);
  positioning_[number - 1].begin(taken, order);
  clearBit(aborted_, number - 1);
  return true;
}

void Axes::regul(int64_t axis, int64_t set) {
  if (axis < 1 || axis > static_cast<int64_t>(std::size(kRegul))) return;
  const std::string_view name = kRegul[axis - 1];
  if (set < 1 || set > kRegulatorSets) return complaints_.add({name, "set", set, {}});
  if (usable(name, axis)) spindles_.setRegulator(static_cast<uint32_t>(axis), static_cast<uint32_t>(set));
}

void Axes::posInit(int64_t axis, int64_t space, bool loopClosed) {
  if (!inRange("POS_INIT", axis)) return;
  if (space < 0 || space > kLastSpace) return complaints_.add({"POS_INIT", "space", space, {}});
  const auto number = static_cast<uint32_t>(axis);
  Axis& taken = axes_[number - 1];
  const bool idle = taken.mover == Mover::None || taken.mover == Mover::PositioningUnit;
  const bool loop = loopClosed && !taken.spindle;
  units_.init(taken, number, exists(number) && idle && loop && !has(blockMotion_, number - 1));
}

PositioningUnits::Mode Axes::posMode(int64_t axis, int32_t length, uint16_t acceleration) {
  if (!inRange("POS_MODE", axis)) return {};
  const auto number = static_cast<uint32_t>(axis);
  return units_.program(axes_[number - 1], number, length, acceleration);
}

PositioningUnits::State Axes::posControl(int64_t axis, uint32_t feed, bool mp) {
  if (!inRange("POS_CONTROL", axis)) return {};
  const auto number = static_cast<uint32_t>(axis);
  return units_.control(axes_[number - 1], number, feed, mp);
}

void Axes::posReset(int64_t axis) {
  if (!inRange("POS_RESET", axis)) return;
  const auto number = static_cast<uint32_t>(axis);
  units_.release(axes_[number - 1], number);
}

std::string Axes::reference(std::string_view type, AxisMask axes) {
  const auto* const found = std::ranges::find(kReferences, type);
  if (found == std::end(kReferences))
    return "'" + std::string(type) +
           "' is not a type of reference; expected single, plc, group, pseudo, simul or clear";
  const uint32_t known = (1u << count()) - 1;
  if (axes == 0 || (axes & ~known) != 0) return "a reference needs axes that exist: " + letters_;
  reference_.order(static_cast<ReferenceKind>(found - kReferences), axes);
  return {};
}

std::string Axes::rtm(std::string_view command, bool pressed) {
  const auto known = rtmCommand(command, letters_);
  if (!known) return "the simulated control does not know the RTM command '" + std::string(command) + "'";
  manual_.panel.key(*known, pressed);
  return {};
}

void Axes::key(std::string_view command, bool pressed) {
  if (const auto known = rtmCommand(command, letters_)) manual_.panel.key(*known, pressed);
}

} // namespace rung::sim::technol
