// Rows of the NC interfaces: what a CNC and a PLC program know about a signal. The rows are data of the build, sorted
// as in DIALECT/signals.csv; nothing here allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::nc {

enum class SignalType : uint8_t { Bit, Byte, Word, Dword, Qword, Real, Struct, String };

/// From the program's point of view: In is NC or machine -> PLC.
enum class Direction : uint8_t { In, Out, InOut };

struct Signal {
  const char* symbol;
  const char* address; // as the CSV has it; technol: its index column
  const char* area;    // the memory that byteOffset counts in; see DIALECT/signals.h
  uint32_t byteOffset; // nct: 4 * word
  uint8_t bit;         // of the byte (gsk, technol) or of the double word (nct)
  SignalType type;
  Direction direction;
  uint32_t count;        // multiplicity: panels, axes, elements of an array
  uint32_t strideBytes;  // from element to element; 0: bits that follow each other
  const char* structure; // area of the members of a Struct, else ""
  const char* group;
  const char* meaning;
  uint32_t manualLine;
  bool inferred; // the manual does not print the place; the number follows from order
};

/// All rows of one dialect and the order of their names. A contiguous range of Signal.
struct SignalTable {
  std::span<const Signal> rows;
  std::span<const uint16_t> byName; // indices of rows; equal names stay in row order
  bool ignoreCase;

  [[nodiscard]] constexpr const Signal* data() const { return rows.data(); }
  [[nodiscard]] constexpr size_t size() const { return rows.size(); }
  [[nodiscard]] constexpr auto begin() const { return rows.begin(); }
  [[nodiscard]] constexpr auto end() const { return rows.end(); }
  [[nodiscard]] constexpr const Signal& operator[](size_t i) const { return rows[i]; }
};

/// The first row of that name, in `area` only if one is given; null if there is none.
const Signal* findSignal(const SignalTable& table, std::string_view symbol, std::string_view area = {});

/// Bytes of one element; 0 for bits (they share bytes), structures and strings.
uint32_t elementBytes(SignalType type);

/// End of the last signal of the area.
uint32_t areaBytes(const SignalTable& table, std::string_view area);

} // namespace rung::nc
