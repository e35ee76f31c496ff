// An element of a PLC table: its form in memory, and its text in a file or from an operator.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/tables/plc_table_files.h"
#include "rtlib/nc/technol/services.h"

namespace rung::io {

struct PlcTable;

// Largest size of a text or binary element in bytes. The manual has no limit; a program cannot pass more at once.
inline constexpr uint32_t kElementBytes = nc::technol::kMostArgumentBytes;

constexpr bool isText(ColumnType type) { return type == ColumnType::Text || type == ColumnType::Binary; }
// INT: 4 bytes, REAL: 8, STRING and BINARY: position and number of their bytes (PlcTable::textOf).
constexpr uint32_t elementSize(ColumnType type) { return type == ColumnType::Int ? 4 : 8; }

// Whether XML can contain the text: no control characters except tab, LF and CR.
bool isWritable(std::string_view text) noexcept;

// Converts a text from UTF-8 to Windows-1250, its form in memory; returns false if it has a character that does not
// exist there.
bool toMemory(std::string_view utf8, std::string& bytes);

// Reads the text of a file or an operator: INT -2147483648 to 4294967295, also 0x0C (a DWORD: numbers from 2147483648
// on become negative), REAL 1.5, STRING unchanged, in UTF-8, BINARY pairs of hexadecimal digits, with or without blanks
// between them. Returns "", or the error "is 'x', expected ..."; the element is then unchanged.
std::string readElement(PlcTable& table, ColumnType type, std::string_view written, uint8_t* element);
std::string readElement(PlcTable& table, ColumnType type, double number, uint8_t* element);
// Returns a text that readElement reads as the same element.
std::string writtenElement(const PlcTable& table, ColumnType type, const uint8_t* element);

// One PLC table in memory: plain data, whose size is fixed once it is loaded.

struct PlcTable {
  struct Column {
    std::string id; // in Windows-1250
    ColumnType type = ColumnType::Int;
    uint32_t at = 0; // offset in a line
  };

  std::string definition; // ID of the definition, in UTF-8
  std::vector<Column> columns;
  uint32_t lineBytes = 0;
  uint32_t capacity = 0;       // number of lines that fit into the memory
  uint32_t count = 0;          // number of lines
  uint32_t selected = 0;       // less than `count`, or 0
  bool elementChanged = false; // by an operator; the program has not yet asked for the change
  bool selectionChanged = false;
  bool dirty = false;         // the contents differ from the file
  uint64_t origin = 0;        // digest of the definition and of the file's contents when loaded
  std::vector<uint8_t> bytes; // the lines, then zeros
  // The bytes of STRING and BINARY elements, up to `textsEnd`, including unused bytes of changed elements.
  std::vector<uint8_t> texts, otherTexts; // of equal size; swapped when the first is full
  uint32_t textsEnd = 0;
  uint32_t textsInUse = 0; // bytes in use

  uint8_t* line(uint32_t number) { return bytes.data() + size_t{number} * lineBytes; }
  const uint8_t* line(uint32_t number) const { return bytes.data() + size_t{number} * lineBytes; }

  // The bytes of a STRING or BINARY element.
  std::span<const uint8_t> textOf(const uint8_t* element) const noexcept;
  // Returns false if there is no room; the element is then unchanged. `text` may be the bytes of an element.
  bool setText(uint8_t* element, std::span<const uint8_t> text) noexcept;
  // Releases the texts of a line to be removed, whose own bytes stay.
  void dropTexts(uint32_t number) noexcept;

  // The contents, for a table with the same definition and file.
  template <class Archive>
  void state(Archive& archive) {
    uint64_t loaded = origin;
    archive(loaded);
    archive.require(loaded == origin);
    archive.atMost(count, capacity);
    archive.atMost(textsEnd, texts.size());
    archive(selected, elementChanged, selectionChanged, dirty, textsInUse);
    archive.bytes(std::span(bytes).first(size_t{count} * lineBytes));
    archive.bytes(std::span(texts).first(textsEnd));
    if constexpr (Archive::kLoads) settle(archive);
  }
  // Whether all texts of these lines are within the first `end` bytes of `texts`, and are `inUse` bytes together.
  bool textsFit(const uint8_t* lines, uint32_t lineCount, uint32_t end, uint32_t inUse) const noexcept;

private:
  template <class Archive>
  void settle(Archive& archive) {
    archive.require((selected == 0 || selected < count) && textsFit(bytes.data(), count, textsEnd, textsInUse));
    if (!archive.good()) count = selected = textsEnd = textsInUse = 0;
    std::fill(line(count), line(capacity), uint8_t{0});
  }
  void compactTexts() noexcept;
};

} // namespace rung::io
