// An element of a PLC table: how it lies in memory, and how a file or an operator writes it.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/tables/plc_table_files.h"
#include "rtlib/nc/technol/services.h"

namespace rung::io {

struct PlcTable;

// Of a text or binary element, in bytes. The manual has no limit; what a program hands over at once has no more.
inline constexpr uint32_t kElementBytes = nc::technol::kMostArgumentBytes;

constexpr bool isText(ColumnType type) { return type == ColumnType::Text || type == ColumnType::Binary; }
// INT: 4 bytes, REAL: 8, STRING and BINARY: where its bytes lie and how many they are (PlcTable::textOf).
constexpr uint32_t elementSize(ColumnType type) { return type == ColumnType::Int ? 4 : 8; }

// Whether XML can hold the bytes of a text: no control characters but tab, LF and CR.
bool isWritable(std::string_view text) noexcept;

// A text in UTF-8 as the memory has it (Windows-1250); false where a character has no byte there.
bool toMemory(std::string_view utf8, std::string& bytes);

// The text that a file or an operator writes: INT -2147483648 to 4294967295, also 0x0C (a DWORD: from 2147483648 on
// they are the negative numbers), REAL 1.5, STRING as it is, in UTF-8, BINARY pairs of hexadecimal digits, with blanks
// between them or without. "" or what is wrong: "is 'x', expected ..."; the element is then as before.
std::string readElement(PlcTable& table, ColumnType type, std::string_view written, uint8_t* element);
std::string readElement(PlcTable& table, ColumnType type, double number, uint8_t* element);
// The text that reads as the same element.
std::string writtenElement(const PlcTable& table, ColumnType type, const uint8_t* element);

// One PLC table in memory: plain data, all of a fixed size from its loading on.

struct PlcTable {
  struct Column {
    std::string id; // bytes in Windows-1250
    ColumnType type = ColumnType::Int;
    uint32_t at = 0; // in a line
  };

  std::string definition; // its ID, in UTF-8
  std::vector<Column> columns;
  uint32_t lineBytes = 0;
  uint32_t capacity = 0;       // lines that there is memory for
  uint32_t count = 0;          // lines
  uint32_t selected = 0;       // less than `count`, or 0
  bool elementChanged = false; // by an operator, and the program has not asked for it
  bool selectionChanged = false;
  bool dirty = false;         // its file has other contents
  uint64_t origin = 0;        // digest of its definition and of what its file said
  std::vector<uint8_t> bytes; // of the lines; zeros after the last one
  // The bytes of STRING and BINARY elements up to `textsEnd`, some of them of elements that have others now.
  std::vector<uint8_t> texts, otherTexts; // of one size; they change places when the first is full
  uint32_t textsEnd = 0;
  uint32_t textsInUse = 0; // bytes

  uint8_t* line(uint32_t number) { return bytes.data() + size_t{number} * lineBytes; }
  const uint8_t* line(uint32_t number) const { return bytes.data() + size_t{number} * lineBytes; }

  // Of a STRING or BINARY element.
  std::span<const uint8_t> textOf(const uint8_t* element) const noexcept;
  // False: no room, and the element is as before. The bytes may be those of an element.
  bool setText(uint8_t* element, std::span<const uint8_t> text) noexcept;
  // A line goes, with its texts. Its bytes stay.
  void dropTexts(uint32_t number) noexcept;
  // Whether these lines have all their texts in `texts` up to `end`, and they are `inUse` bytes.
  bool textsFit(const uint8_t* lines, uint32_t lineCount, uint32_t end, uint32_t inUse) const noexcept;

private:
  void compactTexts() noexcept;
};

} // namespace rung::io
