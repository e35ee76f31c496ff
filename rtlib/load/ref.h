// A place of a program, and typed access to it. A Ref is plain data: found once, used for the life of the program.
// Multi-byte values are little-endian; integers are unsigned here, readers that want a sign extend by `width`.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/core/memory.h"

namespace rung::runtime {

enum class RefKind : uint8_t { Bit, Int, Real, Text, Constant };

struct Ref {
  uint32_t space = RUNG_NONE;
  uint32_t byte = 0; // logical, within the space
  uint8_t bit = 0;   // 0..7, of `byte`; for Bit
  uint8_t width = 1; // bits of one element: 1, 8, 16, 32 or 64; Text: 8
  RefKind kind = RefKind::Bit;
  bool readonly = false;
  uint32_t count = 1;   // elements, or bytes of a text
  int64_t constant = 0; // of a Constant
  bool operator==(const Ref&) const = default;
};

Ref bitRef(uint32_t space, uint32_t byte, uint32_t bit); // bit may be 8 or more: it counts on from `byte`
Ref intRef(uint32_t space, uint32_t byte, uint32_t width);
Ref realRef(uint32_t space, uint32_t byte); // 64 bits
Ref refOf(const rung_symbol& symbol);       // a Constant for a symbol without a place

// Element `index` of an array; nothing when there is none.
std::optional<Ref> element(const Ref& array, uint32_t index);
// Bit `number` of an integer; nothing when it is not that wide.
std::optional<Ref> bitOf(const Ref& cell, uint32_t number);
// The 64-bit real that the cell holds: an integer of 64 bits, or two words of a space that is addressed in words of 32
// bits. Nothing when the cell is narrower, or its second word lies outside.
std::optional<Ref> asReal(const core::Memory& memory, const Ref& ref);

// The place for accesses in every scan; outside all spaces for a Constant, and a Text's first byte.
core::Place locate(const core::Memory& memory, const Ref& ref);

// The bits of a Bit, Int, Real or Constant, zero-extended; of an array its first element.
uint64_t readRaw(const core::Memory& memory, const Ref& ref);
int64_t readSigned(const core::Memory& memory, const Ref& ref);
double readReal(const core::Memory& memory, const Ref& ref); // an Int or Bit is converted, as signed
std::string readText(const core::Memory& memory, const Ref& ref);
// Writing a Constant does nothing; `readonly` binds the program, not the host.
void writeRaw(const core::Memory& memory, const Ref& ref, uint64_t value);
void writeReal(const core::Memory& memory, const Ref& ref, double value); // an Int gets the value rounded, saturated
void writeText(const core::Memory& memory, const Ref& ref, std::string_view text); // cut to count, rest zeroed

} // namespace rung::runtime
