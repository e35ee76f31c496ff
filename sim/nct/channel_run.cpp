// Execution of the blocks of a part program (see channel.h).
#include <algorithm>
#include <cmath>

#include "sim/nct/channel.h"
#include "sim/nct/macros.h"
#include "sim/nct/tool_management.h"

namespace rung::sim::nct {
namespace {

constexpr uint32_t kBlocksOfACycle = 50; // that take no time; a jump may go back for ever
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

// False: there is nothing to execute in this cycle.
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

// The M code of the block in the range of N2201 to N2202; negative: none.
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

// Codes of synchronisation stay in the NC (l.9570); S is not a function with G92 and in G96.
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
