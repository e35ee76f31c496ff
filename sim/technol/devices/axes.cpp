// All axes, a millisecond at a time.
#include "sim/technol/devices/axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "rtlib/text/number.h"

namespace rung::sim::technol {

void Axes::powerUp() {
  for (Axis& axis : axes_) axis.reset();
  positioning_ = {};
  spindles_.reset();
  units_.reset();
  reference_.reset();
  manual_.reset();
  complaints_ = {};
  operatorStop_ = Stop::None;
  stopPiWas_ = false;
  aborted_ = blockMotion_ = 0;
}

void Axes::fault() {
  operatorStop_ = Stop::Emergency; // stops references and SPI_AX, because the drives are disabled
  spindles_.zeroOutputs();
  units_.brakeAll();
  manual_.lock(true);
}

// STOPPI acts by its edge; the other requests are taken and reset (l.6396-6413).
Stop Axes::takeStop(const AxisInputs& in, AxisRequests& requests) {
  const bool edge = in.stopPi && !stopPiWas_;
  stopPiWas_ = in.stopPi;
  Stop stop = std::exchange(operatorStop_, Stop::None);
  if ((edge || requests.stopReq) && stop == Stop::None) stop = Stop::Normal;
  if (requests.stopEmergencyReq) stop = Stop::Emergency;
  requests.stopReq = requests.stopEmergencyReq = false;
  return stop;
}

// The speed of the main spindle in 1/min.
double Axes::mainRevolutions() const {
  const uint32_t main = spindles_.main();
  return main == 0 ? 0 : std::fabs(speedPerMinute(main)) / kDegreesPerTurn;
}

void Axes::tick(const AxisInputs& in, AxisRequests& requests) {
  const Stop stop = takeStop(in, requests);
  const uint32_t count = this->count();
  blockMotion_ = in.blockMotion;
  requests.positioning = static_cast<AxisMask>(requests.positioning & ~std::exchange(aborted_, {}));
  for (uint32_t i = 0; i < count; ++i) positioning_[i].drive(axes_[i], i, in, requests, stop);
  for (uint32_t i = 0; i < count; ++i) units_.drive(axes_[i], i + 1, in);
  reference_.drive(existing(), in, requests, stop, complaints_);
  manual_.drive(existing(), in, requests, mainRevolutions());
  for (uint32_t i = 0; i < count; ++i) spindles_.drive(axes_[i], i + 1);

  for (Axis& axis : existing()) axis.tick();

  for (uint32_t i = 0; i < count; ++i) positioning_[i].look(axes_[i], i, requests);
  for (uint32_t i = 0; i < count; ++i) units_.look(axes_[i], i + 1);
  reference_.look(existing(), requests);
}

void Axes::show(AxisOutputs& out) const {
  out.motion = blockMotion_;
  out.negative = out.movedByHand = 0;
  out.inPosition = true;
  for (uint32_t i = 0; i < count(); ++i) {
    const Axis& axis = axes_[i];
    if (axis.requested) setBit(out.motion, i);
    if (axis.negative) setBit(out.negative, i);
    if (axis.moves() && !axis.spindle) out.inPosition = false;
    if (axis.mover == Mover::Manual) setBit(out.movedByHand, i);
    out.speed[i] = axis.motion.speed() * 60;
    out.shiftSpeed[i] = axis.shift.speed() * 60;
    out.position[i] = axis.measured();
    out.place(i, axis.measured());
  }
  out.reference = reference_.underWay(existing());
  manual_.show(existing(), out);
}

// Configuration of the axes.

namespace {

// The error in the letters of axes, or "".
std::string problemOf(std::string_view letters) {
  if (letters.empty() || letters.size() > kMaxAxes) return "'axes' needs 1 to 16 letters";
  for (size_t i = 0; i < letters.size(); ++i) {
    if (letters[i] < 'A' || letters[i] > 'Z')
      return "'axes' needs capital letters; found '" + std::string(letters) + "'";
    if (letters.find(letters[i], i + 1) != std::string_view::npos)
      return "'axes' has the letter '" + std::string(1, letters[i]) + "' twice";
  }
  return {};
}

std::string_view takeWord(std::string_view& text) {
  const size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const size_t end = std::min(text.find(' ', begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

} // namespace

std::string Axes::configure(std::string_view key, std::string_view value) {
  if (key == "axes") {
    std::string problem = problemOf(value);
    if (problem.empty()) letters_ = value;
    return problem;
  }
  if (!io::isAxisKey(key)) return "the axes have no key '" + std::string(key) + "'";
  io::AxisKey own;
  if (std::string wrong = readAxisKey(key, own); !wrong.empty()) return wrong;
  configured_.emplace(own.axis, key);
  return axes_[own.axis - 1].attributes.set(own.attribute, value);
}

std::string Axes::configurationProblem() const {
  for (const auto& [axis, key] : configured_)
    if (!exists(axis))
      return "'" + key + "' is for axis " + std::to_string(axis) + "; the axes are " + letters_ + ", 1 to " +
             std::to_string(count()) + " (config axes)";
  return {};
}

std::string Axes::addSwitch(uint64_t bit, std::string_view value) {
  std::string_view rest = value;
  const auto axis = text::wholeIn<uint32_t>(takeWord(rest));
  const auto low = text::realIn(takeWord(rest));
  const auto high = text::realIn(takeWord(rest));
  if (!axis || *axis < 1 || *axis > kMaxAxes || !low || !high || *low > *high || !takeWord(rest).empty())
    return "a switch needs an axis and two places, the lower first: '1 -1000 -5'; found '" + std::string(value) + "'";
  configured_.emplace(*axis, "switch " + std::string(value));
  switches_.push_back({.bit = bit, .axis = *axis, .low = *low, .high = *high});
  return {};
}

// A rotary axis passes its switch in each revolution: of its equivalent positions the first one from `low` on counts.
bool Axes::isClosed(const Switch& contact) const {
  const Axis& axis = axes_[contact.axis - 1];
  const double place = axis.physical();
  if (axis.attributes.rotary == 0) return place >= contact.low && place <= contact.high;
  return place + kDegreesPerTurn * std::ceil((contact.low - place) / kDegreesPerTurn) <= contact.high;
}

// Instructions of the program and actions of the operator.

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
  // A role determines the axis, whatever the operand (l.8130).
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
