// Reads and writes the XML files of PLC tables: their definitions (*.PlcTDef, man. l.18275-18330) and their data
// (*.PlcT, man. l.18352-18413). The meaning of an element's text depends on the type of its column, which is in another
// file (machine/io/tables/plc_tables.h). Texts are UTF-8.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/xml_reader.h"

namespace rung::io {

// REAL, INT, STRING, BINARY; the numbers are those of PLCT_COL_TYPE (l.18893-18906).
enum class ColumnType : uint8_t { Int = 1, Real = 2, Text = 3, Binary = 4 };

// Line numbers, column numbers and the number of lines are WORDs (l.18717-18719, l.19069).
inline constexpr uint32_t kMostLines = 65535, kMostColumns = 65535;

// <Col No="1"><ColID>Feed</ColID><ColType>REAL</ColType></Col>
struct TableColumn {
  std::string id;
  ColumnType type = ColumnType::Int;
  host::FilePlace place;
};

struct TableDefinition {
  std::string id;
  std::vector<TableColumn> columns; // indexed by number
  host::FilePlace place;            // position of its DefinitionID
};

// <Col ColID="Feed">1000</Col>
struct TableElement {
  std::string column;
  std::string value; // as in the file, including blanks
  host::FilePlace place;
};

// <Line No="1">
struct TableLine {
  uint32_t number = 0; // less than TableData::lineCount; unique
  std::vector<TableElement> elements;
  host::FilePlace place;
};

struct TableData {
  std::string definition; // ID of a TableDefinition
  uint32_t lineCount = 0;
  // The manual has no SelLine, and does not say where the control stores the selected line; a file without it selects
  // line 0. The value is less than the number of lines, or 0.
  uint32_t selected = 0;
  std::vector<TableLine> lines;
  host::FilePlace place; // position of its DefinitionID
};

// Reads a file. Returns "", or the errors, one line "FILE:LINE:COLUMN: ..." each; the result is then unchanged.
std::string readTableDefinition(const std::string& path, TableDefinition& definition);
std::string readTableData(const std::string& path, TableData& data);
// The same for a text; `name` is the name of the file in messages.
std::string parseTableDefinition(std::string_view name, std::string_view text, TableDefinition& definition);
std::string parseTableData(std::string_view name, std::string_view text, TableData& data);

// Returns the text of a data file, one line per element; parseTableData reads it as `data` again. Values must not
// contain control characters except tab and line ends, which XML cannot represent.
std::string tableDataText(const TableData& data);

// Parsing of a PLC table's file by a table of the permitted child elements and their number.

enum class Element : uint8_t {
  None, // outside the document
  Foreign,
  Document,
  Definition,
  DefinitionId,
  Count,
  Selected,
  Column,
  ColumnId,
  ColumnType,
  Line,
  Cell,
};

enum class Times : uint8_t { Any, AtMostOnce, Once };

struct Child {
  Element parent;
  std::string_view name;
  Element element;
  Times times;
};

// Parses a document by the table of permitted child elements.
class TableReader : public host::XmlReader {
protected:
  TableReader(std::string_view name, std::span<const Child> children) : XmlReader(name), children_(children) {}

  std::string read(std::string_view text) { return parse(text); }
  virtual void begins(Element element, host::Attributes& attributes) = 0;
  virtual void ends(Element element) = 0;

  // The text of an element that must not be empty, without blanks at its ends.
  std::string word();
  // The text as a number from 0; nothing if an error was reported.
  std::optional<uint32_t> number(uint32_t most);
  // An element's attribute No; nothing if an error was reported.
  std::optional<uint32_t> ordinal(host::Attributes& attributes, uint32_t most);

private:
  struct OpenElement {
    Element element = Element::None;
    uint32_t seen = 0; // one bit for each child that has occurred
  };

  Element parent() const { return elements_.empty() ? Element::None : elements_.back().element; }
  std::string expectedIn(Element parent) const;
  Element childOf(Element parent, std::string_view name);
  void checkTimes(const Child& child);
  void checkLacks();
  void opens(std::string_view name) final;
  void begin(std::string_view name, const char** list) final;
  void end() final;

  std::span<const Child> children_;
  std::vector<OpenElement> elements_;
};

} // namespace rung::io
