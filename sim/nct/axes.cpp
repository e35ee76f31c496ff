// The axes: state, MW 90, configuration and quantities.
#include "sim/nct/axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/nct/bits.h"
#include "sim/nct/spindles.h"

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

// Rotary axes are A, B and C by their names (N0100).
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

// l.4252-4293. The manual does not define code 90: here it is for a position that is not a number.
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

void Axes::retain(Retained& retained) {
  for (Axis& state : axes_) {
    retained.value(state.position);
    retained.value(state.zeroPoint);
  }
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

// Sets N0002 Axis Assign, N0100 Axis Name1, and drives with the numbers of the axes (N0501, N0503).
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

// Motion of axes: commands of MOVCMND, part programs, jog, increments, hand wheels, reference point.

namespace {

constexpr double kEnd = 1e12; // a target that is never reached

// Feed by CP_JOGFD with N0316 = 1, mm/min (l.10779-10796); above 15 the series continues, by a factor of ten every five
// steps.
constexpr double kJogFeeds[] = {0, 2, 3.2, 5, 7.9, 12.6, 20, 32, 50, 79, 126, 200, 320, 500, 790, 1260};

double jogFeed(int32_t selection) {
  if (selection <= 0) return 0;
  double factor = 1;
  for (; selection > 15 && factor < 1e6; selection -= 5) factor *= 10;
  return kJogFeeds[std::min(selection, 15)] * factor;
}

} // namespace

// ---- commands of the PLC -----------------------------------------------------------------------------------------

void Axes::reset(uint32_t axis) {
  axes_[axis].active = {};
  axes_[axis].buffer = {};
  axes_[axis].steps = 0;
  set(signals_.bufferEmpty, axis, true);
  set(signals_.going, axis, false);
  set(signals_.motionDone, axis, true);
}

// The interpolator takes the waiting command.
void Axes::take(uint32_t axis) {
  Axis& state = axes_[axis];
  state.active = state.buffer;
  state.buffer = {};
  state.rest = state.active.distance;
  state.steps = 0;
  state.target = state.active.distance;
  if (state.active.kind == AxisCommand::Kind::Incremental) state.target += state.position;
  if (state.active.kind == AxisCommand::Kind::Move && !state.active.machine) state.target += state.zeroPoint;
}

void Axes::stepPlc(uint32_t axis) {
  Axis& state = axes_[axis];
  if (get(signals_.reset, axis)) return reset(axis); // l.8736
  const bool endless = state.active.kind == AxisCommand::Kind::Jog || state.active.kind == AxisCommand::Kind::Handwheel;
  const bool waiting = state.buffer.kind != AxisCommand::Kind::None;
  // Jog and handwheel motions last until the next command (l.3144-3145).
  if (waiting && (state.active.kind == AxisCommand::Kind::None || endless)) take(axis);
  const bool go = state.active.kind != AxisCommand::Kind::None && get(signals_.go, axis);
  if (go && execute(axis, state.active)) state.active = {};
  set(signals_.going, axis, go && state.active.kind != AxisCommand::Kind::None);
  set(signals_.bufferEmpty, axis, state.buffer.kind == AxisCommand::Kind::None);
  set(signals_.motionDone, axis,
      state.active.kind == AxisCommand::Kind::None && state.buffer.kind == AxisCommand::Kind::None);
}

// Executes a command. True: it is finished.
bool Axes::execute(uint32_t axis, const AxisCommand& command) {
  Axis& state = axes_[axis];
  switch (command.kind) {
  case AxisCommand::Kind::None: return true;
  case AxisCommand::Kind::Move:
  case AxisCommand::Kind::Incremental: {
    const double feed = command.perRevolution ? command.speed * std::abs(spindleSpeed(axis)) : command.speed;
    const bool there =
        moveTowards(axis, state.target, command.rapid ? rapid_ : feed, command.rapid ? Pace::Rapid : Pace::Feed);
    if (there && command.toReference) state.referenced = true;
    return there;
  }
  case AxisCommand::Kind::Dwell: return dwell(axis, 1);
  case AxisCommand::Kind::DwellTurns: return dwell(axis, std::abs(spindleSpeed(axis)) / 60);
  case AxisCommand::Kind::Jog: {
    const int32_t direction = jogDirection(axis);
    if (direction != 0)
      moveTowards(axis, direction * kEnd, command.speed > 0 ? command.speed : jogSpeed(axis), Pace::Feed);
    return false;
  }
  case AxisCommand::Kind::Handwheel:
    state.steps += pulsesFor(axis) * increment(axis);
    moveSteps(axis, rapid_);
    return false;
  }
  return true;
}

bool Axes::dwell(uint32_t axis, double perSecond) {
  axes_[axis].rest -= perSecond * static_cast<double>(links().sliceUs) * 1e-6;
  return axes_[axis].rest <= kNear;
}

// ---- part programs and by hand -----------------------------------------------------------------------------------

void Axes::stepProgram(uint32_t axis) {
  Axis& state = axes_[axis];
  const uint32_t channel = channelOf(axis);
  if (programHold_[channel]) return;
  const AxisCommand& command = state.program;
  const double speed = command.rapid ? rapid_ * links().signals.get(signals_.rapidOverride, channel)
                                     : command.speed * links().signals.get(signals_.feedOverride, channel);
  if (moveTowards(axis, command.distance, speed, command.rapid ? Pace::Rapid : Pace::Feed)) state.program = {};
}

void Axes::stepManual(uint32_t axis) {
  Axis& state = axes_[axis];
  const uint32_t channel = channelOf(axis);
  const SignalMemory& signals = links().signals;
  const uint32_t modes = signals.wordOf(signals_.jogMode, channel);
  if (!signals_.referenceMode.in(modes)) state.referenceEnd = false;
  const int32_t direction = jogDirection(axis);
  if (signals_.jogMode.in(modes)) {
    const bool rapid = direction != 0 && signals.get(signals_.jogRapid, channel);
    if (direction != 0) moveTowards(axis, direction * kEnd, manualSpeed(axis), rapid ? Pace::Rapid : Pace::Feed);
  } else if (signals_.incrementMode.in(modes)) {
    stepIncrement(axis, channel);
  } else if (signals_.handwheelMode.in(modes)) {
    state.steps += pulsesFor(axis) * increment(axis);
    moveSteps(axis, rapid_);
  } else if (signals_.referenceMode.in(modes)) {
    stepReference(axis);
  } else {
    state.steps = 0;
  }
  state.jogBefore = direction;
}

// Moves by a step of CP_INC at every new request, and stops when the request ends (l.8531).
void Axes::stepIncrement(uint32_t axis, uint32_t channel) {
  Axis& state = axes_[axis];
  const int32_t direction = jogDirection(axis);
  if (direction == 0) state.steps = 0;
  if (direction != 0 && direction != state.jogBefore)
    state.steps = direction * links().signals.get(signals_.increment, channel);
  moveSteps(axis, manualSpeed(axis));
}

// Either jog request moves the axis to the reference point (l.8535).
void Axes::stepReference(uint32_t axis) {
  Axis& state = axes_[axis];
  const bool asked = get(signals_.jogPositive, axis) || get(signals_.jogNegative, axis);
  if (!asked || state.referenceEnd) return;
  if (!moveTowards(axis, real(parameters_.reference[0], axis), rapid_, Pace::Rapid)) return;
  state.referenced = state.referenceEnd = true;
}

void Axes::moveSteps(uint32_t axis, double perMinute) {
  Axis& state = axes_[axis];
  if (std::abs(state.steps) < kNear) return;
  const double before = state.position;
  const bool there = moveTowards(axis, before + state.steps, perMinute, Pace::Feed);
  state.steps = there ? 0 : state.steps - (state.position - before);
}

double Axes::jogSpeed(uint32_t axis) const {
  const uint32_t channel = channelOf(axis);
  if (parameter(parameters_.jogControl, channel) != 1)
    return jog_ * links().signals.get(signals_.feedOverride, channel);
  return jogFeed(links().signals.get(signals_.jogFeed, channel)) / (rotary(axis) ? 5 : 1);
}

double Axes::manualSpeed(uint32_t axis) const {
  const uint32_t channel = channelOf(axis);
  if (!links().signals.get(signals_.jogRapid, channel)) return jogSpeed(axis);
  return rapid_ * links().signals.get(signals_.rapidOverride, channel);
}

double Axes::spindleSpeed(uint32_t axis) const {
  const int32_t number = links().signals.get(signals_.machiningSpindle, channelOf(axis));
  return links().spindles->speed(number >= 1 ? static_cast<uint32_t>(number) - 1 : 0);
}

int32_t Axes::jogDirection(uint32_t axis) const {
  const uint32_t asked = links().signals.wordOf(signals_.jogPositive, axis);
  return (signals_.jogPositive.in(asked) ? 1 : 0) - (signals_.jogNegative.in(asked) ? 1 : 0);
}

// The pulses of all handwheels assigned to this axis (l.6733).
int32_t Axes::pulsesFor(uint32_t axis) const {
  int32_t sum = 0;
  for (size_t wheel = 0; wheel < turned_.size(); ++wheel)
    if (links().signals.get(signals_.handwheelAxis[wheel]) == static_cast<int32_t>(axis) + 1) sum += turned_[wheel];
  return sum;
}

// ---- motion ------------------------------------------------------------------------------------------------------

// Whether the PLC's flags for this motion (l.8267-8281), holds, limit switches and the position loop allow it.
bool Axes::mayMove(uint32_t axis, bool positive, Pace pace) const {
  const bool disabled = get(positive ? signals_.noPositive : signals_.noNegative, axis) ||
                        get(pace == Pace::Rapid ? signals_.noRapid : signals_.noFeed, axis);
  const bool held = links().signals.get(signals_.holdAll) || links().signals.get(signals_.hold, channelOf(axis));
  const bool onSwitch = get(positive ? signals_.switchPositive : signals_.switchNegative, axis);
  return !disabled && !held && !onSwitch && !get(signals_.open, axis) && !get(signals_.parked, axis) &&
         !get(signals_.syncSlave, axis);
}

// The limit of range 1, if N1000 #0 enables it and CP_LIM1DIS does not disable it; range 1B if selected by AP_LIMSELP,
// AP_LIMSELN.
double Axes::strokeLimit(uint32_t axis, bool positive) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const bool enabled = option(parameters_.rangeEnable, 0, axis) &&
                       !links().signals.get(signals_.noRange1, channelOf(axis)) && axes_[axis].referenced;
  if (!enabled) return positive ? kNone : -kNone;
  if (positive)
    return real(get(signals_.range1BPositive, axis) ? parameters_.range1BPositive : parameters_.range1APositive, axis);
  return real(get(signals_.range1BNegative, axis) ? parameters_.range1BNegative : parameters_.range1ANegative, axis);
}

bool Axes::moveTowards(uint32_t axis, double target, double perMinute, Pace pace) {
  Axis& state = axes_[axis];
  const double way = target - state.position;
  if (std::abs(way) < kNear) {
    state.position = target;
    return true;
  }
  const bool positive = way > 0;
  (positive ? state.wantsPositive : state.wantsNegative) = true;
  state.wantsRapid = pace == Pace::Rapid;
  const double seconds = static_cast<double>(links().sliceUs) * 1e-6;
  if (!mayMove(axis, positive, pace) || !(perMinute > 0) || seconds <= 0) return false;
  const double step = perMinute / 60 * seconds;
  double to = std::abs(way) <= step ? target : state.position + (positive ? step : -step);
  const double limit = strokeLimit(axis, positive);
  if (positive ? to > limit : to < limit)
    to = positive ? std::max(limit, state.position) : std::min(limit, state.position);
  const double moved = to - state.position;
  shift(axis, moved);
  state.position = to;
  state.velocity += moved / seconds;
  return to == target;
}

void Axes::shift(uint32_t axis, double way) {
  axes_[axis].position += way;
  axes_[axis].lubrication += std::abs(way);
  follow(axis, way);
}

// Synchronous slaves move as far as their master, superimposed ones in addition to their own motion (l.8617-8670).
void Axes::follow(uint32_t master, double way) {
  if (!get(signals_.syncMaster, master) && !get(signals_.superMaster, master)) return;
  const double seconds = static_cast<double>(links().sliceUs) * 1e-6;
  for (uint32_t i = 0; i < nc::nct::kAxes; ++i) {
    if (i == master || !exists(i) || get(signals_.parked, i)) continue;
    const auto number = static_cast<int32_t>(master) + 1;
    const bool slave = get(signals_.syncSlave, i) && parameter(parameters_.syncMaster, i) == number;
    const bool added = get(signals_.superSlave, i) && parameter(parameters_.superMaster, i) == number;
    if (!slave && !added) continue;
    const bool reversed = option(slave ? parameters_.syncConfig : parameters_.superConfig, 0, i);
    const double own = reversed ? -way : way;
    axes_[i].position += own;
    axes_[i].lubrication += std::abs(own);
    axes_[i].velocity += own / seconds;
    if (added) axes_[i].target += own;
  }
}

void Axes::writeMotionSignals(uint32_t axis) {
  const Axis& state = axes_[axis];
  links().signals.setBits(signals_.wantsPositive, axis, signals_.motion,
                          signals_.wantsPositive.as(state.wantsPositive) |
                              signals_.wantsNegative.as(state.wantsNegative) |
                              signals_.wantsRapid.as(state.wantsRapid));
}

// Requests and acknowledgements of the axes, and their positions as signals (see axes.h; man. 7.10, 7.13).

// Requests are acknowledged only while the axis has no motion under way and its block buffer is empty.
bool Axes::free(uint32_t axis) const {
  const Axis& state = axes_[axis];
  return state.program.kind == AxisCommand::Kind::None && state.velocity == 0;
}

void Axes::acknowledge(uint32_t axis) {
  Axis& state = axes_[axis];
  if (!free(axis)) return;
  const SignalMemory& signals = links().signals;
  const uint32_t asked = signals.wordOf(signals_.detachRequest, axis);
  const bool detach = signals_.detachRequest.in(asked);
  if (detach != state.detached) {
    state.detached = detach;
    state.referenced = !detach && absolute_; // l.8450
    set(signals_.detached, axis, detach);
  }
  if (state.detached) return;
  const uint32_t answers = signals.wordOf(signals_.open, axis);
  const bool plcRequest = signals_.plcRequest.in(asked);
  if (signals_.plcOwns.in(answers) && !plcRequest) reset(axis);
  signals.setBits(signals_.open, axis, signals_.acknowledges,
                  signals_.open.as(signals_.openRequest.in(asked) || signals_.slaveOpenRequest.in(asked)) |
                      signals_.mirrored.as(signals_.mirrorRequest.in(asked)) | signals_.plcOwns.as(plcRequest));
  acknowledge(axis, asked, answers,
              {signals_.syncRequest, signals_.syncSlave, signals_.syncMaster, parameters_.syncMaster});
  acknowledge(axis, asked, answers,
              {signals_.exchangeRequest, signals_.exchangeSlave, signals_.exchangeMaster, parameters_.exchangeMaster});
  acknowledge(axis, asked, answers,
              {signals_.superRequest, signals_.superSlave, signals_.superMaster, parameters_.superMaster});
  // Only an axis of a synchronous control can be parked (l.8608).
  const bool coupled = signals_.syncSlave.in(answers) || get(signals_.syncMaster, axis);
  set(signals_.parked, axis, coupled && signals_.parkRequest.in(asked));
}

// The slave requests the coupling; the parameter has the number of its master, or 0 if it is not a slave (l.8625-8627).
void Axes::acknowledge(uint32_t axis, uint32_t asked, uint32_t answers, const Coupling& coupling) {
  const bool asks = coupling.request.in(asked);
  const bool slave = coupling.slave.in(answers);
  if (!asks && !slave) return;
  const int32_t number = parameter(coupling.masterNumber, axis);
  const bool on = asks && number >= 1 && number <= static_cast<int32_t>(nc::nct::kAxes) &&
                  static_cast<uint32_t>(number) != axis + 1 && exists(static_cast<uint32_t>(number) - 1);
  if (on == slave) return;
  set(coupling.slave, axis, on);
  if (number < 1 || number > static_cast<int32_t>(nc::nct::kAxes)) return;
  set(coupling.master, static_cast<uint32_t>(number) - 1, on);
}

void Axes::writePositionSignals(uint32_t axis) {
  const SignalMemory& signals = links().signals;
  if (!exists(axis)) return signals.setBits(signals_.inPosition, axis, signals_.position, 0);
  Axis& state = axes_[axis];
  const uint32_t asked = signals.wordOf(signals_.driveReference, axis);
  const double window = real(parameters_.inPosition, axis);
  const double measured = state.locked ? state.lockedAt : measuredPosition(axis);
  const bool byDrive = option(parameters_.referenceType, 3, axis) && option(parameters_.referenceType, 4, axis);
  const double distance = real(parameters_.indexDistance, axis);
  const bool indexed = option(parameters_.properties, 3, axis) && distance > 0;
  const double way = real(parameters_.lubricationDistance, axis);
  const bool lubricate = way > 0 && state.lubrication > way;
  if (lubricate) state.lubrication = 0;
  uint32_t bits = signals_.inPosition.as(std::abs(lag(axis)) < window) | signals_.alarm.as(state.alarm) |
                  signals_.referenced.as(byDrive ? signals_.driveReference.in(asked) : state.referenced) |
                  signals_.referenceEnd.as(state.referenceEnd) |
                  signals_.atIndex.as(indexed && std::abs(std::remainder(measured, distance)) < window) |
                  signals_.overPositive.as(signals_.switchPositive.in(asked) || atStrokeLimit(axis, true)) |
                  signals_.overNegative.as(signals_.switchNegative.in(asked) || atStrokeLimit(axis, false)) |
                  signals_.lubrication.as(lubricate);
  for (uint32_t i = 0; i < 4; ++i)
    bits |= signals_.atReference[i].as(std::abs(real(parameters_.reference[i], axis) - measured) < window);
  signals.setBits(signals_.inPosition, axis, signals_.position, bits);
}

bool Axes::atStrokeLimit(uint32_t axis, bool positive) const {
  const double limit = strokeLimit(axis, positive);
  return positive ? axes_[axis].position >= limit : axes_[axis].position <= limit;
}

// Called before every PLC cycle (l.7713); a switch exists if its axis does.
void Axes::writeSwitches() {
  const SignalMemory& signals = links().signals;
  const Parameters& parameters = *links().parameters;
  for (uint32_t i = 0; i < switchAxis_.size(); ++i) {
    uint32_t bits = 0;
    const bool given = (switches_ >> i & 1) != 0;
    const uint32_t axis = given ? static_cast<uint32_t>(parameters.dword(switchAxis_[i])) - 1 : 0;
    if (given && exists(axis)) {
      const double position = measuredPosition(axis);
      const double low = parameters.real(switchLow_[i]);
      const double high = parameters.real(switchHigh_[i]);
      bits = signals_.onSwitch.as(low < position && position < high) | signals_.belowSwitch.as(position < low) |
             signals_.aboveSwitch.as(position > high);
    }
    signals.setBits(signals_.onSwitch, i, signals_.switches, bits);
  }
}

} // namespace rung::sim::nct
