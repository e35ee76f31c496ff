// One PLC table in memory: plain data, all of a fixed size from its loading on.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "machine/io/tables/table_element.h"

namespace rung::io {

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
