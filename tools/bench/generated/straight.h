// The straight-line form of a work: the C++ that a programmer would write by hand for it.
//
// FROZEN: published figures are ratios to this form. It is changed only where it is wrong, and never so that it becomes
// slower or Rung looks better; a change of it has to say that all figures have to be measured again.
#pragma once
#include <cstdint>
#include <string>

#include "tools/bench/generated/work.h"

namespace rung::bench {

enum class BitForm : uint8_t { Byte, Packed }; // a byte per bit, or 64 bits per word

// Where the memory of the form holds the values that are set and compared; the rest after them is private. All of it
// begins as 0.
struct StraightLayout {
  StraightLayout(const Work& work, BitForm form);
  BitForm form;
  uint32_t words;  // bytes from the beginning
  uint32_t tables; // the same
  uint32_t reals;  // the same
  uint32_t size;   // of the whole memory
};

// extern "C" void scan(Memory* memory, int ms): one scan, `ms` after the one before.
std::string straightSource(const Work& work, BitForm form);

} // namespace rung::bench
