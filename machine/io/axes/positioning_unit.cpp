// Positioning units (see positioning_unit.h).
#include "machine/io/axes/positioning_unit.h"

#include <algorithm>

namespace rung::io {

const PositioningUnits::Unit* PositioningUnits::find(uint32_t number) const {
  const auto* const found = std::ranges::find(units_, number, &Unit::axis);
  return found == units_.end() ? nullptr : found;
}

// That of the axis, or a free one; null for the seventh axis.
PositioningUnits::Unit* PositioningUnits::unitFor(uint32_t number) {
  Unit* const own = find(number);
  return own != nullptr ? own : find(0);
}

void PositioningUnits::init(DrivenAxis& axis, uint32_t number, bool allowed) {
  Unit* const unit = allowed ? unitFor(number) : nullptr;
  if (unit == nullptr) return fail(number);
  clearBit(errors_, number - 1);
  const double acceleration = unit->acceleration > 0 ? unit->acceleration : axis.attributes.acceleration;
  *unit = {.axis = number, .acceleration = acceleration};
  axis.mover = Mover::PositioningUnit;
  unit->braking = !axis.motion.isAtRest();
  axis.motion.stop(acceleration);
}

PositioningUnits::Mode PositioningUnits::program(const DrivenAxis& axis, uint32_t number, int32_t length,
                                                 uint16_t acceleration) {
  Unit* const unit = find(number);
  const bool moving = unit != nullptr && unit->underWay() && (unit->started || !axis.motion.isAtRest());
  if (unit == nullptr || acceleration == 0 || (moving && !unit->braking)) {
    fail(number);
    return {};
  }
  const bool braking = unit->braking;
  *unit = {.axis = number, .programmed = true, .braking = braking};
  unit->acceleration = acceleration;
  unit->length = length / 1000.;
  return {.accepted = true, .control = controlOf(*unit)};
}

PositioningUnits::State PositioningUnits::control(const DrivenAxis& axis, uint32_t number, uint32_t feed, bool mp) {
  Unit* const unit = find(number);
  if (unit == nullptr) return {.status = statusOf(axis, number)};
  unit->feed = feed / 65536. / 60;
  unit->mp = mp;
  return {.status = statusOf(axis, number), .programmed = unit->programmed, .control = controlOf(*unit)};
}

void PositioningUnits::release(DrivenAxis& axis, uint32_t number) {
  Unit* const unit = find(number);
  if (unit == nullptr) return;
  axis.leave(unit->acceleration);
  *unit = {};
}

void PositioningUnits::lose(DrivenAxis& axis, uint32_t number) {
  if (!holds(number)) return;
  release(axis, number);
  fail(number);
}

void PositioningUnits::brakeAll() {
  for (Unit& unit : units_) {
    unit.feed = 0;
    unit.mp = false;
  }
}

uint8_t PositioningUnits::controlOf(const Unit& unit) {
  const uint8_t mp = unit.mp ? kControlMp : 0;
  if (!unit.underWay()) return mp;
  return static_cast<uint8_t>(mp | (unit.initiated ? kControlContinue : kControlInit));
}

uint16_t PositioningUnits::statusOf(const DrivenAxis& axis, uint32_t number) const {
  uint32_t status = has(errors_, number - 1) ? kUnitError : 0;
  const Unit* const unit = find(number);
  if (unit == nullptr) return static_cast<uint16_t>(status);
  status |= kUnitAvailable;
  if (axis.motion.speed() != 0) status |= kUnitMoves;
  if (unit->length < 0) status |= kUnitNegative;
  if (unit->arrived) status |= kUnitArrived;
  if (unit->programmed) status |= kUnitProgrammed;
  return static_cast<uint16_t>(status);
}

void PositioningUnits::drive(DrivenAxis& axis, uint32_t number, const AxisPermits& in) {
  Unit* const unit = find(number);
  if (unit == nullptr) return;
  if (unit->braking && axis.motion.isAtRest()) unit->braking = false;
  if (!unit->braking && unit->underWay()) follow(*unit, axis, number - 1, in);
  if (!unit->underWay() && axis.motion.isAtRest()) axis.requested = false;
}

void PositioningUnits::follow(Unit& unit, DrivenAxis& axis, uint32_t index, const AxisPermits& in) {
  if (!unit.placed) unit.target = axis.motion.position() + unit.length;
  unit.placed = unit.initiated = true;
  const bool wanted = unit.mp && unit.feed > 0;
  const bool negative = unit.length < 0;
  const Hold hold = holdOf(in, index, negative, in.enabled);
  if (wanted && hold == Hold::None) {
    axis.motion.moveTo(unit.target, std::min(unit.feed, axis.attributes.feedRT / 60), unit.acceleration);
  } else {
    axis.motion.stop(hold == Hold::Limit ? axis.attributes.accelerationEmergency : unit.acceleration); // l.6692
  }
  axis.request(negative);
  axis.requested = wanted || !axis.motion.isAtRest();
}

void PositioningUnits::look(DrivenAxis& axis, uint32_t number) {
  Unit* const unit = find(number);
  if (unit == nullptr || !unit->underWay() || !unit->placed) return;
  if (axis.motion.speed() != 0) unit->started = true;
  if (!axis.motion.isAtRestAt(unit->target) || !axis.settled) return;
  unit->arrived = true;
  axis.requested = false;
}

} // namespace rung::io
