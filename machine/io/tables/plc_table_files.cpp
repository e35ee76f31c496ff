// The files of PLC tables.
#include "machine/io/tables/plc_table_files.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "rtlib/nc/control/technol/values.h"
#include "rtlib/text/blanks.h"

namespace rung::io {

namespace {

// Columns and lines may be in <Definition> or after it.
constexpr Child kOfDefinitions[] = {
    {Element::None, "PLCTableDef", Element::Document, Times::Once},
    {Element::Document, "Definition", Element::Definition, Times::Once},
    {Element::Document, "Col", Element::Column, Times::Any},
    {Element::Definition, "DefinitionID", Element::DefinitionId, Times::Once},
    {Element::Definition, "ColsCount", Element::Count, Times::Once},
    {Element::Definition, "Col", Element::Column, Times::Any},
    {Element::Column, "ColID", Element::ColumnId, Times::Once},
    {Element::Column, "ColType", Element::ColumnType, Times::Once},
};
constexpr Child kOfData[] = {
    {Element::None, "PLCTable", Element::Document, Times::Once},
    {Element::Document, "Definition", Element::Definition, Times::Once},
    {Element::Document, "Line", Element::Line, Times::Any},
    {Element::Definition, "DefinitionID", Element::DefinitionId, Times::Once},
    {Element::Definition, "LinesCount", Element::Count, Times::Once},
    {Element::Definition, "SelLine", Element::Selected, Times::AtMostOnce},
    {Element::Definition, "Line", Element::Line, Times::Any},
    {Element::Line, "Col", Element::Cell, Times::Any},
};

class DefinitionReader : public TableReader {
public:
  explicit DefinitionReader(std::string_view name) : TableReader(name, kOfDefinitions) {}
  std::string read(std::string_view text, TableDefinition& definition) {
    if (std::string complaints = TableReader::read(text); !complaints.empty()) return complaints;
    for (auto& [number, column] : columns_) found_.columns.push_back(std::move(column));
    definition = std::move(found_);
    return {};
  }

private:
  void begins(Element element, host::Attributes& attributes) override {
    if (element == Element::Column) {
      column_ = {.place = place()};
      number_ = ordinal(attributes, kMostColumns - 1);
    }
    if (element == Element::DefinitionId) found_.place = place();
    if (element == Element::Count) countPlace_ = place();
  }
  void ends(Element element) override {
    switch (element) {
    case Element::DefinitionId: found_.id = word(); break;
    case Element::Count: count_ = number(kMostColumns); break;
    case Element::ColumnId: column_.id = word(); break;
    case Element::ColumnType: readType(); break;
    case Element::Column: addColumn(); break;
    case Element::Document: checkCount(); break;
    default: break;
    }
  }

  void readType() {
    constexpr std::string_view kNames[] = {"INT", "REAL", "STRING", "BINARY"}; // indexed by ColumnType, from 1
    const std::string name = word();
    const auto* at = std::find(std::begin(kNames), std::end(kNames), name);
    if (at != std::end(kNames))
      column_.type = static_cast<ColumnType>(at - std::begin(kNames) + 1);
    else if (!name.empty())
      complain("<ColType> is " + host::inQuotes(name) + ", expected " + host::listed(kNames));
  }
  void addColumn() {
    if (!number_) return;
    const auto [entry, fresh] = columns_.emplace(*number_, column_);
    if (!fresh)
      complainAt(column_.place, "column " + std::to_string(*number_) +
                                    " is defined again; the first definition is at " + entry->second.place);
    if (column_.id.empty()) return;
    const auto [named, isNew] = ids_.emplace(column_.id, column_.place);
    if (!isNew)
      complainAt(column_.place, "the column ID " + host::inQuotes(column_.id) + " is used again; the first use is at " +
                                    named->second);
  }
  void checkCount() {
    if (!count_) return;
    const std::string count = "<ColsCount> is " + std::to_string(*count_);
    if (*count_ != columns_.size())
      complainAt(countPlace_, count + ", expected " + std::to_string(columns_.size()) +
                                  ", as many columns have a number of their own");
    else if (!columns_.empty() && columns_.rbegin()->first != *count_ - 1)
      complainAt(countPlace_, count + ", but there is a column " + std::to_string(columns_.rbegin()->first) +
                                  "; columns are numbered from 0");
  }

  TableDefinition found_;
  TableColumn column_; // currently being read
  std::optional<uint32_t> number_;
  std::map<uint32_t, TableColumn> columns_;
  std::map<std::string, host::FilePlace, std::less<>> ids_;
  std::optional<uint32_t> count_;
  host::FilePlace countPlace_;
};

class DataReader : public TableReader {
public:
  explicit DataReader(std::string_view name) : TableReader(name, kOfData) {}
  std::string read(std::string_view text, TableData& data) {
    if (std::string complaints = TableReader::read(text); !complaints.empty()) return complaints;
    data = std::move(found_);
    return {};
  }

private:
  void begins(Element element, host::Attributes& attributes) override {
    if (element == Element::Line) beginLine(attributes);
    if (element == Element::Cell) found_.lines.back().elements.push_back({attributes.required("ColID"), {}, place()});
    if (element == Element::DefinitionId) found_.place = place();
    if (element == Element::Selected) selectedPlace_ = place();
  }
  void ends(Element element) override {
    switch (element) {
    case Element::DefinitionId: found_.definition = word(); break;
    case Element::Count: count_ = number(kMostLines); break;
    case Element::Selected: found_.selected = number(kMostLines).value_or(0); break;
    case Element::Cell: found_.lines.back().elements.back().value = text_; break;
    case Element::Line: checkColumns(); break;
    case Element::Document: checkLines(); break;
    default: break;
    }
  }

  void beginLine(host::Attributes& attributes) {
    TableLine& line = found_.lines.emplace_back();
    line.place = place();
    const auto number = ordinal(attributes, kMostLines - 1);
    if (!number) return;
    line.number = *number;
    const auto [entry, fresh] = numbers_.emplace(*number, line.place);
    if (!fresh) complain("line " + std::to_string(*number) + " is given again; the first time is at " + entry->second);
  }
  void checkColumns() {
    std::map<std::string_view, const TableElement*> seen;
    for (const TableElement& element : found_.lines.back().elements) {
      const auto [entry, fresh] = seen.emplace(element.column, &element);
      if (!fresh && !element.column.empty())
        complainAt(element.place, "column " + host::inQuotes(element.column) +
                                      " is given again in this line; the first time is at " + entry->second->place);
    }
  }
  void checkLines() {
    if (!count_) return;
    found_.lineCount = *count_;
    const std::string count = "<LinesCount> is " + std::to_string(found_.lineCount);
    for (const auto& [number, where] : numbers_)
      if (number >= found_.lineCount) complainAt(where, "there is no line " + std::to_string(number) + ": " + count);
    if (found_.selected != 0 && found_.selected >= found_.lineCount)
      complainAt(selectedPlace_, "<SelLine> is " + std::to_string(found_.selected) + ", but " + count);
  }

  TableData found_;
  std::optional<uint32_t> count_; // <LinesCount>
  host::FilePlace selectedPlace_;
  std::map<uint32_t, host::FilePlace> numbers_; // positions of lines, by number
};

} // namespace

std::string parseTableDefinition(std::string_view name, std::string_view text, TableDefinition& definition) {
  return DefinitionReader(name).read(text, definition);
}

std::string parseTableData(std::string_view name, std::string_view text, TableData& data) {
  return DataReader(name).read(text, data);
}

std::string readTableDefinition(const std::string& path, TableDefinition& definition) {
  std::string text;
  if (std::string wrong = host::textOfFile(path, text); !wrong.empty()) return wrong;
  return parseTableDefinition(path, text, definition);
}

std::string readTableData(const std::string& path, TableData& data) {
  std::string text;
  if (std::string wrong = host::textOfFile(path, text); !wrong.empty()) return wrong;
  return parseTableData(path, text, data);
}

// Writing of data files.

namespace {

// Line ends are written as references, so that an element stays on one line and parsers do not convert them.
void escape(std::string& out, std::string_view text) {
  for (const char c : text) {
    switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    case '"': out += "&quot;"; break;
    case '\t': out += "&#9;"; break;
    case '\n': out += "&#10;"; break;
    case '\r': out += "&#13;"; break;
    default: out += c;
    }
  }
}

void writeLine(std::string& out, const TableLine& line) {
  out += "  <Line No=\"" + std::to_string(line.number) + "\">\n";
  for (const TableElement& element : line.elements) {
    out += "    <Col ColID=\"";
    escape(out, element.column);
    out += "\">";
    escape(out, element.value);
    out += "</Col>\n";
  }
  out += "  </Line>\n";
}

} // namespace

std::string tableDataText(const TableData& data) {
  std::string out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<PLCTable>\n  <Definition>\n    <DefinitionID>";
  escape(out, data.definition);
  out += "</DefinitionID>\n    <LinesCount>" + std::to_string(data.lineCount) + "</LinesCount>\n";
  if (data.selected != 0) out += "    <SelLine>" + std::to_string(data.selected) + "</SelLine>\n";
  out += "  </Definition>\n";
  for (const TableLine& line : data.lines) writeLine(out, line);
  return out + "</PLCTable>\n";
}

// Elements of PLC tables' files.

using text::trimmed;

namespace {

constexpr size_t kShown = 40; // bytes of a text in a message

constexpr bool isText(Element element) {
  switch (element) {
  case Element::DefinitionId:
  case Element::Count:
  case Element::Selected:
  case Element::ColumnId:
  case Element::ColumnType:
  case Element::Cell: return true;
  default: return false;
  }
}

} // namespace

std::string TableReader::word() {
  const std::string_view text = trimmed(text_);
  if (text.empty()) complain("<" + open_.back().name + "> is empty");
  return std::string(text);
}

std::optional<uint32_t> TableReader::number(uint32_t most) {
  const auto value = nc::technol::integerOf(text_);
  if (value && *value >= 0 && *value <= most) return static_cast<uint32_t>(*value);
  complain("<" + open_.back().name + "> is " + host::inQuotes(host::inOneLine(text_.substr(0, kShown))) +
           ", expected 0 to " + std::to_string(most));
  return std::nullopt;
}

std::optional<uint32_t> TableReader::ordinal(host::Attributes& attributes, uint32_t most) {
  const std::string text = attributes.required("No");
  if (text.empty()) return std::nullopt;
  const auto value = nc::technol::integerOf(text);
  if (value && *value >= 0 && *value <= most) return static_cast<uint32_t>(*value);
  attributes.wrong("No", text, "0 to " + std::to_string(most));
  return std::nullopt;
}

std::string TableReader::expectedIn(Element parent) const {
  std::vector<std::string> written;
  for (const Child& child : children_)
    if (child.parent == parent) written.push_back("<" + std::string(child.name) + ">");
  const std::vector<std::string_view> names(written.begin(), written.end());
  return host::listed(names);
}

Element TableReader::childOf(Element parent, std::string_view name) {
  if (parent == Element::Foreign) return Element::Foreign;
  for (const Child& child : children_) {
    if (child.parent != parent || child.name != name) continue;
    if (parent != Element::None) checkTimes(child);
    return child.element;
  }
  if (parent == Element::None)
    complain("found <" + std::string(name) + ">, expected " + expectedIn(parent));
  else
    complainAboutChild(name, expectedIn(parent));
  return Element::Foreign;
}

void TableReader::checkTimes(const Child& child) {
  const uint32_t bit = 1u << static_cast<unsigned>(child.element);
  if (child.times != Times::Any && (elements_.back().seen & bit) != 0)
    complain("<" + open_.back().name + "> has a second <" + std::string(child.name) + ">");
  elements_.back().seen |= bit;
}

void TableReader::checkLacks() {
  for (const Child& child : children_)
    if (child.parent == elements_.back().element && child.times == Times::Once &&
        (elements_.back().seen & 1u << static_cast<unsigned>(child.element)) == 0)
      complain("<" + open_.back().name + "> lacks its <" + std::string(child.name) + ">");
}

void TableReader::opens(std::string_view name) {
  const Element outer = parent();
  if (outer != Element::None && outer != Element::Foreign && !isText(outer)) complainAboutText();
  elements_.push_back({childOf(outer, name)});
}

void TableReader::begin(std::string_view, const char** list) {
  const Element element = elements_.back().element;
  if (element == Element::Foreign) return;
  host::Attributes attributes(*this, list);
  begins(element, attributes);
  attributes.finish();
}

void TableReader::end() {
  const Element element = elements_.back().element;
  if (element != Element::Foreign) {
    if (!isText(element)) complainAboutText();
    checkLacks();
    ends(element);
  }
  elements_.pop_back();
}

} // namespace rung::io
