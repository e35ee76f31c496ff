// MW 40 (see program_selection.h).
#include "sim/nct/program_selection.h"

#include "sim/nct/channels.h"

namespace rung::sim::nct {

bool ProgramSelection::serves(bool write, uint32_t function) const { return write && function == 40; }

// Code 2 is printed as "not 1", the amount as "always 2" (l.3905-3925). A request waits while a program runs, CN_START
// or CN_STOP (l.5890): its output is not TRUE until then (l.3899). Word 3 is printed as 0 after the execution
// (l.3919). The codes of other functions (6.29) are taken for what this one's table leaves out: 41 for the channel.
std::optional<int32_t> ProgramSelection::service(uint32_t, Block& block) {
  if (block.amount() != 2) return 2;
  const int32_t number = block.word(2);
  const int32_t channel = block.word(3);
  if (channel < 1 || channel > static_cast<int32_t>(nc::nct::kChannels)) return 41;
  const auto index = static_cast<uint32_t>(channel) - 1;
  if (links().signals.get(start_, index) || links().signals.get(stop_, index)) return std::nullopt;
  if (!links().channels->hasProgram(number)) return 40;
  links().channels->select(index, number);
  block.setWord(3, 0);
  return 0;
}

} // namespace rung::sim::nct
