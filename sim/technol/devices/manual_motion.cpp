// Manual motion.
#include "sim/technol/devices/manual_motion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/text/number.h"

namespace rung::sim::technol {

namespace {

constexpr uint32_t kShiftAxes = 6;    // l.10917
constexpr double kBackAtStop = 0.001; // mm

AxisMask enabledFor(const Axis& axis, const AxisInputs& in) {
  return axis.attributes.manEnable == 2 ? in.manualEnabled : in.enabled; // l.10861-10869
}
bool mayTake(const Axis& axis) { return !axis.spindle && (axis.mover == Mover::None || axis.mover == Mover::Manual); }
// MPxPI and limits brake harder than the end of a command (l.6428).
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
  if (axis.mover == Mover::Manual) axis.brake(axis.attributes.acceleration);
}

void ManualMotion::activate(const AxisInputs& in, AxisRequests& requests) {
  if (requests.autmanSelect) on_ = true;
  if (requests.autmanCancel) on_ = false;
  requests.autmanSelect = requests.autmanCancel = false; // whether granted or not (l.11022-11030)
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

// The speed in mm/min (l.10966-11009).
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

// Moves the preselected axis by `steps` mm.
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

// INPOS_STOP (l.10871): whether all axes have their positions from before the manual motion inside a block.
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
  if (shiftWasActive_ && !shiftActive_) panel.select(0, false); // the selection of an axis ends with it
  shiftWasActive_ = shiftActive_;
  const uint32_t selected = panel.selected();
  const bool may = shiftActive_ && selected != 0 && selected <= kShiftAxes && has(in.shiftEnable, selected - 1);
  shifting_ = may ? bitOf(selected - 1) : AxisMask{0};
  if (may) shifts_[selected - 1] += steps;
  if (!requests.shiftSelected) shifts_ = {}; // the axes return to the path
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

// Panels of manual motion.

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
  // A motion key also selects the axis for the handwheel, except with AUTMAN_WHEEL_DIS (l.11047).
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

// Commands of keys.

namespace {

using nc::technol::takePrefix;

struct Fixed {
  std::string_view name;
  RtmKind kind;
  int32_t value;
};
constexpr Fixed kFixed[] = {
    {"RAPIDTRAVERSE", RtmKind::Rapid, 0},
    {"HOLD", RtmKind::Hold, 0},
    {"KNOB_STEP_UP", RtmKind::KnobStepBy, 1},
    {"KNOB_STEP_DOWN", RtmKind::KnobStepBy, -1},
    {"KNOB_INC", RtmKind::KnobTurn, 1},
    {"KNOB_DEC", RtmKind::KnobTurn, -1},
    {"SHIFT_REQ", RtmKind::ShiftToggle, 0},
    {"SHIFT_ACT", RtmKind::ActivateToggle, 0},
    {"SHIFT_ENABLE", RtmKind::ShiftSelect, 1},
    {"SHIFT_DISABLE", RtmKind::ShiftSelect, 0},
    {"SHIFT_ACTIVATE", RtmKind::Activate, 1},
    {"SHIFT_DEACTIVATE", RtmKind::Activate, 0},
    {"KNOB_ENABLE1", RtmKind::KnobEnable, 1},
    {"KNOB_ENABLE2", RtmKind::KnobEnable, 2},
    {"KNOB_DISABLE1", RtmKind::KnobDisable, 1},
    {"KNOB_DISABLE2", RtmKind::KnobDisable, 2},
    {"MOVE_KNOB_STEP_UP", RtmKind::MoveOrStep, 1},
    {"MOVENEG_KNOB_STEP_DOWN", RtmKind::MoveOrStep, -1},
};

// Takes a number, 00 to 15.
std::optional<AxisMask> takeNumber(std::string_view& text) {
  if (text.size() < 2) return std::nullopt;
  const auto number = text::numberIn<uint32_t>(text.substr(0, 2));
  if (!number || *number >= kMaxAxes) return std::nullopt;
  text.remove_prefix(2);
  return bitOf(*number);
}

std::optional<AxisMask> takeLetter(std::string_view& text, std::string_view letters) {
  if (text.empty() || text[0] < 'X' || text[0] > 'Z') return std::nullopt;
  const size_t index = letters.find(text[0]);
  text.remove_prefix(1);
  return index < kMaxAxes ? bitOf(static_cast<uint32_t>(index)) : AxisMask{0};
}

void addDirection(std::string_view& text, AxisMask axes, RtmCommand& command) {
  AxisMask& mask = takePrefix(text, "NEG") ? command.minus : command.plus;
  mask = static_cast<AxisMask>(mask | axes);
}

// Parses the part after MOVE: 03NEGRT, X, XNEGY, NEGRT.
std::optional<RtmCommand> move(std::string_view text, std::string_view letters, RtmCommand command) {
  if (const auto axes = takeNumber(text)) {
    addDirection(text, *axes, command);
  } else {
    bool any = false;
    while (const auto letter = takeLetter(text, letters)) {
      any = true;
      addDirection(text, *letter, command);
    }
    if (!any) command.kind = RtmKind::MoveSelected;
    if (!any) command.value = takePrefix(text, "NEG") ? -1 : 1;
  }
  command.rapid = takePrefix(text, "RT");
  if (!text.empty()) return std::nullopt;
  return command;
}

std::optional<RtmCommand> select(std::string_view text, std::string_view letters, RtmCommand command) {
  const auto number = takeNumber(text);
  const auto axes = number ? number : takeLetter(text, letters);
  if (!axes || !text.empty()) return std::nullopt;
  command.kind = RtmKind::Select;
  command.plus = *axes;
  return command;
}

std::optional<RtmCommand> knobStep(std::string_view text, RtmCommand command) {
  const auto step = text::numberIn<int32_t>(text);
  if (!step || std::ranges::find(kKnobSteps, *step) == std::end(kKnobSteps)) return std::nullopt;
  command.kind = RtmKind::KnobStep;
  command.value = *step;
  return command;
}

} // namespace

std::optional<RtmCommand> rtmCommand(std::string_view name, std::string_view letters) {
  RtmCommand command;
  if (!takePrefix(name, "RTMID_")) return std::nullopt;
  command.manual = takePrefix(name, "I");
  if (!takePrefix(name, "MMM_")) return std::nullopt;
  for (const Fixed& fixed : kFixed)
    if (name == fixed.name) {
      command.kind = fixed.kind;
      command.value = fixed.value;
      return command;
    }
  if (takePrefix(name, "MOVE")) return move(name, letters, command);
  if (takePrefix(name, "SEL")) return select(name, letters, command);
  if (takePrefix(name, "KNOB_STEP")) return knobStep(name, command);
  return std::nullopt;
}

} // namespace rung::sim::technol
