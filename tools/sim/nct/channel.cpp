// Modes, conditions, start and stop of a channel (see channel.h). Execution of blocks: channel_run.cpp.
#include "tools/sim/nct/channel.h"

#include <algorithm>

#include "tools/sim/nct/macros.h"
#include "tools/sim/nct/spindles.h"
#include "tools/sim/nct/tool_management.h"

namespace rung::sim::nct {

Channel::Channel(Links& links, uint32_t number, const ChannelSignals& signals, const ChannelParameters& parameters)
    : links_(links), channel_(number), signals_(signals), parameters_(parameters), handover_(links, number),
      automaticRun_(ChannelMotion(links, number, signals, parameters)),
      otherRun_(ChannelMotion(links, number, signals, parameters)) {}

void Channel::powerOn() {
  clear(automaticRun_);
  clear(otherRun_);
  automaticRun_.motion.reset(true);
  otherRun_.motion.reset(true);
  handover_.dropStrobes();
  mode_ = wanted_ = Mode::Jog;
  toggles_ = toggleBefore_ = {};
  modeBefore_ = {};
  startBefore_ = machineOn_ = false;
  start_ = stop_ = interrupted_ = restart_ = return_ = fresh_ = false;
  sequence_ = 0;
  hasEntered_ = false;
}

void Channel::clear(Run& run) {
  run.motion.cancel();
  run.next = 0;
  run.issued = run.open = 0;
  run.waiting = -1;
  run.active = run.stopAfter = run.endAfter = false;
}

void Channel::reset() {
  start_ = stop_ = interrupted_ = restart_ = return_ = false;
  hasEntered_ = false;
  handover_.dropStrobes();
  clear(automaticRun_);
  clear(otherRun_);
  automaticRun_.motion.reset(false);
  otherRun_.motion.reset(false);
}

void Channel::forgetInterruption() {
  if (!interrupted_) return;
  interrupted_ = restart_ = return_ = false;
  clear(automaticRun_);
}

bool Channel::waitsForOthers() const { return running() && !get(signals_.noWait); }

bool Channel::rising(const BitSignal& signal, bool& before) const {
  const bool now = get(signal);
  const bool result = now && !before;
  before = now;
  return result;
}

const ChannelProgram* Channel::program() const {
  if (automatic()) return selected_;
  return (mode_ == Mode::Mdi || manual()) && hasEntered_ ? &entered_ : nullptr;
}

uint32_t Channel::blocksAhead() const {
  const ChannelProgram* under = running() ? program() : nullptr;
  const size_t blocks = under == nullptr ? 0 : under->blocks.size();
  return blocks > run().next ? static_cast<uint32_t>(blocks) - run().next : 0;
}

std::string Channel::enter(std::string_view blocks) {
  if (mode_ != Mode::Mdi && !manual()) return "blocks are entered in MDI, jog, incremental jog and handwheel mode";
  if (running()) return "the channel is executing";
  ChannelProgram program;
  if (std::string wrong = readChannelProgram(blocks, program); !wrong.empty()) return wrong;
  if (manual() && program.blocks.size() != 1) return "the manual modes execute a single block";
  if (std::string wrong = check(program); !wrong.empty()) return wrong;
  if (mode_ == Mode::Mdi && links_.signals.get(signals_.mdiForbidden)) return {}; // l.8137
  entered_ = std::move(program);
  hasEntered_ = true;
  return {};
}

// Words that the channel knows.
std::string Channel::check(const ChannelProgram& program) const {
  for (const ProgramBlock& block : program.blocks)
    for (const ProgramWord& word : block.words) {
      const bool known = std::string_view("GMSTFPR").find(word.letter) != std::string_view::npos;
      const bool auxiliary = std::ranges::any_of(parameters_.auxiliary, [&](const ParameterPlace& place) {
        return links_.parameters->dword(place, channel_) == word.letter;
      });
      if (!known && !auxiliary && run().motion.axisOf(word.letter) < 0)
        return std::string("the channel has no address ") + word.letter;
    }
  return {};
}

// ---- requests ----------------------------------------------------------------------------------------------------

// The machine is switched off: emergency stop (l.9551).
void Channel::followMachine() {
  const bool on = links_.signals.get(signals_.machineOn);
  if (machineOn_ && !on && running()) leave();
  machineOn_ = on;
}

// An offset measurement holds the channel in jog mode (l.10053, l.10076).
void Channel::followModes() {
  const bool measuring = get(signals_.lengthMeasuring) || get(signals_.offsetMeasuring);
  for (uint32_t i = 0; i < kModes; ++i)
    if (rising(signals_.modeRequest[i], modeBefore_[i]) && !measuring) wanted_ = static_cast<Mode>(i);
  if (measuring) wanted_ = Mode::Jog;
  // Override and stop disabled: the change waits (l.9789).
  if (wanted_ == mode_ || (start_ && run().motion.overrideDisabled())) return;
  changeMode(wanted_);
}

void Channel::changeMode(Mode mode) {
  if (running()) leave();
  hasEntered_ = false;
  mode_ = mode;
}

// An automatic run is interrupted, everything else forgotten (l.9789-9793).
void Channel::leave() {
  Run& current = run();
  handover_.dropStrobes();
  start_ = stop_ = false;
  if (!automatic()) return clear(current);
  interrupted_ = true;
  current.open = current.active ? handover_.unacknowledged(current.issued) : 0;
  current.motion.interrupt();
}

// Not in the modes that execute programs (l.9800-9905).
void Channel::followToggles() {
  for (uint32_t i = 0; i < kToggles; ++i)
    if (rising(signals_.toggleRequest[i], toggleBefore_[i]) && !automatic() && mode_ != Mode::Mdi)
      toggles_[i] = !toggles_[i];
}

void Channel::followConditions() {
  set(signals_.wheelOffset, get(signals_.wheelOffsetRequest) && (automatic() || mode_ == Mode::Mdi));
  set(signals_.misaligned, get(signals_.misalignedRequest) && manual());
  // N3200: 1 head-head, 2 head-table, 3 table-table; others are not five-axis machines.
  const int32_t mechanics = links_.parameters->dword(parameters_.mechanics, channel_);
  const bool head = mechanics == 1 || mechanics == 2, table = mechanics == 2 || mechanics == 3;
  const bool able[] = {head, head, head || table, table};
  for (uint32_t i = 0; i < 4; ++i) set(signals_.toolMode[i], get(signals_.toolRequest[i]) && manual() && able[i]);
  if (!interrupted_) restart_ = return_ = false;
  if (interrupted_ && get(signals_.restartRequest)) restart_ = true, return_ = false;
  if (interrupted_ && get(signals_.returnRequest)) return_ = true, restart_ = false;
}

void Channel::followStop() {
  if (!get(signals_.stopRequest) || !start_ || run().motion.overrideDisabled()) return;
  start_ = false;
  stop_ = true;
}

void Channel::followStart() {
  const bool asked = rising(signals_.startRequest, startBefore_);
  if (!asked || start_ || get(signals_.stopRequest) || program() == nullptr) return;
  start_ = true;
  if (stop_) {
    stop_ = false;
    return;
  }
  if (automatic() && interrupted_) return goOn();
  clear(run());
  run().motion.begin();
}

// Functions without acknowledge are handed over again (l.9566).
void Channel::goOn() {
  Run& current = run();
  interrupted_ = false;
  if (!current.active) return;
  current.motion.resume(restart_, return_);
  restart_ = return_ = false;
  if (current.open != 0) issue(current.open);
}

void Channel::issue(uint32_t mask) {
  handover_.issue(run().functions, mask, turning_);
  fresh_ = true;
}

// ---- the cycle ---------------------------------------------------------------------------------------------------

void Channel::cycle(const ChannelProgram* selected, int64_t us) {
  selected_ = selected;
  fresh_ = false;
  handover_.dropStrobes();
  set(signals_.partsDone, false);
  followMachine();
  followModes();
  followToggles();
  followConditions();
  followStop();
  followStart();
  run().motion.cycle(start_, us);
  countTime(us);
  advance();
  timeSlice();
  showState();
}

// Started, with a feed, with an override above 0 and a turning spindle (l.4432-4434).
void Channel::countTime(int64_t us) const {
  const ChannelMotion& motion = run().motion;
  if (start_ && motion.machining() && links_.spindles->speed(motion.spindle()) != 0)
    links_.tools->countTime(motion.spindle(), us);
}

void Channel::showState() {
  for (uint32_t i = 0; i < kModes; ++i) set(signals_.mode[i], static_cast<uint32_t>(mode_) == i);
  for (uint32_t i = 0; i < kToggles; ++i) set(signals_.toggle[i], toggles_[i]);
  set(signals_.start, start_);
  set(signals_.stop, stop_);
  set(signals_.interrupted, interrupted_);
  set(signals_.restart, restart_);
  set(signals_.returning, return_);
  set(signals_.buffered, mode_ == Mode::Mdi || program() != nullptr); // l.9543-9547
  set(signals_.waiting, run().waiting >= 0);
  const bool moves = links_.signals.get(signals_.feedOverride, channel_) != 0;
  set(signals_.stopped, !start_ || !moves);
  set(signals_.empty, !running() || !run().motion.moving());
}

} // namespace rung::sim::nct
