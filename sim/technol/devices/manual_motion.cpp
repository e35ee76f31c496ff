// Manual motion (see manual_motion.h).
#include "sim/technol/devices/manual_motion.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rung::sim::technol {
namespace {

constexpr uint32_t kShiftAxes = 6;    // l.10917
constexpr double kBackAtStop = 0.001; // mm

AxisMask enabledFor(const Axis& axis, const AxisInputs& in) {
  return axis.attributes.manEnable == 2 ? in.manualEnabled : in.enabled; // l.10861-10869
}
bool mayTake(const Axis& axis) { return !axis.spindle && (axis.mover == Mover::None || axis.mover == Mover::Manual); }
// MPxPI and limits brake harder than an order that ends (l.6428).
void brake(Axis& axis) { axis.motion.stop(axis.attributes.accelerationEmergency); }

} // namespace

void ManualMotion::lock(bool locked) {
  locked_ = locked;
  if (!locked) return;
  on_ = false;
  panel.releaseKeys();
}

void ManualMotion::drop(Axis& axis, uint32_t index) {
  clearBit(wheels_, index);
  if (axis.mover == Mover::Manual) axis.letGo(axis.attributes.acceleration);
}

void ManualMotion::activate(const AxisInputs& in, AxisRequests& requests) {
  if (requests.autmanSelect) on_ = true;
  if (requests.autmanCancel) on_ = false;
  requests.autmanSelect = requests.autmanCancel = false; // granted or not (l.11022-11030)
  if (const auto wanted = panel.takeManual()) on_ = *wanted;
  on_ = on_ && in.autmanAllowed && !locked_;
  active_ = in.autmanAllowed && !locked_ && (in.autmanReq || on_);
}

ManualMotion::Ordered ManualMotion::orders(const AxisInputs& in) {
  external_ = in.externalControl;
  externalSelecting_ = active_ && external_ && in.externalSelect && in.externalPlus != 0;
  if (externalSelecting_) panel.select(static_cast<uint32_t>(std::countr_zero(in.externalPlus)) + 1, false);
  if (!active_ || (external_ && in.externalSelect)) return {};
  const AxisMask plus = external_ ? in.externalPlus : panel.plus();
  const AxisMask minus = external_ ? in.externalMinus : panel.minus();
  return {.plus = static_cast<AxisMask>(plus & ~minus),
          .minus = static_cast<AxisMask>(minus & ~plus),
          .rapid = in.externalRapid || (!external_ && panel.rapid())};
}

// mm/min (l.10966-11009).
double ManualMotion::speed(const Axis& axis, const AxisInputs& in, double revolutions) const {
  const AxisAttributes& own = axis.attributes;
  double feed = in.externalFeed ? in.feed : own.feed;
  if (in.perRevolution) feed = feed / 1000 * revolutions;
  if (ordered_.rapid) feed = in.externalRapidFeed ? in.rapidFeed : own.feedRT;
  return std::min(feed * in.override(), own.feedRT);
}

void ManualMotion::driveAxis(Axis& axis, uint32_t index, const AxisInputs& in, double perMinute) {
  const bool plus = has(ordered_.plus, index), minus = has(ordered_.minus, index);
  if (plus || minus) {
    clearBit(wheels_, index);
    axis.mover = Mover::Manual;
    axis.request(minus);
    const bool free = holdOf(in, index, minus, enabledFor(axis, in)) == Hold::None;
    if (free)
      axis.motion.run((minus ? -perMinute : perMinute) / 60, axis.attributes.acceleration);
    else
      brake(axis);
  } else if (has(wheels_, index) && active_) {
    driveWheel(axis, index, in);
  } else {
    drop(axis, index);
  }
}

void ManualMotion::driveWheel(Axis& axis, uint32_t index, const AxisInputs& in) {
  const double target = wheelTargets_[index];
  axis.mover = Mover::Manual;
  if (axis.motion.isAtRestAt(target)) return drop(axis, index);
  axis.request(target < axis.motion.position());
  const bool free = holdOf(in, index, axis.negative, enabledFor(axis, in)) == Hold::None;
  if (free)
    axis.motion.moveTo(target, axis.attributes.feedRT / 60, axis.attributes.acceleration);
  else
    brake(axis);
}

// Steps in mm, of the preselected axis.
void ManualMotion::turnWheel(std::span<const Axis> axes, double steps) {
  const uint32_t number = panel.selected();
  if (!active_ || steps == 0 || number == 0 || number > axes.size() || !mayTake(axes[number - 1])) return;
  const uint32_t index = number - 1;
  double& target = wheelTargets_[index];
  target = (has(wheels_, index) ? target : axes[index].motion.position()) + steps;
  setBit(wheels_, index);
}

void ManualMotion::drive(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, double revolutions) {
  panel.settle(in, requests);
  activate(in, requests);
  const double steps = static_cast<double>(panel.takePulses()) * requests.knobStep / 1000;
  ordered_ = orders(in);
  shiftActive_ = requests.shiftSelected && requests.shiftActive;
  watchStop(axes, in);
  driveShift(axes, in, requests, shiftActive_ ? steps : 0);
  if (!shiftActive_) turnWheel(axes, steps);
  for (uint32_t i = 0; i < axes.size(); ++i)
    if (mayTake(axes[i])) driveAxis(axes[i], i, in, speed(axes[i], in, revolutions));
}

// INPOS_STOP (l.10871): whether all axes are where they were before manual motion inside a block.
void ManualMotion::watchStop(std::span<const Axis> axes, const AxisInputs& in) {
  const bool moves = ordered_.plus != 0 || ordered_.minus != 0 || wheels_ != 0;
  const auto back = [&](uint32_t i) {
    return axes[i].motion.isAtRest() && std::fabs(axes[i].motion.position() - stopPlaces_[i]) < kBackAtStop;
  };
  if (!in.block)
    atStop_ = true;
  else if (atStop_ && active_ && moves) {
    for (uint32_t i = 0; i < axes.size(); ++i) stopPlaces_[i] = axes[i].motion.position();
    atStop_ = false;
  } else if (!atStop_ && !moves) {
    atStop_ = true;
    for (uint32_t i = 0; i < axes.size(); ++i) atStop_ = atStop_ && back(i);
  }
}

// l.11057-11127
void ManualMotion::driveShift(std::span<Axis> axes, const AxisInputs& in, const AxisRequests& requests, double steps) {
  if (shiftWasActive_ && !shiftActive_) panel.select(0, false); // the last choice of an axis goes with it
  shiftWasActive_ = shiftActive_;
  const uint32_t selected = panel.selected();
  const bool may = shiftActive_ && selected != 0 && selected <= kShiftAxes && has(in.shiftEnable, selected - 1);
  shifting_ = may ? bitOf(selected - 1) : AxisMask{0};
  if (may) shifts_[selected - 1] += steps;
  if (!requests.shiftSelected) shifts_ = {}; // it returns to where the path is
  for (uint32_t i = 0; i < axes.size(); ++i)
    axes[i].shift.moveTo(shifts_[i], axes[i].attributes.feedRT / 60, axes[i].attributes.acceleration);
}

void ManualMotion::show(std::span<const Axis> axes, AxisOutputs& out) const {
  const bool byPanel = active_ && !external_;
  const bool ordered = ordered_.plus != 0 || ordered_.minus != 0;
  const bool selecting = byPanel && panel.selecting() && !ordered;
  const uint32_t selected = panel.selected();
  out.manual = active_;
  out.atStop = atStop_;
  out.panelControl = byPanel;
  out.wheelControl = byPanel && wheels_ != 0;
  out.selecting = selecting || externalSelecting_;
  out.rapid = byPanel && panel.rapid();
  out.manualPlus = byPanel ? ordered_.plus : AxisMask{0};
  if (selecting) setBit(out.manualPlus, selected - 1); // l.10850
  out.manualMinus = byPanel ? ordered_.minus : AxisMask{0};
  out.shiftControl = static_cast<uint8_t>(shifting_);
  out.knobSelected = {};
  if (selected != 0 && shiftActive_)
    out.knobSelected[selected - 1] = 2;
  else if (selected != 0 && active_)
    out.knobSelected[selected - 1] = 1;
  for (uint32_t i = 0; i < axes.size(); ++i) out.shiftMm[i] = axes[i].shift.position();
  for (uint32_t i = 0; i < std::min<size_t>(axes.size(), kShiftAxes); ++i)
    out.shift[i] = static_cast<int32_t>(std::lround(axes[i].shift.position() * 8000));
}

} // namespace rung::sim::technol
