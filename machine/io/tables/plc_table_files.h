// Reads and writes the XML files of PLC tables: their definitions (*.PlcTDef, man. l.18275-18330) and their data
// (*.PlcT, man. l.18352-18413). What an element's text means is up to the type of its column, which is in another file
// (machine/io/tables/plc_tables.h). Texts are UTF-8.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/xml_reader.h"

namespace rung::io {

// REAL, INT, STRING, BINARY; the numbers are those of PLCT_COL_TYPE (l.18893-18906).
enum class ColumnType : uint8_t { Int = 1, Real = 2, Text = 3, Binary = 4 };

// A line and a column are WORDs (l.18717-18719), and so is the number of lines (l.19069).
inline constexpr uint32_t kMostLines = 65535, kMostColumns = 65535;

// <Col No="1"><ColID>Feed</ColID><ColType>REAL</ColType></Col>
struct TableColumn {
  std::string id;
  ColumnType type = ColumnType::Int;
  FilePlace place;
};

struct TableDefinition {
  std::string id;
  std::vector<TableColumn> columns; // by number
  FilePlace place;                  // of its DefinitionID
};

// <Col ColID="Feed">1000</Col>
struct TableElement {
  std::string column;
  std::string value; // as it is written, with its blanks
  FilePlace place;
};

// <Line No="1">
struct TableLine {
  uint32_t number = 0; // less than TableData::lineCount; each once
  std::vector<TableElement> elements;
  FilePlace place;
};

struct TableData {
  std::string definition; // the ID of a TableDefinition
  uint32_t lineCount = 0;
  // SelLine is not in the manual, which does not say where the control keeps the selected line; a file without it
  // selects line 0. It is less than the number of lines, or 0.
  uint32_t selected = 0;
  std::vector<TableLine> lines;
  FilePlace place; // of its DefinitionID
};

// What the file says. "" or what is wrong with it, a line "FILE:LINE:COLUMN: ..." each; the result is then as before.
std::string readTableDefinition(const std::string& path, TableDefinition& definition);
std::string readTableData(const std::string& path, TableData& data);
// The same of a text; `name` is the file's in messages.
std::string parseTableDefinition(std::string_view name, std::string_view text, TableDefinition& definition);
std::string parseTableData(std::string_view name, std::string_view text, TableData& data);

// The text of a data file, a line for each element; parseTableData gives `data` back. Control characters other than
// blank, tab and line ends cannot be written in XML: no value has them.
std::string tableDataText(const TableData& data);

} // namespace rung::io
