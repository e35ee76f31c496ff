// The spindles (see spindles.h).
#include "sim/nct/spindles.h"

#include <algorithm>
#include <cmath>

#include "sim/nct/bits.h"

namespace rung::sim::nct {
namespace {

constexpr uint32_t kFirstDrive = 33; // drives of spindles follow those of the axes
constexpr uint32_t kAll = (uint32_t{1} << nc::nct::kSpindles) - 1;

} // namespace

Spindles::Spindles(Links& links) : Topic(links) { number(4); }

void Spindles::number(uint32_t count) {
  for (uint32_t i = 0; i < nc::nct::kSpindles; ++i) {
    links().parameters->setInitial(601, i, i < count ? kFirstDrive + i : 0);
    links().parameters->setInitial(603, i, i < count ? kFirstDrive + i : 0);
    links().parameters->setInitial(607, i, i < count ? 1 : 0);
  }
}

bool Spindles::exists(uint32_t spindle) const {
  return spindle < nc::nct::kSpindles && links().parameters->bit(parameters_.config, 0, spindle) &&
         !spindles_[spindle].detached;
}

uint32_t Spindles::master(uint32_t spindle) const {
  const int32_t index = links().signals.get(signals_.master, spindle);
  return index >= 0 && index < static_cast<int32_t>(nc::nct::kSpindles) ? static_cast<uint32_t>(index) : spindle;
}

double Spindles::fraction(uint32_t spindle) const {
  const double position = spindles_[spindle].position;
  return position - std::floor(position);
}

double Spindles::synchronousError(uint32_t spindle) const {
  if (!spindles_[spindle].synchronised) return 0;
  const double shift = get(signals_.shiftPhase, spindle) ? real(parameters_.phaseShift, spindle) / 360 : 0;
  const double direction = get(signals_.negative, spindle) ? -1 : 1;
  return std::remainder(spindles_[spindle].position - direction * spindles_[master(spindle)].position - shift, 1.0);
}

// SP_RNG 11 to 18 selects the parameters (l.9249-9255); another code is range 1.
uint32_t Spindles::gear(uint32_t spindle) const {
  const int32_t range = links().signals.get(signals_.range, spindle);
  return range >= 11 && range <= 18 ? static_cast<uint32_t>(range) - 11 : 0;
}

Spindles::Order Spindles::orderOf(uint32_t asked) const {
  if (!signals_.enable.in(asked)) return Order::None;
  if (signals_.start.in(asked)) return Order::Rotate;
  if (signals_.orient.in(asked)) return Order::Orient;
  if (signals_.synchronise.in(asked)) return Order::Synchronise;
  return signals_.closeLoop.in(asked) ? Order::CloseLoop : Order::None;
}

// The speed by the rules of SN_NCOM (l.9212-9220), except for constant surface speed, which the program copies to
// SP_PRG.
double Spindles::rotationSpeed(uint32_t spindle) const {
  const uint32_t range = gear(spindle);
  const double direction = get(signals_.negative, spindle) ? -1 : 1;
  if (get(signals_.jog, spindle)) return direction * real(parameters_.jogSpeed[range], spindle);
  const SignalMemory& signals = links().signals;
  const double programmed = std::abs(static_cast<double>(signals.get(signals_.programmed, spindle)));
  const double speed = programmed * signals.get(signals_.speedOverride, spindle);
  const double least = real(parameters_.minimum[range], spindle);
  return direction * std::clamp(speed, least, std::max(least, real(parameters_.maximum[range], spindle)));
}

bool Spindles::ramp(uint32_t spindle, double target) {
  Spindle& state = spindles_[spindle];
  const uint32_t range = gear(spindle);
  const bool up = std::abs(target) > std::abs(state.command) && target * state.command >= 0;
  const double perSecond = real((up ? parameters_.rampUp : parameters_.rampDown)[range], spindle);
  const double step = perSecond > 0 ? perSecond * seconds() : std::abs(target - state.command);
  state.command += std::clamp(target - state.command, -step, step);
  return std::abs(state.command - target) < kNear;
}

// ---- commands ----------------------------------------------------------------------------------------------------

void Spindles::step(uint32_t spindle, Order order) {
  Spindle& state = spindles_[spindle];
  if (order != state.order) {
    state.positioning = state.oriented = state.synchronised = false;
    state.order = order;
  }
  state.wantsPositive = state.wantsNegative = false;
  state.closed = false;
  switch (order) {
  case Order::None:
  case Order::CloseLoop: state.set = 0; break;
  case Order::Rotate: state.set = rotationSpeed(spindle); break;
  case Order::Orient: return orient(spindle);
  case Order::Synchronise: return synchronise(spindle);
  }
  const bool there = ramp(spindle, state.set);
  state.closed = order == Order::CloseLoop && there;
  turn(spindle);
}

// The distance to the orientation position (N0684, l.8983-9000): a turning spindle keeps its direction; from standstill
// it is that of SP_NEG, or the shorter one.
double Spindles::orientationWay(uint32_t spindle) const {
  const Spindle& state = spindles_[spindle];
  const double to = real(parameters_.gridShift, spindle) / 360;
  double ahead = to - fraction(spindle);
  ahead -= std::floor(ahead); // 0 to 1, positive
  const bool turning = std::abs(state.command) > kNear;
  const bool negative = turning ? state.command < 0 : get(signals_.negative, spindle);
  const bool shorter = !turning && get(signals_.shortest, spindle) && state.referenced &&
                       links().parameters->bit(parameters_.config, 4, spindle);
  if (ahead < kNear || ahead > 1 - kNear) return 0;
  if (shorter) return ahead <= 0.5 ? ahead : ahead - 1;
  return negative ? ahead - 1 : ahead;
}

void Spindles::orient(uint32_t spindle) {
  Spindle& state = spindles_[spindle];
  const double speed = real(parameters_.orientSpeed[gear(spindle)], spindle);
  if (!state.positioning && !state.oriented) {
    const double direction = state.command < 0 ? -1 : 1;
    const bool turning = std::abs(state.command) > kNear;
    state.set = turning ? direction * speed : 0;
    if (turning && !ramp(spindle, state.set)) return turn(spindle);
    state.toGo = orientationWay(spindle);
    state.positioning = true;
  }
  state.closed = true;
  if (state.oriented) {
    state.set = state.command = state.speed = 0;
    return;
  }
  const bool positive = state.toGo > 0;
  const double step = std::min(speed / 60 * seconds(), std::abs(state.toGo));
  if (std::abs(state.toGo) > kNear) {
    (positive ? state.wantsPositive : state.wantsNegative) = true;
    state.command = state.speed = 0;
    if (get(positive ? signals_.noPositive : signals_.noNegative, spindle) || get(signals_.noFeed, spindle)) return;
    state.position += positive ? step : -step;
    state.toGo += positive ? -step : step;
    state.command = state.speed = positive ? speed : -speed;
  }
  if (std::abs(state.toGo) > kNear) return;
  state.command = state.speed = state.set = 0;
  state.oriented = state.referenced = true;
  state.positioning = false;
}

// The slave adopts the speed of its master (l.9026-9034), then its phase.
void Spindles::synchronise(uint32_t spindle) {
  Spindle& state = spindles_[spindle];
  const uint32_t other = master(spindle);
  if (other == spindle || !exists(other)) {
    ramp(spindle, state.set = 0);
    return turn(spindle);
  }
  Spindle& leader = spindles_[other];
  leader.closed = true;
  state.closed = true;
  const double direction = get(signals_.negative, spindle) ? -1 : 1;
  state.set = direction * leader.command;
  if (!state.synchronised) {
    const bool there = ramp(spindle, state.set);
    turn(spindle);
    if (!there) return;
    state.synchronised = true;
    state.position -= synchronousError(spindle);
    return;
  }
  state.command = state.set;
  turn(spindle);
  state.position -= synchronousError(spindle);
}

void Spindles::turn(uint32_t spindle) {
  Spindle& state = spindles_[spindle];
  state.speed = state.command + state.disturbance;
  state.position += state.command / 60 * seconds();
}

// ---- time --------------------------------------------------------------------------------------------------------

// Masters are stepped before their slaves, so that a slave follows the speed of the same time slice.
void Spindles::timeSlice() {
  const uint32_t there = existing();
  if (resting_ && seen_.areSame(links().signals)) return;
  uint32_t slaves = 0;
  forBits(there, [&](uint32_t i) {
    const Order order = orderOf(links().signals.wordOf(signals_.enable, i));
    if (order == Order::Synchronise)
      slaves |= uint32_t{1} << i;
    else
      step(i, order);
  });
  forBits(slaves, [&](uint32_t i) { step(i, Order::Synchronise); });
  writeSignals(there);
  const auto rests = [](const Spindle& state) { return state.order == Order::None && state.command == 0; };
  resting_ = std::ranges::all_of(spindles_, rests);
  if (resting_) seen_.see(links().signals);
}

uint32_t Spindles::existing() {
  const Parameters& parameters = *links().parameters;
  if (revision_ != parameters.revision()) {
    revision_ = parameters.revision();
    resting_ = false;
    configured_ = 0;
    for (uint32_t i = 0; i < nc::nct::kSpindles; ++i)
      configured_ |= uint32_t{parameters.bit(parameters_.config, 0, i)} << i;
  }
  uint32_t there = configured_;
  forBits(configured_, [&](uint32_t i) { there &= ~(uint32_t{spindles_[i].detached} << i); });
  return there;
}

void Spindles::cycle() {
  for (uint32_t i = 0; i < nc::nct::kSpindles; ++i) {
    Spindle& state = spindles_[i];
    const bool detach = get(signals_.detachRequest, i) && links().parameters->bit(parameters_.config, 0, i);
    if (detach == state.detached || state.speed != 0) continue;
    resting_ = false;
    const double position = state.position;
    state = {};
    state.position = position;
    state.detached = detach;
    state.referenced = !detach && absolute_; // l.9082
    put(signals_.detached, i, detach);
  }
}

void Spindles::writeSignals(uint32_t there) const {
  const SignalMemory& signals = links().signals;
  forBits(there, [&](uint32_t i) { writeSpindle(i); });
  forBits(~there & kAll, [&](uint32_t i) {
    signals.setBits(signals_.ramped, i, signals_.written, 0);
    signals.set(signals_.command, i, 0);
    signals.set(signals_.actual, i, 0);
  });
}

void Spindles::writeSpindle(uint32_t i) const {
  const SignalMemory& signals = links().signals;
  const Spindle& state = spindles_[i];
  const uint32_t asked = signals.wordOf(signals_.enable, i);
  const uint32_t range = gear(i);
  const double window = real(parameters_.inPosition[range], i);
  const double deviation = std::abs(state.speed - state.set);
  const double tolerance =
      std::max(std::abs(state.set) * real(parameters_.percent, i) / 100, real(parameters_.window, i));
  const double fluctuation = std::max(std::abs(state.set) * real(parameters_.fluctuationPercent, i) / 100,
                                      real(parameters_.fluctuationWindow, i));
  const bool ramped = std::abs(state.command - state.set) < kNear;
  const double angle = real(parameters_.basicAngle, i) / 360;
  const bool held = state.closed && (state.oriented || state.order == Order::CloseLoop);
  const bool atIndex = angle > 0 && std::abs(std::remainder(state.position, angle)) < window;
  signals.setBits(
      signals_.ramped, i, signals_.written,
      signals_.ramped.as(ramped) | signals_.atSpeed.as(deviation <= tolerance) |
          signals_.stopped.as(std::abs(state.speed) <= real(parameters_.zeroWindow, i)) |
          signals_.fluctuating.as(ramped && deviation > fluctuation) | signals_.loopClosed.as(state.closed) |
          signals_.oriented.as(state.closed && state.oriented) | signals_.inPosition.as(held || state.synchronised) |
          signals_.synchronised.as(state.synchronised) |
          signals_.phaseShifted.as(state.synchronised && signals_.shiftPhase.in(asked)) |
          signals_.wantsPositive.as(state.wantsPositive) | signals_.wantsNegative.as(state.wantsNegative) |
          signals_.alarm.as(state.alarm) | signals_.referenced.as(state.referenced) | signals_.atIndex.as(atIndex));
  const bool rotating = signals_.start.in(asked);
  signals.set(signals_.command, i, rotating ? static_cast<int32_t>(std::lround(state.command)) : 0);
  signals.set(signals_.actual, i, static_cast<int32_t>(std::lround(state.speed)));
}

void Spindles::powerOn(nc::PowerOn kind) {
  resting_ = false;
  for (Spindle& state : spindles_) {
    const double position = state.position;
    state = {};
    if (kind == nc::PowerOn::Warm) state.position = position;
    state.referenced = absolute_;
  }
  writeSignals(existing());
}

void Spindles::retain(Retained& retained) {
  for (Spindle& state : spindles_) retained.value(state.position);
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

Handled Spindles::config(std::string_view key, std::string_view value) {
  if (key == "encoders") { // also applies to the axes
    absolute_ = value == "absolute";
    return std::nullopt;
  }
  if (key != "spindles") return std::nullopt;
  number(static_cast<uint32_t>(text::realIn(value).value_or(0)));
  return "";
}

Handled Spindles::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey(name, keys, {"number", "alarm", "disturbance"}); !wrong.empty()) return wrong;
  const int64_t number = integerKey(keys, "number", 1);
  if (number < 1 || number > nc::nct::kSpindles) return "event spindle takes number=1 to 16";
  Spindle& state = spindles_[static_cast<size_t>(number) - 1];
  resting_ = false;
  if (findKey(keys, "alarm") != nullptr) state.alarm = integerKey(keys, "alarm", 0) != 0;
  if (findKey(keys, "disturbance") != nullptr)
    state.disturbance = static_cast<double>(integerKey(keys, "disturbance", 0));
  return "";
}

std::optional<double> Spindles::quantity(std::string_view name) const {
  const bool speed = name.starts_with("SPINDLE.");
  const auto key = numbersAfter(name, speed ? "SPINDLE." : "SPOS.");
  if (!key || key->size() != 1 || (*key)[0] < 1 || (*key)[0] > nc::nct::kSpindles) return std::nullopt;
  return speed ? spindles_[(*key)[0] - 1].speed : spindles_[(*key)[0] - 1].position;
}

Handled Spindles::setQuantity(std::string_view name, double value) {
  const auto key = numbersAfter(name, "SPOS.");
  if (!key) return std::nullopt;
  if (key->size() != 1 || (*key)[0] < 1 || (*key)[0] > nc::nct::kSpindles) return "there are spindles 1 to 16";
  spindles_[(*key)[0] - 1].position = value;
  resting_ = false;
  return "";
}

} // namespace rung::sim::nct
