// PLC axis control (see plc_axes.h).
#include "tools/sim/gsk/plc_axes.h"

#include <cmath>
#include <limits>

namespace rung::sim::gsk {
namespace {

enum Code : uint8_t {
  kRapid = 0,
  kCutting = 1,
  kCuttingPerTurn = 2,
  kSkip = 3,
  kDwell = 4,
  kManualReturn = 5,
  kContinuous = 6,
  kReference1 = 7,
  kReference4 = 10,
  kSpeed = 16,
  kAux1 = 18,
  kAux2 = 20,
  kAux3 = 21,
  kMachineCoordinate = 32,
};

bool isReference(uint8_t code) { return code >= kReference1 && code <= kReference4; }
bool isAuxiliary(uint8_t code) { return code == kAux1 || code == kAux2 || code == kAux3; }
bool isContinuous(uint8_t code) { return code == kContinuous || code == kSpeed; }
uint8_t strobeOf(uint8_t code) {
  return code == kAux1 ? nc::gsk::kEmfBit : code == kAux2 ? nc::gsk::kEmf2Bit : nc::gsk::kEmf3Bit;
}

} // namespace

struct PlcAxes::Step {
  const nc::gsk::SignalsIo& io;
  Machine& machine;
  Group& group;
  const nc::gsk::AxisGroup& place;
  bool control(uint8_t bit) const { return io.g(place.control, bit); }
  template <class Act>
  void forAxes(Act act) const {
    for (uint32_t i = 0; i < machine.axes.count(); ++i)
      if (((group.axes >> i) & 1) != 0) act(i);
  }
};

void PlcAxes::step(const nc::gsk::SignalsIo& io, Machine& machine, bool emergencyStop) {
  assign(io, machine);
  for (uint32_t g = 0; g < nc::gsk::kAxisGroups; ++g) {
    Step step{io, machine, groups_[g], nc::gsk::axisGroups()[g]};
    if (step.control(nc::gsk::kEclrBit) || emergencyStop) {
      clear(step.group, step.place, io, machine);
      step.group.ebsy = step.control(nc::gsk::kEbufBit); // what comes now is lost (l.7891)
    } else {
      take(step);
      execute(step);
    }
    writeGroup(step);
  }
  writeCommon(io, machine);
}

// EAX may change only while *EAXSL is 0, and not under the CNC's own motion (l.7817).
void PlcAxes::assign(const nc::gsk::SignalsIo& io, Machine& machine) {
  const uint8_t wanted = io.gByte(136);
  for (uint32_t i = 0; i < machine.axes.count(); ++i) {
    const int64_t number = machine.tables.parameter(kParamPlcGroup, i);
    if (number < 1 || number > nc::gsk::kAxisGroups) continue;
    Group& group = groups_[static_cast<size_t>(number - 1)];
    const int bit = 1 << i;
    const bool give = (wanted & bit) != 0;
    if (give == machine.isPlcAxis(i)) continue;
    if (give ? machine.axes[i].moving : selected_) {
      machine.alarms.raise(kAlarmPlcAxis);
      group.alarm = true;
    }
    if (!give) clear(group, nc::gsk::axisGroups()[static_cast<size_t>(number - 1)], io, machine); // l.7703
    machine.plcAxes = static_cast<uint8_t>(give ? machine.plcAxes | bit : machine.plcAxes & ~bit);
    group.axes = static_cast<uint8_t>(give ? group.axes | bit : group.axes & ~bit);
  }
}

// Stops, empties the buffers, takes strobe, code and alarm away (l.7883-7897, 8058).
void PlcAxes::clear(Group& group, const nc::gsk::AxisGroup& place, const nc::gsk::SignalsIo& io, Machine& machine) {
  const bool alarm = group.alarm && !io.g(place.control, nc::gsk::kEclrBit);
  const uint8_t axes = group.axes;
  const bool ebsy = group.ebsy;
  for (uint32_t i = 0; i < kAxes; ++i)
    if (((axes >> i) & 1) != 0) {
      machine.axes[i].moving = false;
      machine.axes[i].rest = 0;
      if (io.g(place.control, nc::gsk::kEclrBit))
        machine.axes[i].blockedPositive = machine.axes[i].blockedNegative = false;
    }
  group = {};
  group.axes = axes;
  group.ebsy = ebsy;
  group.alarm = alarm;
  io.setFByte(place.code, 0);
}

// A block is there while EBUF and EBSY differ (l.7695-7699).
void PlcAxes::take(Step& step) {
  Group& group = step.group;
  if (step.control(nc::gsk::kEbufBit) == group.ebsy || group.axes == 0) return;
  const uint8_t first = step.io.gByte(step.place.command);
  const Command command{.code = static_cast<uint8_t>(first & nc::gsk::kAxisCommandBits),
                        .noStop = (first & ~nc::gsk::kAxisCommandBits) != 0,
                        .data1 = step.io.gWord(step.place.data1()),
                        .data2 = static_cast<int32_t>(step.io.gDword(step.place.data2()))};
  const nc::gsk::AxisCommand* known = nc::gsk::findAxisCommand(command.code);
  if (known == nullptr) {
    group.alarm = true;
    group.ebsy = !group.ebsy;
    return;
  }
  const bool same = group.executing && group.executing->code == command.code;
  if (known->buffering == nc::gsk::AxisBuffering::Immediate && same) {
    group.executing = command; // only the speed changes (l.7771, 7803)
  } else if (known->buffering != nc::gsk::AxisBuffering::Buffered || step.control(nc::gsk::kEmcufBit)) {
    if (group.busy()) return; // l.7992
    group.executing = command;
  } else if (!group.executing) {
    group.executing = command;
  } else if (!group.waiting) {
    group.waiting = command;
  } else if (!group.input) {
    group.input = command;
  } else {
    return;
  }
  group.ebsy = !group.ebsy;
}

void PlcAxes::shift(Step& step, const Command& ended) {
  Group& group = step.group;
  group.blockStop = step.control(nc::gsk::kEsbkBit) && !ended.noStop; // l.7915-7919
  group.executing = group.waiting;
  group.waiting = group.input;
  group.input.reset();
  group.begun = false;
}

void PlcAxes::execute(Step& step) {
  Group& group = step.group;
  if (!step.control(nc::gsk::kEsbkBit)) group.blockStop = false;
  group.pausing = step.control(nc::gsk::kEstpBit) || step.control(nc::gsk::kEsofBit);
  if (!group.executing || group.blockStop || group.alarm) return;
  const Command command = *group.executing;
  if (isAuxiliary(command.code)) {
    if (runAuxiliary(step, command)) shift(step, command);
    return;
  }
  if (group.pausing) {
    step.forAxes([&](uint32_t i) { step.machine.axes[i].moving = false; });
    return;
  }
  if (!group.begun) begin(step, command);
  if (group.alarm) return;
  if (isContinuous(command.code) ? runContinuous(step, command) : runMotion(step, command)) shift(step, command);
}

void PlcAxes::begin(Step& step, const Command& command) {
  Group& group = step.group;
  group.begun = true;
  group.dwellMs = command.code == kDwell ? std::max(command.data2, 0) : 0;
  step.forAxes([&](uint32_t i) {
    Axis& axis = step.machine.axes[i];
    if (isReference(command.code)) {
      group.target[i] = Axes::reference(step.machine.tables, i, command.code - kReference1 + 1u);
      if (!axis.referenced) { // l.7787
        step.machine.alarms.raise(kAlarmNotReferenced);
        group.alarm = true;
      }
    } else if (command.code == kManualReturn) {
      group.target[i] = Axes::reference(step.machine.tables, i, 1);
    } else {
      // Data 2 is in 0.1 um (P54): the units of the axes.
      group.target[i] = command.code == kMachineCoordinate ? command.data2 : axis.commanded + command.data2;
    }
    if (command.code != kDwell) step.machine.rapid = command.code != kCutting && command.code != kCuttingPerTurn;
  });
}

// G151, G163, G175: 0-254 %, 255 counts as 0 as for the CNC's own feed (l.8134); EOVC makes it 100 % (l.8146).
double PlcAxes::cuttingOverride(const Step& step) const {
  const bool cancelled = step.place.overrideCancel != 0 && step.io.g(step.place.overrideCancel, 5);
  if (cancelled || step.place.feedOverride == 0) return 1;
  const uint8_t percent = step.io.gByte(step.place.feedOverride);
  return percent == 255 ? 0 : percent / 100.0;
}

// mm/min (deg/min) of the command with its override, within parameter 7122 (l.8277).
double PlcAxes::speed(const Step& step, const Command& command, uint32_t axis) const {
  const Tables& tables = step.machine.tables;
  const double most = tables.parameterReal(kParamPlcMaxSpeed, axis);
  double speed = command.data1;
  switch (command.code) {
  case kCutting:
  case kSkip:
  case kContinuous: return std::min(most, speed * cuttingOverride(step));
  case kCuttingPerTurn:
    return std::min(most, speed / 10000 * std::fabs(step.machine.spindle.actual()) * cuttingOverride(step));
  case kManualReturn: speed = tables.parameterReal(kParamReturn, axis); break;
  default: break;
  }
  if (step.io.g(150, 7)) return std::min(most, speed * step.io.gByte(151) / 100.0); // EROV l.8156
  switch (step.io.gByte(150) & 3) {
  case 0: return std::min({most, speed, tables.parameterReal(kParamRapidF0)}); // l.8168
  case 1: return std::min(most, speed / 4);
  case 2: return std::min(most, speed / 2);
  default: return std::min(most, speed);
  }
}

bool PlcAxes::runMotion(Step& step, const Command& command) {
  Group& group = step.group;
  const uint8_t code = command.code;
  if (code == kDwell) {
    group.dwellMs -= kSlotMs;
    return group.dwellMs <= 0;
  }
  if (code == kSkip && step.io.x(13, 6)) { // ESKIP l.8186
    step.forAxes([&](uint32_t i) { step.machine.axes[i].moving = false; });
    return true;
  }
  bool done = true;
  step.forAxes([&](uint32_t i) {
    const bool there = step.machine.axes.moveTowards(i, group.target[i], unitsPerSlot(speed(step, command, i)));
    done = done && there;
  });
  if (!done) return false;
  step.forAxes([&](uint32_t i) {
    if (step.machine.axes[i].machine != group.target[i]) return;
    if (code == kManualReturn) step.machine.axes.arriveAtReference(i, 1);
    if (isReference(code)) step.machine.axes.arriveAtReference(i, code - kReference1 + 1u);
  });
  return true;
}

// Ended by ECLR only. A speed in r/min turns a rotary axis by 360 degrees a turn.
bool PlcAxes::runContinuous(Step& step, const Command& command) {
  step.forAxes([&](uint32_t i) {
    const double turns = static_cast<int16_t>(command.data1);
    const bool negative = command.code == kContinuous ? (command.data2 & 1) != 0 : turns < 0;
    const double units = unitsPerSlot(command.code == kContinuous ? speed(step, command, i) : std::fabs(turns) * 360);
    const int64_t far = static_cast<int64_t>(units) + 1000;
    step.machine.axes.moveTowards(i, step.machine.axes[i].commanded + (negative ? -far : far), units);
  });
  return false;
}

// As with M (l.7970): code, strobe, EFIN, strobe away, EFIN away, code away.
bool PlcAxes::runAuxiliary(Step& step, const Command& command) {
  Group& group = step.group;
  const uint8_t strobe = strobeOf(command.code);
  switch (group.aux) {
  case AuxPhase::None:
    step.io.setFByte(step.place.code, static_cast<uint8_t>(command.data2));
    group.aux = AuxPhase::Code;
    return false;
  case AuxPhase::Code:
    step.io.setF(step.place.strobes, strobe, true);
    group.aux = AuxPhase::Strobe;
    return false;
  case AuxPhase::Strobe:
    if (!step.control(nc::gsk::kEfinBit)) return false;
    step.io.setF(step.place.strobes, strobe, false);
    group.aux = AuxPhase::EfinFalls;
    return false;
  case AuxPhase::EfinFalls:
    if (step.control(nc::gsk::kEfinBit)) return false;
    step.io.setFByte(step.place.code, 0);
    group.aux = AuxPhase::None;
    return true;
  }
  return false;
}

void PlcAxes::writeGroup(Step& step) {
  Group& group = step.group;
  bool moving = false, positive = false, negative = false;
  step.forAxes([&](uint32_t i) {
    const Axis& axis = step.machine.axes[i];
    moving = moving || axis.moving;
    positive = positive || axis.blockedPositive;
    negative = negative || axis.blockedNegative;
  });
  const uint32_t status = step.place.status;
  step.io.setF(status, nc::gsk::kEbsyBit, group.ebsy);
  step.io.setF(status, nc::gsk::kEotnBit, negative);
  step.io.setF(status, nc::gsk::kEotpBit, positive);
  step.io.setF(status, nc::gsk::kEgenBit, moving);
  step.io.setF(status, nc::gsk::kEdenBit, group.aux != AuxPhase::None);
  step.io.setF(status, nc::gsk::kEialBit, group.alarm || positive || negative); // l.8122
  step.io.setF(status, nc::gsk::kEckzBit, group.axes != 0 && !moving);
  step.io.setF(status, nc::gsk::kEinpBit, group.axes != 0 && !moving);
  step.io.setF(step.place.strobes, nc::gsk::kEabufBit, group.input.has_value());
  if (group.aux == AuxPhase::Strobe) return;
  for (uint8_t bit : {nc::gsk::kEmfBit, nc::gsk::kEmf2Bit, nc::gsk::kEmf3Bit})
    step.io.setF(step.place.strobes, bit, false);
}

void PlcAxes::writeCommon(const nc::gsk::SignalsIo& io, const Machine& machine) {
  selected_ = false;
  uint8_t controlled = 0, distributed = 0;
  bool anyAxis = false;
  for (uint32_t g = 0; g < nc::gsk::kAxisGroups; ++g) {
    const Group& group = groups_[g];
    anyAxis = anyAxis || group.axes != 0;
    const bool active =
        group.axes != 0 && (group.busy() || io.g(nc::gsk::axisGroups()[g].control, nc::gsk::kEsofBit)); // l.8024-8030
    selected_ = selected_ || active;
    if (active) controlled = static_cast<uint8_t>(controlled | group.axes); // l.8222
    const bool paused = group.pausing && group.executing && !isAuxiliary(group.executing->code);
    for (uint32_t i = 0; i < machine.axes.count(); ++i)
      if (((group.axes >> i) & 1) != 0 && !machine.axes[i].moving && !paused)
        distributed = static_cast<uint8_t>(distributed | 1 << i); // l.8198
  }
  const uint8_t feed = io.gByte(151);
  io.setF(129, 7, selected_);
  io.setF(129, 5, anyAxis && !io.g(150, 5) && (feed == 0 || feed == 255)); // EOV0 l.8178
  io.setFByte(112, distributed);
  io.setFByte(182, controlled);
}

} // namespace rung::sim::gsk
