// Reads and writes the XML files of PLC tables: their definitions (*.PlcTDef, man. l.18275-18330) and their data
// (*.PlcT, man. l.18352-18413). What an element's text means is up to the type of its column, which is in another file
// (machine/io/tables/plc_tables.h). Texts are UTF-8.
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

// A line and a column are WORDs (l.18717-18719), and so is the number of lines (l.19069).
inline constexpr uint32_t kMostLines = 65535, kMostColumns = 65535;

// <Col No="1"><ColID>Feed</ColID><ColType>REAL</ColType></Col>
struct TableColumn {
  std::string id;
  ColumnType type = ColumnType::Int;
  host::FilePlace place;
};

struct TableDefinition {
  std::string id;
  std::vector<TableColumn> columns; // by number
  host::FilePlace place;            // of its DefinitionID
};

// <Col ColID="Feed">1000</Col>
struct TableElement {
  std::string column;
  std::string value; // as it is written, with its blanks
  host::FilePlace place;
};

// <Line No="1">
struct TableLine {
  uint32_t number = 0; // less than TableData::lineCount; each once
  std::vector<TableElement> elements;
  host::FilePlace place;
};

struct TableData {
  std::string definition; // the ID of a TableDefinition
  uint32_t lineCount = 0;
  // SelLine is not in the manual, which does not say where the control keeps the selected line; a file without it
  // selects line 0. It is less than the number of lines, or 0.
  uint32_t selected = 0;
  std::vector<TableLine> lines;
  host::FilePlace place; // of its DefinitionID
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

// Follows the elements of a PLC table's file by a list of what each of them holds, and how often.

enum class Element : uint8_t {
  None, // around the document
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

// Follows the elements of a document by the table of what they hold.
class TableReader : public host::XmlReader {
protected:
  TableReader(std::string_view name, std::span<const Child> children) : XmlReader(name), children_(children) {}

  std::string read(std::string_view text) { return parse(text); }
  virtual void begins(Element element, host::Attributes& attributes) = 0;
  virtual void ends(Element element) = 0;

  // The text of an element that is not empty, without blanks at its ends.
  std::string word();
  // The text as a number from 0; nothing after a complaint.
  std::optional<uint32_t> number(uint32_t most);
  // An element's attribute No; nothing after a complaint.
  std::optional<uint32_t> ordinal(host::Attributes& attributes, uint32_t most);

private:
  struct OpenElement {
    Element element = Element::None;
    uint32_t seen = 0; // a bit for each element that it held
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
