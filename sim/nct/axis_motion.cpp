// How axes move: commands of MOVCMND, part programs, jog, increments, hand wheels, reference point (see axes.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/nct/axes.h"
#include "sim/nct/spindles.h"

namespace rung::sim::nct {
namespace {

constexpr double kEnd = 1e12; // a target that is never reached

// Feed by CP_JOGFD with N0316 = 1, mm/min (l.10779-10796); above 15 the row continues, tenfold in five steps.
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

// The interpolator takes the command that waits.
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

// True: it is done.
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

// A step of CP_INC at every new request; it stops when the request goes (l.8531).
void Axes::stepIncrement(uint32_t axis, uint32_t channel) {
  Axis& state = axes_[axis];
  const int32_t direction = jogDirection(axis);
  if (direction == 0) state.steps = 0;
  if (direction != 0 && direction != state.jogBefore)
    state.steps = direction * links().signals.get(signals_.increment, channel);
  moveSteps(axis, manualSpeed(axis));
}

// Either jog request moves to the reference point, until it is there (l.8535).
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

// Of all handwheels that this axis is assigned to (l.6733).
int32_t Axes::pulsesFor(uint32_t axis) const {
  int32_t sum = 0;
  for (size_t wheel = 0; wheel < turned_.size(); ++wheel)
    if (links().signals.get(signals_.handwheelAxis[wheel]) == static_cast<int32_t>(axis) + 1) sum += turned_[wheel];
  return sum;
}

// ---- motion ------------------------------------------------------------------------------------------------------

// The flags of the PLC that answer the request of this motion (l.8267-8281), holds, limit switches, an open loop.
bool Axes::mayMove(uint32_t axis, bool positive, Pace pace) const {
  const bool disabled = get(positive ? signals_.noPositive : signals_.noNegative, axis) ||
                        get(pace == Pace::Rapid ? signals_.noRapid : signals_.noFeed, axis);
  const bool held = links().signals.get(signals_.holdAll) || links().signals.get(signals_.hold, channelOf(axis));
  const bool onSwitch = get(positive ? signals_.switchPositive : signals_.switchNegative, axis);
  return !disabled && !held && !onSwitch && !get(signals_.open, axis) && !get(signals_.parked, axis) &&
         !get(signals_.syncSlave, axis);
}

// Range 1 where N1000 #0 enables it and CP_LIM1DIS does not disable it; 1B by AP_LIMSELP, AP_LIMSELN.
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

// Synchronous slaves make the way of their master, superimposed ones add it to their own (l.8617-8670).
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

} // namespace rung::sim::nct
