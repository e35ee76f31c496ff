// Ref: a place of a program, and typed access to it. A Ref is plain data, which is looked up once and valid for the
// life of the program. Multi-byte values are little-endian. Integers are unsigned here; readers sign-extend them by
// `width` if necessary.
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
  int64_t constant = 0; // value of a Constant
  bool operator==(const Ref&) const = default;
};

// Whether both are one cell, or one array; a name may let the program only read it.
bool isSamePlace(const Ref& a, const Ref& b);

Ref bitRef(uint32_t space, uint32_t byte, uint32_t bit); // bit may be 8 or more, counted from the beginning of `byte`
Ref intRef(uint32_t space, uint32_t byte, uint32_t width);
Ref realRef(uint32_t space, uint32_t byte); // 64 bits
Ref refOf(const rung_symbol& symbol);       // a Constant for a symbol without a place

// Element `index` of an array; nothing if there is none.
std::optional<Ref> element(const Ref& array, uint32_t index);
// Bit `number` of an integer; nothing if it is not that wide.
std::optional<Ref> bitOf(const Ref& cell, uint32_t number);
// The 64-bit real in an integer cell of 64 bits, or in two words of a space that is addressed in words of 32 bits.
// Nothing if the cell is narrower, or its second word is outside the space.
std::optional<Ref> asReal(const core::Memory& memory, const Ref& ref);

// The Place for accesses in every scan: outside all spaces for a Constant, the first byte of a Text.
core::Place locate(const core::Memory& memory, const Ref& ref);

// The bits of a Bit, Int, Real or Constant, zero-extended; for an array those of its first element.
uint64_t readRaw(const core::Memory& memory, const Ref& ref);
int64_t readSigned(const core::Memory& memory, const Ref& ref);
double readReal(const core::Memory& memory, const Ref& ref); // an Int or Bit is converted, as signed
std::string readText(const core::Memory& memory, const Ref& ref);
// Writing a Constant does nothing. `readonly` applies to the program, not to the host, so it is not checked here.
void writeRaw(const core::Memory& memory, const Ref& ref, uint64_t value);
void writeReal(const core::Memory& memory, const Ref& ref, double value); // an Int gets the value rounded, saturated
void writeText(const core::Memory& memory, const Ref& ref, std::string_view text); // cut to count, rest zeroed

} // namespace rung::runtime
