// See machine.h.
#include "tools/bench/generated/machine.h"

namespace rung::bench {
namespace {

constexpr uint64_t kSeed = 20260102;
constexpr uint32_t kOperandsBelow = 1000;

} // namespace

Machine::Machine(const Work& work) : work_(work), random_(kSeed) {
  for (uint32_t i = 0; i < work.inputs; ++i) {
    const bool random = (random_() & 1) != 0;
    inputs_.push_back(work.changes ? random : i < work.inputs / 2 ? work.firstHalf : work.secondHalf);
  }
  for (uint32_t i = 0; i < work.indices + work.operands; ++i)
    words_.push_back(below(i < work.indices ? kEntries : kOperandsBelow));
  for (uint32_t i = 0; i < work.realOperands; ++i) reals_.push_back(anyReal());
}

Change Machine::next() {
  Change change;
  if (!work_.changes) return change;
  change.bitCount = Change::kBits;
  for (uint32_t& bit : change.bits) bit = below(work_.inputs);
  if (work_.operands != 0) {
    change.hasWords = true;
    change.words = {below(work_.indices), work_.indices + below(work_.operands)};
    change.wordValues = {below(kEntries), below(kOperandsBelow)};
  }
  if (work_.realOperands != 0) {
    change.hasReal = true;
    change.real = below(work_.realOperands);
    change.realValue = anyReal();
  }
  return change;
}

} // namespace rung::bench
