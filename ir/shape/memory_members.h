// The memory block as a struct for debuggers, with a member for every symbol, and for every address without a symbol
// that rungs use. Members may overlap. A name that is not an identifier is mapped: every other character becomes '_', a
// '_' is inserted before a leading digit and appended to a keyword of C++.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/shape/memory_layout.h"

namespace rung::ir {

struct MemoryMember {
  std::string name;      // unique
  uint64_t firstBit = 0; // from the beginning of the memory block
  uint32_t width = 0;    // bits of one element: 1 for a packed Bit, 8 for a Bit in a byte
  uint32_t count = 1;
  Type type = Type::Bit; // of one element; integers are signed
  bool text = false;     // the I8 elements are characters

  // A bit in a byte, or a byte, which debuggers show as a number if it is a field of eight bits.
  bool isBitField() const { return count == 1 && !text && (width == 1 || type == Type::I8); }
  uint64_t endBit() const { return firstBit + uint64_t{width} * count; }
};

// Sorted by place, without constants and hidden symbols.
std::vector<MemoryMember> memoryMembers(const MemoryLayout& layout);
// Bytes up to the last member. To show a bit field, gdb reads the whole struct, and by default no more than 65536
// bytes: so the struct is as short as possible.
uint32_t bytesOf(const std::vector<MemoryMember>& members);

} // namespace rung::ir
