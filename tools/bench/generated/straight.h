// The straight-line form of a work: the C++ that a programmer would write by hand for it.
//
// FROZEN: published figures are ratios to what this makes. It is only changed where it is wrong, and never so that it
// becomes slower or ours looks better; after a change of it all figures have to be measured again, which the change has
// to say.
#pragma once
#include <cstdint>
#include <string>

#include "tools/bench/generated/work.h"

namespace rung::bench {

enum class BitForm : uint8_t { Byte, Packed }; // a byte a bit, or 64 bits a word

// Where the memory of the form has what is written and compared; what follows is its own. It begins zeroed.
struct StraightLayout {
  StraightLayout(const Work& work, BitForm form);
  BitForm form;
  uint32_t words;  // bytes from the beginning
  uint32_t tables; // the same
  uint32_t reals;  // the same
  uint32_t size;   // of all
};

// extern "C" void scan(Memory* memory, int ms): one scan, `ms` after the one before.
std::string straightSource(const Work& work, BitForm form);

} // namespace rung::bench
