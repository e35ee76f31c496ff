// Panels of manual motion (see manual_panel.h).
#include "sim/technol/devices/manual_panel.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace rung::sim::technol {
namespace {

void add(AxisMask& mask, AxisMask bits) { mask = static_cast<AxisMask>(mask | bits); }
void remove(AxisMask& mask, AxisMask bits) { mask = static_cast<AxisMask>(mask & ~bits); }

// The next larger or smaller step of the series.
uint16_t neighbour(uint16_t step, bool larger) {
  if (larger) {
    const auto* const next = std::ranges::upper_bound(kKnobSteps, step);
    return next == std::end(kKnobSteps) ? step : *next;
  }
  const auto* const own = std::ranges::lower_bound(kKnobSteps, step);
  return own == std::begin(kKnobSteps) ? step : *(own - 1);
}

} // namespace

void ManualPanel::key(const RtmCommand& command, bool pressed) {
  if (pressed)
    press(command);
  else if (!hold_)
    release(command);
}

void ManualPanel::press(const RtmCommand& command) {
  if (command.manual) manual_ = true;
  switch (command.kind) {
  case RtmKind::Move:
    add(plus_, command.plus);
    add(minus_, command.minus);
    if (command.rapid) add(rapidAxes_, static_cast<AxisMask>(command.plus | command.minus));
    add(moved_, static_cast<AxisMask>(command.plus | command.minus));
    return;
  case RtmKind::MoveSelected:
    moveSelected_ = command.value;
    selectedRapid_ = command.rapid;
    return;
  case RtmKind::Select: choose_ = command.plus; return;
  case RtmKind::Rapid: rapidKey_ = true; return;
  case RtmKind::Hold:
    hold_ = !hold_;
    if (!hold_) releaseKeys();
    return;
  case RtmKind::KnobStep: stepTo_ = command.value; return;
  case RtmKind::KnobStepBy: stepBy_ += command.value; return;
  case RtmKind::KnobTurn: return turn(command.value);
  case RtmKind::KnobEnable:
  case RtmKind::KnobDisable:
    wheelsOff_[static_cast<size_t>(command.value) - 1] = command.kind == RtmKind::KnobDisable;
    return;
  case RtmKind::MoveOrStep:
    moveOrStep_ = command.value;
    moveOrStepHeld_ = true;
    return;
  case RtmKind::ShiftToggle: toggleShift_ = !toggleShift_; return;
  case RtmKind::ShiftSelect: shiftSelect_ = command.value != 0; return;
  case RtmKind::ActivateToggle: toggleActive_ = !toggleActive_; return;
  case RtmKind::Activate: shiftActivate_ = command.value != 0; return;
  }
}

void ManualPanel::release(const RtmCommand& command) {
  if (command.kind == RtmKind::Rapid) rapidKey_ = false;
  if (command.kind == RtmKind::MoveSelected || command.kind == RtmKind::MoveOrStep) {
    moveSelected_ = 0;
    selectedRapid_ = moveOrStepHeld_ = false;
  }
  if (command.kind != RtmKind::Move) return;
  remove(plus_, command.plus);
  remove(minus_, command.minus);
  remove(rapidAxes_, static_cast<AxisMask>(command.plus | command.minus));
}

void ManualPanel::releaseKeys() {
  plus_ = minus_ = rapidAxes_ = 0;
  moveSelected_ = moveOrStep_ = 0;
  selectedRapid_ = rapidKey_ = hold_ = moveOrStepHeld_ = false;
}

void ManualPanel::select(uint32_t axis, bool byKey) {
  selected_ = axis;
  selectedByKey_ = byKey && axis != 0;
}

AxisMask ManualPanel::plus() const { return static_cast<AxisMask>(plus_ | (moveSelected_ > 0 ? selectedBit() : 0)); }
AxisMask ManualPanel::minus() const { return static_cast<AxisMask>(minus_ | (moveSelected_ < 0 ? selectedBit() : 0)); }

void ManualPanel::settle(const AxisInputs& in, AxisRequests& requests) {
  const auto first = [](AxisMask axes) { return axes == 0 ? 0 : static_cast<uint32_t>(std::countr_zero(axes)) + 1; };
  // A key of motion selects the axis for the handwheel as well, but for AUTMAN_WHEEL_DIS (l.11047).
  if (moved_ != 0 && !in.noWheelSelect) select(first(moved_), false);
  if (choose_ != 0) {
    const bool again = in.selectToggles && selecting() && selected_ == first(choose_); // AUTMAN_KNOB_TOGGLE l.11050
    select(again ? 0 : first(choose_), true);
  }
  moved_ = choose_ = 0;
  if (requests.shiftSelected)
    stepBy_ += moveOrStep_;
  else if (moveOrStep_ != 0 && moveOrStepHeld_)
    moveSelected_ = moveOrStep_;
  moveOrStep_ = 0;
  if (stepTo_ != 0) requests.knobStep = static_cast<uint16_t>(stepTo_);
  for (; stepBy_ != 0; stepBy_ += stepBy_ < 0 ? 1 : -1) requests.knobStep = neighbour(requests.knobStep, stepBy_ > 0);
  stepTo_ = 0;
  if (toggleShift_) requests.shiftSelected = !requests.shiftSelected;
  if (shiftSelect_) requests.shiftSelected = *shiftSelect_;
  if (toggleActive_) requests.shiftActive = !requests.shiftActive;
  if (shiftActivate_) requests.shiftActive = *shiftActivate_;
  if (!requests.shiftSelected && (toggleShift_ || shiftSelect_)) requests.shiftActive = false;
  toggleShift_ = toggleActive_ = false;
  shiftSelect_ = shiftActivate_ = std::nullopt;
}

} // namespace rung::sim::technol
