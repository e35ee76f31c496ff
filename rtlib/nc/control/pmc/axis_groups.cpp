// PMC axis control (see axis_groups.h).
#include "rtlib/nc/control/pmc/axis_groups.h"

#include <algorithm>

namespace rung::nc {
namespace {

using namespace pmc;

constexpr uint32_t kSelection = 136; // EAX1-EAX8

bool isAuxiliary(uint8_t code) { return code == kAxisAux1 || code == kAxisAux2 || code == kAxisAux3; }
bool moves(const std::optional<PmcAxisGroups::Command>& block) {
  return block && !isAuxiliary(block->code) && block->code != kAxisDwell;
}
uint8_t strobeOf(uint8_t code) { return code == kAxisAux1 ? kEmfBit : code == kAxisAux2 ? kEmf2Bit : kEmf3Bit; }

} // namespace

struct PmcAxisGroups::Step {
  const Model& model;
  const SignalsIo& io;
  Mover& mover;
  Group& group;
  const AxisGroup& place;
  bool control(uint8_t bit) const { return io.g(place.control, bit); }
};

void PmcAxisGroups::step(const SignalsIo& io, Mover& mover, uint8_t served, bool emergencyStop) {
  assign(io, mover, served);
  for (uint32_t g = 0; g < count(); ++g) {
    if ((served >> g & 1) == 0) continue;
    const Step step{*model_, io, mover, groups_[g], model_->axisGroups[g]};
    if (step.control(kEclrBit) || emergencyStop) {
      clear(step);
      step.group.ebsy = step.control(kEbufBit); // blocks that arrive now are lost (l.7891)
    } else {
      take(step);
      execute(step);
    }
    writeGroup(step);
  }
  writeCommon(io, mover);
}

// EAX may change only while *EAXSL is 0, and not during a motion of the CNC (l.7817).
void PmcAxisGroups::assign(const SignalsIo& io, Mover& mover, uint8_t served) {
  const uint8_t wanted = io.gByte(kSelection);
  uint8_t held = 0;
  for (const Group& group : groups_) held = static_cast<uint8_t>(held | group.axes);
  if (wanted == held) return;
  for (uint32_t i = 0; i < kAxes; ++i) {
    const int bit = 1 << i;
    const bool give = (wanted & bit) != 0;
    const auto holder = std::ranges::find_if(groups_, [&](const Group& group) { return (group.axes & bit) != 0; });
    if (give == (holder != groups_.end())) continue;
    const std::optional<uint32_t> number = give ? mover.groupOf(i) : static_cast<uint32_t>(holder - groups_.begin());
    if (!number || (served >> *number & 1) == 0) continue;
    Group& group = groups_[*number];
    if (give ? mover.movesForCnc(i) : selected_) {
      mover.raiseAssignment();
      group.alarm = true;
    }
    if (!give) clear({*model_, io, mover, group, model_->axisGroups[*number]}); // l.7703
    mover.assigned(i, give);
    group.axes = static_cast<uint8_t>(give ? group.axes | bit : group.axes & ~bit);
  }
}

// Stops the axes, empties the buffers, and clears strobe, code and alarm (l.7883-7897, 8058).
void PmcAxisGroups::clear(const Step& step) {
  Group& group = step.group;
  const bool byProgram = step.control(kEclrBit);
  step.mover.stop(group.axes, byProgram);
  group = {.axes = group.axes, .ebsy = group.ebsy, .alarm = group.alarm && !byProgram};
  step.io.setFByte(step.place.code, 0);
}

// A block is present while EBUF and EBSY differ (l.7695-7699).
void PmcAxisGroups::take(const Step& step) {
  Group& group = step.group;
  if (step.control(kEbufBit) == group.ebsy || group.axes == 0) return;
  const uint8_t first = step.io.gByte(step.place.command);
  const Command command{.code = static_cast<uint8_t>(first & kAxisCommandBits),
                        .noStop = (first & ~kAxisCommandBits) != 0,
                        .data1 = step.io.gWord(step.place.data1()),
                        .data2 = static_cast<int32_t>(step.io.gDword(step.place.data2()))};
  const AxisCommand* known = findAxisCommand(step.model.axisCommands, command.code);
  if (known == nullptr) {
    group.alarm = true;
    group.ebsy = !group.ebsy;
    return;
  }
  const bool same = group.executing && group.executing->code == command.code;
  if (known->buffering == AxisBuffering::Immediate && same) {
    group.executing = command; // only the speed changes (l.7771, 7803)
    if (group.begun) step.mover.change(group.axes, command);
  } else if (known->buffering != AxisBuffering::Buffered || step.control(kEmcufBit)) {
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

void PmcAxisGroups::shift(const Step& step, const Command& ended) {
  Group& group = step.group;
  group.blockStop = step.control(kEsbkBit) && !ended.noStop; // l.7915-7919
  group.executing = group.waiting;
  group.waiting = group.input;
  group.input.reset();
  group.begun = false;
}

void PmcAxisGroups::execute(const Step& step) {
  Group& group = step.group;
  if (!step.control(kEsbkBit)) group.blockStop = false;
  group.pausing = step.control(kEstpBit) || step.control(kEsofBit);
  if (!group.executing || group.blockStop || group.alarm) return;
  const Command command = *group.executing;
  if (isAuxiliary(command.code)) {
    if (runAuxiliary(step, command)) shift(step, command);
    return;
  }
  if (group.pausing) return step.mover.pause(group.axes);
  if (!group.begun) begin(step, command);
  if (group.begun && !group.alarm && isOver(step, command)) shift(step, command);
}

void PmcAxisGroups::begin(const Step& step, const Command& command) {
  Group& group = step.group;
  if (step.mover.look(group.axes).stopping) return;
  group.begun = true;
  if (command.code == kAxisDwell)
    group.dwellMs = std::max(command.data2, 0);
  else
    group.alarm = !step.mover.begin(group.axes, command);
}

bool PmcAxisGroups::isOver(const Step& step, const Command& command) {
  Group& group = step.group;
  if (command.code == kAxisDwell) {
    group.dwellMs -= kSlotMs;
    return group.dwellMs <= 0;
  }
  const Progress progress = step.mover.move(group.axes, command);
  group.alarm = progress == Progress::Failed;
  return progress == Progress::Over;
}

// As for M (l.7970): code, strobe, EFIN, end of strobe, end of EFIN, end of code.
bool PmcAxisGroups::runAuxiliary(const Step& step, const Command& command) {
  Group& group = step.group;
  switch (group.aux) {
  case AuxPhase::None:
    step.io.setFByte(step.place.code, static_cast<uint8_t>(command.data2));
    group.aux = AuxPhase::Code;
    return false;
  case AuxPhase::Code: group.aux = AuxPhase::Strobe; return false;
  case AuxPhase::Strobe:
    if (step.control(kEfinBit)) group.aux = AuxPhase::EfinFalls;
    return false;
  case AuxPhase::EfinFalls:
    if (step.control(kEfinBit)) return false;
    step.io.setFByte(step.place.code, 0);
    group.aux = AuxPhase::None;
    return true;
  }
  return false;
}

void PmcAxisGroups::writeGroup(const Step& step) {
  Group& group = step.group;
  const Motion motion = step.mover.look(group.axes);
  const bool atRest = group.axes != 0 && !motion.moving && !motion.unknown;
  const bool hasMotion = moves(group.executing) || moves(group.waiting) || moves(group.input);
  group.alarm = group.alarm || motion.lost || (motion.unknown && hasMotion);    // no pending motion begins later
  const bool alarm = group.alarm || motion.overPositive || motion.overNegative; // l.8122
  step.io.setFByte(step.place.status,
                   static_cast<uint8_t>(group.ebsy << kEbsyBit | motion.overNegative << kEotnBit |
                                        motion.overPositive << kEotpBit | motion.moving << kEgenBit |
                                        (group.aux != AuxPhase::None) << kEdenBit | alarm << kEialBit |
                                        atRest << kEckzBit | atRest << kEinpBit));
  const int strobe = group.aux == AuxPhase::Strobe ? 1 << strobeOf(group.executing->code) : 0;
  step.io.setFByte(step.place.strobes, static_cast<uint8_t>(strobe | group.input.has_value() << kEabufBit));
}

void PmcAxisGroups::writeCommon(const SignalsIo& io, const Mover& mover) {
  selected_ = false;
  uint8_t controlled = 0, distributed = 0;
  bool anyAxis = false;
  for (uint32_t g = 0; g < count(); ++g) {
    const Group& group = groups_[g];
    if (group.axes == 0) continue;
    anyAxis = true;
    const bool active =
        group.busy() || io.g(model_->axisGroups[g].control, kEsofBit) || mover.look(group.axes).stopping; // l.8024-8030
    selected_ = selected_ || active;
    if (active) controlled = static_cast<uint8_t>(controlled | group.axes); // l.8222
    const bool paused = group.pausing && group.executing && !isAuxiliary(group.executing->code);
    for (uint32_t i = 0; i < kAxes; ++i) {
      const auto axis = static_cast<uint8_t>(group.axes & 1 << i);
      const Motion motion = mover.look(axis);
      if (axis != 0 && !motion.moving && !motion.unknown && !paused)
        distributed = static_cast<uint8_t>(distributed | axis); // l.8198
    }
  }
  const bool stopped = anyAxis && !io.g(150, 5) && overridePercent(*model_, io.gByte(151)) == 0; // EOV0 l.8178
  io.setFByte(129, static_cast<uint8_t>(selected_ << 7 | stopped << 5));
  io.setFByte(112, distributed);
  io.setFByte(182, controlled);
}

} // namespace rung::nc
