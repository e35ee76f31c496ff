// The motion of PLC axes (see plc_axes.h).
#include "sim/gsk/plc_axes.h"

#include <algorithm>
#include <cmath>

namespace rung::sim::gsk {
namespace {

using nc::gsk::isAxisReference;
constexpr uint8_t kAllGroups = 0xFF;

bool isContinuous(uint8_t code) { return code == nc::gsk::kAxisContinuous || code == nc::gsk::kAxisSpeed; }
uint32_t referenceOf(uint8_t code) { return code - nc::gsk::kAxisReference1 + 1u; }

} // namespace

static_assert(nc::GskAxisGroups::kAxes == kAxes && nc::GskAxisGroups::kSlotMs == kSlotMs);

class PlcAxes::Mover final : public nc::GskAxisGroups::Mover {
public:
  using Command = nc::GskAxisGroups::Command;
  using Progress = nc::GskAxisGroups::Progress;

  Mover(PlcAxes& own, const nc::gsk::SignalsIo& io, Machine& machine) : own_(own), io_(io), machine_(machine) {}

  std::optional<uint32_t> groupOf(uint32_t axis) const override {
    if (axis >= machine_.axes.count()) return std::nullopt;
    const int64_t number = machine_.tables.parameter(kParamPlcGroup, axis);
    if (number < 1 || number > nc::gsk::kAxisGroups) return std::nullopt;
    return static_cast<uint32_t>(number - 1);
  }
  bool movesForCnc(uint32_t axis) const override { return machine_.axes[axis].moving; }
  void assigned(uint32_t axis, bool toProgram) override {
    const int bit = 1 << axis;
    machine_.plcAxes = static_cast<uint8_t>(toProgram ? machine_.plcAxes | bit : machine_.plcAxes & ~bit);
  }
  void raiseAssignment() override { machine_.alarms.raise(kAlarmPlcAxis); }

  bool begin(uint8_t axes, const Command& command) override;
  Progress move(uint8_t axes, const Command& command) override {
    const bool over = isContinuous(command.code) ? runContinuous(axes, command) : runMotion(axes, command);
    return over ? Progress::Over : Progress::UnderWay;
  }
  void pause(uint8_t axes) override {
    forAxes(axes, [&](uint32_t i) { machine_.axes[i].moving = false; });
  }
  void stop(uint8_t axes, bool cleared) override {
    forAxes(axes, [&](uint32_t i) {
      machine_.axes[i].moving = false;
      machine_.axes[i].rest = 0;
      if (cleared) machine_.axes[i].blockedPositive = machine_.axes[i].blockedNegative = false;
    });
  }
  nc::GskAxisGroups::Motion look(uint8_t axes) const override {
    nc::GskAxisGroups::Motion motion;
    forAxes(axes, [&](uint32_t i) {
      const Axis& axis = machine_.axes[i];
      motion.moving = motion.moving || axis.moving;
      motion.overPositive = motion.overPositive || axis.blockedPositive;
      motion.overNegative = motion.overNegative || axis.blockedNegative;
    });
    return motion;
  }

private:
  template <class Act>
  static void forAxes(uint8_t axes, Act act) {
    for (uint32_t i = 0; i < kAxes; ++i)
      if (((axes >> i) & 1) != 0) act(i);
  }
  bool runMotion(uint8_t axes, const Command& command);
  bool runContinuous(uint8_t axes, const Command& command);
  double cuttingOverride(uint32_t axis) const;
  double speed(const Command& command, uint32_t axis) const;

  PlcAxes& own_;
  const nc::gsk::SignalsIo& io_;
  Machine& machine_;
};

void PlcAxes::step(const nc::gsk::SignalsIo& io, Machine& machine, bool emergencyStop) {
  Mover mover(*this, io, machine);
  groups_.step(io, mover, kAllGroups, emergencyStop);
}

bool PlcAxes::Mover::begin(uint8_t axes, const Command& command) {
  bool good = true;
  forAxes(axes, [&](uint32_t i) {
    const Axis& axis = machine_.axes[i];
    if (isAxisReference(command.code)) {
      own_.target_[i] = Axes::reference(machine_.tables, i, referenceOf(command.code));
      if (!axis.referenced) { // l.7787
        machine_.alarms.raise(kAlarmNotReferenced);
        good = false;
      }
    } else if (command.code == nc::gsk::kAxisManualReturn) {
      own_.target_[i] = Axes::reference(machine_.tables, i, 1);
    } else {
      // Data 2 is in 0.1 um (P54): the units of the axes.
      own_.target_[i] =
          command.code == nc::gsk::kAxisMachineCoordinate ? command.data2 : axis.commanded + command.data2;
    }
    machine_.rapid = command.code != nc::gsk::kAxisFeed && command.code != nc::gsk::kAxisFeedPerTurn;
  });
  return good;
}

// The override by G151, G163, G175: 0-254 %, where 255 counts as 0, as for the CNC's own feed (l.8134); EOVC makes it
// 100 % (l.8146).
double PlcAxes::Mover::cuttingOverride(uint32_t axis) const {
  const nc::gsk::AxisGroup& place = nc::gsk::axisGroups()[groupOf(axis).value_or(0)];
  const bool cancelled = place.overrideCancel != 0 && io_.g(place.overrideCancel, 5);
  if (cancelled || place.feedOverride == 0) return 1;
  const uint8_t percent = io_.gByte(place.feedOverride);
  return percent == 255 ? 0 : percent / 100.0;
}

// The speed of the command with its override in mm/min (deg/min), limited by parameter 7122 (l.8277).
double PlcAxes::Mover::speed(const Command& command, uint32_t axis) const {
  const Tables& tables = machine_.tables;
  const double most = tables.parameterReal(kParamPlcMaxSpeed, axis);
  double speed = command.data1;
  switch (command.code) {
  case nc::gsk::kAxisFeed:
  case nc::gsk::kAxisSkip:
  case nc::gsk::kAxisContinuous: return std::min(most, speed * cuttingOverride(axis));
  case nc::gsk::kAxisFeedPerTurn:
    return std::min(most, speed / 10000 * std::fabs(machine_.spindle.actual()) * cuttingOverride(axis));
  case nc::gsk::kAxisManualReturn: speed = tables.parameterReal(kParamReturn, axis); break;
  default: break;
  }
  if (io_.g(150, 7)) return std::min(most, speed * io_.gByte(151) / 100.0); // EROV l.8156
  switch (io_.gByte(150) & 3) {
  case 0: return std::min({most, speed, tables.parameterReal(kParamRapidF0)}); // l.8168
  case 1: return std::min(most, speed / 4);
  case 2: return std::min(most, speed / 2);
  default: return std::min(most, speed);
  }
}

bool PlcAxes::Mover::runMotion(uint8_t axes, const Command& command) {
  const uint8_t code = command.code;
  if (code == nc::gsk::kAxisSkip && io_.x(13, 6)) { // ESKIP l.8186
    pause(axes);
    return true;
  }
  bool done = true;
  forAxes(axes, [&](uint32_t i) {
    const bool there = machine_.axes.moveTowards(i, own_.target_[i], unitsPerSlot(speed(command, i)));
    done = done && there;
  });
  if (!done) return false;
  forAxes(axes, [&](uint32_t i) {
    if (machine_.axes[i].machine != own_.target_[i]) return;
    if (code == nc::gsk::kAxisManualReturn) machine_.axes.arriveAtReference(i, 1);
    if (isAxisReference(code)) machine_.axes.arriveAtReference(i, referenceOf(code));
  });
  return true;
}

// A continuous motion, which only ECLR ends. A speed in r/min turns a rotary axis by 360 degrees per turn.
bool PlcAxes::Mover::runContinuous(uint8_t axes, const Command& command) {
  const bool jog = command.code == nc::gsk::kAxisContinuous;
  forAxes(axes, [&](uint32_t i) {
    const double turns = static_cast<int16_t>(command.data1);
    const bool negative = jog ? (command.data2 & 1) != 0 : turns < 0;
    const double units = unitsPerSlot(jog ? speed(command, i) : std::fabs(turns) * 360);
    const int64_t far = static_cast<int64_t>(units) + 1000;
    machine_.axes.moveTowards(i, machine_.axes[i].commanded + (negative ? -far : far), units);
  });
  return false;
}

} // namespace rung::sim::gsk
