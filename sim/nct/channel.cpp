// Modes, conditions, start and stop of a channel (see channel.h). Execution of blocks.
#include "sim/nct/channel.h"

#include <algorithm>
#include <cmath>

#include "sim/nct/parameters.h"
#include "sim/nct/spindles.h"
#include "sim/nct/tool_management.h"

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
  toggles_ = {};
  askedBefore_ = optionsBefore_ = 0;
  machineOn_ = false;
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

// Checks that the channel knows the words of a program.
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

// An offset measurement keeps the channel in jog mode (l.10053, l.10076).
void Channel::followModes(uint32_t asked) {
  const bool measuring = signals_.lengthMeasuring.in(asked) || signals_.offsetMeasuring.in(asked);
  const uint32_t rising = asked & ~askedBefore_ & signals_.modeRequests;
  for (uint32_t i = 0; i < kModes && rising != 0; ++i)
    if (signals_.modeRequest[i].in(rising) && !measuring) wanted_ = static_cast<Mode>(i);
  if (measuring) wanted_ = Mode::Jog;
  // While override and stop are disabled, the change waits (l.9789).
  if (wanted_ == mode_ || (start_ && run().motion.overrideDisabled())) return;
  changeMode(wanted_);
}

void Channel::changeMode(Mode mode) {
  if (running()) leave();
  hasEntered_ = false;
  mode_ = mode;
}

// An automatic run is interrupted, everything else is cancelled (l.9789-9793).
void Channel::leave() {
  Run& current = run();
  handover_.dropStrobes();
  start_ = stop_ = false;
  if (!automatic()) return clear(current);
  interrupted_ = true;
  current.open = current.active ? handover_.unacknowledged(current.issued) : 0;
  current.motion.interrupt();
}

// Options change only in modes that do not execute programs (l.9800-9905).
void Channel::followToggles(uint32_t options) {
  const uint32_t rising = options & ~optionsBefore_ & signals_.toggleRequests;
  for (uint32_t i = 0; i < kToggles && rising != 0; ++i)
    if (signals_.toggleRequest[i].in(rising) && !automatic() && mode_ != Mode::Mdi) toggles_[i] = !toggles_[i];
}

void Channel::followConditions(uint32_t asked, uint32_t options) {
  uint32_t bits =
      signals_.wheelOffset.as(signals_.wheelOffsetRequest.in(asked) && (automatic() || mode_ == Mode::Mdi)) |
      signals_.misaligned.as(signals_.misalignedRequest.in(asked) && manual());
  // N3200: 1 head-head, 2 head-table, 3 table-table; other values are not five-axis machines.
  const int32_t mechanics = links_.parameters->dword(parameters_.mechanics, channel_);
  const bool head = mechanics == 1 || mechanics == 2, table = mechanics == 2 || mechanics == 3;
  const bool able[] = {head, head, head || table, table};
  for (uint32_t i = 0; i < 4; ++i)
    bits |= signals_.toolMode[i].as(signals_.toolRequest[i].in(asked) && manual() && able[i]);
  links_.signals.setBits(signals_.wheelOffset, channel_, signals_.conditions, bits);
  if (!interrupted_) restart_ = return_ = false;
  if (interrupted_ && signals_.restartRequest.in(options)) restart_ = true, return_ = false;
  if (interrupted_ && signals_.returnRequest.in(options)) return_ = true, restart_ = false;
}

void Channel::followStop(uint32_t asked) {
  if (!signals_.stopRequest.in(asked) || !start_ || run().motion.overrideDisabled()) return;
  start_ = false;
  stop_ = true;
}

void Channel::followStart(uint32_t asked) {
  const bool starts = signals_.startRequest.in(asked & ~askedBefore_);
  if (!starts || start_ || signals_.stopRequest.in(asked) || program() == nullptr) return;
  start_ = true;
  if (stop_) {
    stop_ = false;
    return;
  }
  if (automatic() && interrupted_) return goOn();
  clear(run());
  run().motion.begin();
}

// Continues an interrupted run; functions without acknowledge are sent again (l.9566).
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
  const uint32_t asked = links_.signals.wordOf(signals_.startRequest, channel_);
  const uint32_t options = links_.signals.wordOf(signals_.singleBlock, channel_);
  followMachine();
  followModes(asked);
  followToggles(options);
  followConditions(asked, options);
  followStop(asked);
  followStart(asked);
  askedBefore_ = asked;
  optionsBefore_ = options;
  run().motion.cycle(start_, us);
  countTime(us);
  advance();
  timeSlice();
  showState();
}

// Tool life counts while the channel is started, feeding with an override above 0, and the spindle is turning
// (l.4432-4434).
void Channel::countTime(int64_t us) const {
  const ChannelMotion& motion = run().motion;
  if (start_ && motion.machining() && links_.spindles->speed(motion.spindle()) != 0)
    links_.tools->countTime(motion.spindle(), us);
}

void Channel::showState() {
  const SignalMemory& signals = links_.signals;
  const ChannelSignals& s = signals_;
  uint32_t state = s.mode[static_cast<size_t>(mode_)].mask() | s.start.as(start_) | s.stop.as(stop_) |
                   s.restart.as(restart_) | s.returning.as(return_);
  for (uint32_t i = 0; i < kToggles; ++i) state |= s.toggle[i].as(toggles_[i]);
  signals.setBits(s.start, channel_, s.stateBits, state);
  signals.setBits(s.interrupted, channel_, s.runBits,
                  s.interrupted.as(interrupted_) | s.waiting.as(run().waiting >= 0) |
                      s.buffered.as(mode_ == Mode::Mdi || program() != nullptr)); // l.9543-9547
  const bool moves = signals.get(s.feedOverride, channel_) != 0;
  signals.setBits(s.stopped, channel_, s.motionBits,
                  s.stopped.as(!start_ || !moves) | s.empty.as(!running() || !run().motion.moving()));
}

// Execution of the blocks of a part program.

namespace {

constexpr uint32_t kBlocksOfACycle = 50; // blocks that take no time; a limit, because jumps may loop forever
constexpr int32_t kStop = 0, kConditionalStop = 1, kEnd = 2, kEndAndRewind = 30, kToolChange = 6;

bool holds(const ProgramJump& jump, double left, double right) {
  switch (jump.test) {
  case ProgramJump::Test::Always: return true;
  case ProgramJump::Test::Eq: return left == right;
  case ProgramJump::Test::Ne: return left != right;
  case ProgramJump::Test::Gt: return left > right;
  case ProgramJump::Test::Lt: return left < right;
  case ProgramJump::Test::Ge: return left >= right;
  case ProgramJump::Test::Le: return left <= right;
  }
  return false;
}

} // namespace

void Channel::advance() {
  const ChannelProgram* current = program();
  if (!running() || current == nullptr) return;
  for (uint32_t i = 0; i < kBlocksOfACycle; ++i) {
    if (!run().active && (!start_ || !beginBlock(*current))) return;
    if (run().active && !blockDone()) return;
    if (run().active) endBlock(*current);
    if (!start_) return;
  }
}

bool Channel::skipped(const ProgramBlock& block) const {
  return block.condition != 0 && get(signals_.condition[block.condition - 1]);
}

bool Channel::jumps(const ProgramBlock& block, const ChannelProgram& program) {
  if (!block.jump) return false;
  const ProgramJump& jump = *block.jump;
  const double left = run().motion.value({.number = 0, .variable = jump.variable});
  if (!holds(jump, left, run().motion.value(jump.value))) return false;
  const auto target = std::ranges::find(program.blocks, jump.target, &ProgramBlock::sequence);
  run().next = static_cast<uint32_t>(target - program.blocks.begin());
  return true;
}

// Begins the next block. False: there is nothing to execute in this cycle.
bool Channel::beginBlock(const ChannelProgram& program) {
  Run& current = run();
  if (current.next >= program.blocks.size()) {
    if (get(signals_.finished)) finish();
    return false;
  }
  const ProgramBlock& block = program.blocks[current.next++];
  if (skipped(block)) return true;
  for (const ProgramAssignment& assignment : block.assignments)
    links_.macros->programWrite(assignment.variable, channel_, current.motion.value(assignment.value));
  if (jumps(block, program)) return true;
  if (block.sequence != 0) sequence_ = block.sequence;
  current.active = true;
  current.motion.prepare(block, locked());
  current.functions = collect(block);
  current.issued = functionsLocked() ? 0 : ChannelFunctions::mask(current.functions);
  current.stopAfter =
      current.functions.has(kStop) || (current.functions.has(kConditionalStop) && get(signals_.conditionalStop));
  current.waiting = get(signals_.noWait) ? -1 : waitingCode(block);
  current.endAfter = current.functions.has(kEnd) || current.functions.has(kEndAndRewind);
  if (current.issued != 0) issue(current.issued);
  current.motion.cycle(true, 0);
  return true;
}

// The M code of the block in the range of N2201 to N2202; negative if there is none.
int32_t Channel::waitingCode(const ProgramBlock& block) const {
  const int32_t first = links_.parameters->dword(parameters_.waitingFirst);
  for (const ProgramWord& word : block.words) {
    const double code = run().motion.value(word.value);
    if (word.letter == 'M' && first > 0 && code >= first && code <= links_.parameters->dword(parameters_.waitingLast))
      return static_cast<int32_t>(code);
  }
  return -1;
}

uint32_t Channel::spindleOf(const ProgramBlock& block, const ProgramWord& word) const {
  if (word.spindle != 0) return word.spindle;
  double number = links_.parameters->dword(parameters_.defaultSpindle, channel_);
  for (const ProgramWord& other : block.words)
    if (other.letter == 'P') number = run().motion.value(other.value);
  return number >= 1 && number <= nc::nct::kSpindles ? static_cast<uint32_t>(number) : 1;
}

// The functions of a block. Synchronisation codes stay in the NC (l.9570); S is not a function with G92 and in G96.
BlockFunctions Channel::collect(const ProgramBlock& block) const {
  const ChannelMotion& motion = run().motion;
  BlockFunctions functions;
  uint32_t codes = 0;
  for (const ProgramWord& word : block.words) {
    const auto value =
        static_cast<int32_t>(std::lround(std::clamp(motion.value(word.value), -2147483648.0, 2147483647.0)));
    if (word.letter == 'M') {
      const int32_t first = links_.parameters->dword(parameters_.waitingFirst);
      if (first > 0 && value >= first && value <= links_.parameters->dword(parameters_.waitingLast)) continue;
      functions.codes[codes++] = value;
    } else if (word.letter == 'S' && !motion.takesSpeed(block)) {
      functions.speed = value;
      functions.spindle = spindleOf(block, word);
    } else if (word.letter == 'T') {
      functions.tool = value;
    } else {
      for (uint32_t i = 0; i < 3; ++i)
        if (links_.parameters->dword(parameters_.auxiliary[i], channel_) == word.letter) functions.auxiliary[i] = value;
    }
  }
  return functions;
}

bool Channel::blockDone() const {
  return !fresh_ && run().waiting < 0 && run().motion.done() && get(signals_.finished);
}

void Channel::endBlock(const ChannelProgram& program) {
  Run& current = run();
  current.active = false;
  const bool changed = links_.tools->countsT() ? (current.issued & ChannelFunctions::kTool) != 0
                                               : current.issued != 0 && current.functions.has(kToolChange);
  if (changed) links_.tools->countUse(current.motion.spindle());
  const int32_t partCode = links_.parameters->dword(parameters_.partCode, channel_);
  if (partCode > 0 && current.functions.has(partCode) && !locked()) {
    ++parts;
    if (parts == partsWanted) set(signals_.partsDone, true);
  }
  if (current.endAfter || current.next >= program.blocks.size()) return finish();
  if (!current.stopAfter && !get(signals_.singleBlock)) return;
  start_ = false;
  stop_ = true;
}

void Channel::finish() {
  start_ = stop_ = false;
  clear(run());
  if (manual()) hasEntered_ = false;
}

} // namespace rung::sim::nct
