// The motion of PLC axes (see plc_axes.h).
#include "sim/pmc/plc_axes.h"

#include <algorithm>
#include <cmath>

namespace rung::sim::pmc {
namespace {

using nc::pmc::isAxisReference;
constexpr uint8_t kAllGroups = 0xFF;

bool isContinuous(uint8_t code) { return code == nc::pmc::kAxisContinuous || code == nc::pmc::kAxisSpeed; }
uint32_t referenceOf(uint8_t code) { return code - nc::pmc::kAxisReference1 + 1u; }

} // namespace

static_assert(nc::PmcAxisGroups::kAxes == kAxes && nc::PmcAxisGroups::kSlotMs == kSlotMs);

class PlcAxes::Mover final : public nc::PmcAxisGroups::Mover {
public:
  using Command = nc::PmcAxisGroups::Command;
  using Progress = nc::PmcAxisGroups::Progress;

  Mover(PlcAxes& own, const nc::pmc::SignalsIo& io, Machine& machine) : own_(own), io_(io), machine_(machine) {}

  std::optional<uint32_t> groupOf(uint32_t axis) const override {
    if (axis >= machine_.axes.count()) return std::nullopt;
    const int64_t number = machine_.tables.parameter(machine_.cnc->parameters.plcGroup, axis);
    if (number < 1 || number > static_cast<int64_t>(machine_.cnc->model->axisGroups.size())) return std::nullopt;
    return static_cast<uint32_t>(number - 1);
  }
  bool movesForCnc(uint32_t axis) const override { return machine_.axes[axis].moving; }
  void assigned(uint32_t axis, bool toProgram) override {
    const int bit = 1 << axis;
    machine_.plcAxes = static_cast<uint8_t>(toProgram ? machine_.plcAxes | bit : machine_.plcAxes & ~bit);
  }
  void raiseAssignment() override { machine_.alarms.raise(machine_.cnc->alarms.plcAxis); }

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
  nc::PmcAxisGroups::Motion look(uint8_t axes) const override {
    nc::PmcAxisGroups::Motion motion;
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
  const nc::pmc::SignalsIo& io_;
  Machine& machine_;
};

void PlcAxes::step(const nc::pmc::SignalsIo& io, Machine& machine, bool emergencyStop) {
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
        machine_.alarms.raise(machine_.cnc->alarms.notReferenced);
        good = false;
      }
    } else if (command.code == nc::pmc::kAxisManualReturn) {
      own_.target_[i] = Axes::reference(machine_.tables, i, 1);
    } else {
      const int64_t units = command.data2 * machine_.cnc->axisUnits;
      own_.target_[i] = command.code == nc::pmc::kAxisMachineCoordinate ? units : axis.commanded + units;
    }
    machine_.rapid = command.code != nc::pmc::kAxisFeed && command.code != nc::pmc::kAxisFeedPerTurn;
  });
  return good;
}

// The override by G151, G163, G175: 0-254 %, where 255 counts as 0, as for the CNC's own feed (l.8134); EOVC makes it
// 100 % (l.8146).
double PlcAxes::Mover::cuttingOverride(uint32_t axis) const {
  const nc::pmc::AxisGroup& place = machine_.cnc->model->axisGroups[groupOf(axis).value_or(0)];
  const bool cancelled = place.overrideCancel != 0 && io_.g(place.overrideCancel, 5);
  if (cancelled || place.feedOverride == 0) return 1;
  return nc::pmc::overridePercent(*machine_.cnc->model, io_.gByte(place.feedOverride)) / 100.0;
}

// The speed of the command with its override in mm/min (deg/min), limited by parameter 7122 (l.8277).
double PlcAxes::Mover::speed(const Command& command, uint32_t axis) const {
  const Tables& tables = machine_.tables;
  const Cnc& cnc = *machine_.cnc;
  const double most = tables.parameterReal(cnc.parameters.plcMaxSpeed, axis);
  double speed = command.data1;
  switch (command.code) {
  case nc::pmc::kAxisFeed:
  case nc::pmc::kAxisSkip:
  case nc::pmc::kAxisContinuous: return std::min(most, speed * cuttingOverride(axis));
  case nc::pmc::kAxisFeedPerTurn:
    return std::min(most, speed / cnc.perTurnSteps * std::fabs(machine_.spindle.actual()) * cuttingOverride(axis));
  case nc::pmc::kAxisManualReturn: speed = tables.parameterReal(cnc.parameters.manualReturn, axis); break;
  default:
    if (cnc.rapidOfParameter && speed == 0) speed = tables.parameterReal(cnc.parameters.rapid, axis);
    break;
  }
  if (cnc.rapidByFeed && io_.g(150, 7)) return std::min(most, speed * io_.gByte(151) / 100.0); // EROV l.8156
  switch (rapidStep(cnc, io_.gByte(150))) {
  case 0: return std::min({most, speed, tables.parameterReal(cnc.parameters.rapidF0, axis)}); // l.8168
  case 1: return std::min(most, speed / 4);
  case 2: return std::min(most, speed / 2);
  default: return std::min(most, speed);
  }
}

bool PlcAxes::Mover::runMotion(uint8_t axes, const Command& command) {
  const uint8_t code = command.code;
  const nc::pmc::BitPlace skip = machine_.cnc->axisSkip;
  if (code == nc::pmc::kAxisSkip && io_.x(skip.byte, skip.bit)) { // ESKIP l.8186
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
    if (code == nc::pmc::kAxisManualReturn) machine_.axes.arriveAtReference(i, 1);
    if (isAxisReference(code)) machine_.axes.arriveAtReference(i, referenceOf(code));
  });
  return true;
}

// A continuous motion, which only ECLR ends. A speed in r/min turns a rotary axis by 360 degrees per turn.
bool PlcAxes::Mover::runContinuous(uint8_t axes, const Command& command) {
  const bool jog = command.code == nc::pmc::kAxisContinuous;
  forAxes(axes, [&](uint32_t i) {
    const double turns = static_cast<int16_t>(command.data1);
    const bool negative = jog ? (command.data2 & 1) != 0 : turns < 0;
    const double units = unitsPerSlot(jog ? speed(command, i) : std::fabs(turns) * 360);
    const int64_t far = static_cast<int64_t>(units) + 1000;
    machine_.axes.moveTowards(i, machine_.axes[i].commanded + (negative ? -far : far), units);
  });
  return false;
}

} // namespace rung::sim::pmc
