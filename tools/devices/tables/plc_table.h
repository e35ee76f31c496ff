// One PLC table in memory: plain data, all of a fixed size from its loading on.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/devices/tables/table_element.h"

namespace rung::devices {

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

  uint8_t* line(uint32_t number) { return bytes.data() + size_t{number} * lineBytes; }
  const uint8_t* line(uint32_t number) const { return bytes.data() + size_t{number} * lineBytes; }
};

} // namespace rung::devices
