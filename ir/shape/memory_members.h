// The memory block as a debugger shows it: a struct with a member for every symbol, and for every address that rungs
// use and no symbol names. Members may overlap. A name that is not an identifier is mapped: every other character
// becomes
// '_', a leading digit gets one before it, a keyword of C++ one after it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/shape/memory_layout.h"

namespace rung::ir {

struct MemoryMember {
  std::string name;      // unique
  uint64_t firstBit = 0; // from the beginning of the memory block
  uint32_t width = 0;    // bits of one element: a Bit has 1 when packed, 8 when it has a byte of its own
  uint32_t count = 1;
  Type type = Type::Bit; // of one element; integers are signed
  bool text = false;     // I8 elements that are characters

  // A bit in a byte, or a byte, which debuggers show as a number when it is a field of eight bits.
  bool isBitField() const { return count == 1 && !text && (width == 1 || type == Type::I8); }
  uint64_t endBit() const { return firstBit + uint64_t{width} * count; }
};

// Sorted by place. Without constants, and without what is hidden from users.
std::vector<MemoryMember> memoryMembers(const MemoryLayout& layout);
// Bytes up to the last member. gdb reads a whole struct for the sake of a bit field in it, and by default no more than
// 65536 bytes: the struct has no more than it needs.
uint32_t bytesOf(const std::vector<MemoryMember>& members);

} // namespace rung::ir
