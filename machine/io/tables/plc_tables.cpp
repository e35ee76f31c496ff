// Requests of programs to PLC tables.
#include "machine/io/tables/plc_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "rtlib/nc/technol/code_page.h"

namespace rung::io {

TableError PlcTables::find(uint32_t table, uint32_t line, uint32_t column, ColumnType type,
                           const uint8_t*& element) const noexcept {
  if (!exists(table)) return TableError::NoTable;
  const PlcTable& t = *tables_[table];
  if (line >= t.count) return TableError::NoLine;
  if (column >= t.columns.size()) return TableError::NoColumn;
  if (t.columns[column].type != type) return TableError::OtherType;
  element = t.line(line) + t.columns[column].at;
  return TableError::None;
}

TableError PlcTables::findToSet(uint32_t table, uint32_t line, uint32_t column, ColumnType type,
                                uint8_t*& element) noexcept {
  const uint8_t* found = nullptr;
  const TableError error = find(table, line, column, type, found);
  if (error == TableError::None) element = tables_[table]->line(line) + tables_[table]->columns[column].at;
  return error;
}

TableError PlcTables::getInt(uint32_t table, uint32_t line, uint32_t column, int32_t& value) const noexcept {
  const uint8_t* element = nullptr;
  const TableError error = find(table, line, column, ColumnType::Int, element);
  if (error == TableError::None) std::memcpy(&value, element, sizeof value);
  return error;
}

TableError PlcTables::getReal(uint32_t table, uint32_t line, uint32_t column, double& value) const noexcept {
  const uint8_t* element = nullptr;
  const TableError error = find(table, line, column, ColumnType::Real, element);
  if (error == TableError::None) std::memcpy(&value, element, sizeof value);
  return error;
}

TableError PlcTables::getText(uint32_t table, uint32_t line, uint32_t column, std::string_view& text) const noexcept {
  const uint8_t* element = nullptr;
  const TableError error = find(table, line, column, ColumnType::Text, element);
  if (error != TableError::None) return error;
  const std::span<const uint8_t> bytes = tables_[table]->textOf(element);
  text = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  return error;
}

TableError PlcTables::getBinary(uint32_t table, uint32_t line, uint32_t column,
                                std::span<const uint8_t>& bytes) const noexcept {
  const uint8_t* element = nullptr;
  const TableError error = find(table, line, column, ColumnType::Binary, element);
  if (error == TableError::None) bytes = tables_[table]->textOf(element);
  return error;
}

TableError PlcTables::setInt(uint32_t table, uint32_t line, uint32_t column, int32_t value) noexcept {
  uint8_t* element = nullptr;
  const TableError error = findToSet(table, line, column, ColumnType::Int, element);
  if (error != TableError::None) return error;
  std::memcpy(element, &value, sizeof value);
  tables_[table]->dirty = true;
  return error;
}

TableError PlcTables::setReal(uint32_t table, uint32_t line, uint32_t column, double value) noexcept {
  uint8_t* element = nullptr;
  const TableError error = findToSet(table, line, column, ColumnType::Real, element);
  if (error != TableError::None) return error;
  if (!std::isfinite(value)) return TableError::CannotBeStored;
  std::memcpy(element, &value, sizeof value);
  tables_[table]->dirty = true;
  return error;
}

TableError PlcTables::setText(uint32_t table, uint32_t line, uint32_t column, std::string_view text) noexcept {
  uint8_t* element = nullptr;
  const TableError error = findToSet(table, line, column, ColumnType::Text, element);
  if (error != TableError::None) return error;
  return isWritable(text) ? store(table, {reinterpret_cast<const uint8_t*>(text.data()), text.size()}, element)
                          : TableError::CannotBeStored;
}

TableError PlcTables::store(uint32_t table, std::span<const uint8_t> text, uint8_t* element) noexcept {
  PlcTable& t = *tables_[table];
  if (text.size() > kElementBytes || !t.setText(element, text)) return TableError::CannotBeStored;
  t.dirty = true;
  return TableError::None;
}

TableError PlcTables::setBinary(uint32_t table, uint32_t line, uint32_t column,
                                std::span<const uint8_t> bytes) noexcept {
  uint8_t* element = nullptr;
  const TableError error = findToSet(table, line, column, ColumnType::Binary, element);
  return error == TableError::None ? store(table, bytes, element) : error;
}

TableError PlcTables::columnIndex(uint32_t table, std::string_view id, uint32_t& column) const noexcept {
  if (!exists(table)) return TableError::NoTable;
  const std::vector<PlcTable::Column>& columns = tables_[table]->columns;
  for (uint32_t i = 0; i < columns.size(); ++i) {
    if (columns[i].id != id) continue;
    column = i;
    return TableError::None;
  }
  return TableError::NoColumn;
}

TableError PlcTables::columnId(uint32_t table, uint32_t column, std::string_view& id) const noexcept {
  if (!exists(table)) return TableError::NoTable;
  if (column >= tables_[table]->columns.size()) return TableError::NoColumn;
  id = tables_[table]->columns[column].id;
  return TableError::None;
}

TableError PlcTables::columnType(uint32_t table, uint32_t column, ColumnType& type) const noexcept {
  if (!exists(table)) return TableError::NoTable;
  if (column >= tables_[table]->columns.size()) return TableError::NoColumn;
  type = tables_[table]->columns[column].type;
  return TableError::None;
}

TableError PlcTables::selectedLine(uint32_t table, uint32_t& line) const noexcept {
  if (!exists(table)) return TableError::NoTable;
  if (tables_[table]->count == 0) return TableError::NoLine;
  line = tables_[table]->selected;
  return TableError::None;
}

TableError PlcTables::select(uint32_t table, uint32_t line) noexcept {
  if (!exists(table)) return TableError::NoTable;
  PlcTable& t = *tables_[table];
  if (line >= t.count) return TableError::NoLine;
  t.dirty = t.dirty || t.selected != line;
  t.selected = line;
  return TableError::None;
}

TableError PlcTables::takeChange(uint32_t table, TableChange& change) noexcept {
  if (!exists(table)) return TableError::NoTable;
  PlcTable& t = *tables_[table];
  change = t.elementChanged ? TableChange::Element : t.selectionChanged ? TableChange::SelectedLine : TableChange::None;
  (t.elementChanged ? t.elementChanged : t.selectionChanged) = false;
  return TableError::None;
}

TableError PlcTables::lineCount(uint32_t table, uint32_t& count) const noexcept {
  if (!exists(table)) return TableError::NoTable;
  count = tables_[table]->count;
  return TableError::None;
}

// The image of PLC tables that survives power-off: a head, then each table with its own head.

namespace {

constexpr uint64_t kMagic = 0x32304C4254434C50; // "PLCTBL02": changes with the format of the image

struct TableHead {
  uint64_t origin;
  uint32_t table;
  uint32_t count;
  uint32_t selected;
  uint32_t bytes; // size of lines and texts
  uint32_t textsEnd;
  uint32_t textsInUse;
};

uint32_t contentBytes(const PlcTable& table) {
  return static_cast<uint32_t>(table.bytes.size() + table.texts.size()); // all tables have at most 2^25
}

uint32_t retainedBytes(const PlcTable& table) { return static_cast<uint32_t>(sizeof(TableHead)) + contentBytes(table); }

void append(std::span<uint8_t>& to, const void* from, size_t size) {
  if (size > 0) std::memcpy(to.data(), from, size);
  to = to.subspan(size);
}

// Reads the head of the next table and checks that the table is complete; returns false otherwise.
bool takeHead(std::span<const uint8_t>& from, TableHead& head) {
  if (from.size() < sizeof head) return false;
  std::memcpy(&head, from.data(), sizeof head);
  from = from.subspan(sizeof head);
  return head.bytes <= from.size();
}

bool fits(const TableHead& head, const PlcTable& table, const uint8_t* bytes) {
  return head.origin == table.origin && head.bytes == contentBytes(table) && head.count <= table.capacity &&
         (head.selected == 0 || head.selected < head.count) &&
         table.textsFit(bytes, head.count, head.textsEnd, head.textsInUse);
}

void restore(PlcTable& table, const TableHead& head, const uint8_t* bytes) {
  table.count = head.count;
  table.selected = head.selected;
  table.textsEnd = head.textsEnd;
  table.textsInUse = head.textsInUse;
  std::copy_n(bytes, table.bytes.size(), table.bytes.begin());
  std::copy_n(bytes + table.bytes.size(), table.texts.size(), table.texts.begin());
  std::fill(table.line(head.count), table.line(table.capacity), uint8_t{0});
  table.dirty = true;
}

} // namespace

uint32_t PlcTables::retainedSize() const noexcept {
  uint32_t size = 0;
  for (const auto& table : tables_)
    if (table) size += retainedBytes(*table);
  return size == 0 ? 0 : size + static_cast<uint32_t>(sizeof kMagic);
}

void PlcTables::copyRetained(std::span<uint8_t> image) const noexcept {
  if (image.empty() || image.size() != retainedSize()) return;
  append(image, &kMagic, sizeof kMagic);
  for (uint32_t i = 0; i < kTables; ++i) {
    if (!exists(i)) continue;
    const PlcTable& t = *tables_[i];
    const TableHead head{t.origin, i, t.count, t.selected, contentBytes(t), t.textsEnd, t.textsInUse};
    append(image, &head, sizeof head);
    append(image, t.bytes.data(), t.bytes.size());
    append(image, t.texts.data(), t.texts.size());
  }
}

bool PlcTables::restoreRetained(std::span<const uint8_t> image) noexcept {
  forgetChanges();
  if (image.empty()) return true;
  if (image.size() < sizeof kMagic || std::memcmp(image.data(), &kMagic, sizeof kMagic) != 0) return false;
  image = image.subspan(sizeof kMagic);
  bool all = true;
  for (TableHead head{}; !image.empty(); image = image.subspan(head.bytes)) {
    if (!takeHead(image, head)) return false;
    if (exists(head.table) && fits(head, *tables_[head.table], image.data()))
      restore(*tables_[head.table], head, image.data());
    else
      all = false;
  }
  return all;
}

void PlcTables::forgetChanges() noexcept {
  for (const auto& table : tables_)
    if (table) table->elementChanged = table->selectionChanged = false;
}

// Conversion of PLC tables from and to the contents of their files.

namespace {

constexpr size_t kMostComplaints = 100;
constexpr size_t kColumnIdBytes = 255;

// A table that is being loaded, and its errors.
class Loading {
public:
  std::unique_ptr<PlcTable> table = std::make_unique<PlcTable>();

  void complain(const host::FilePlace& where, const std::string& what) {
    if (++count_ > kMostComplaints) return;
    complaints_ += (complaints_.empty() ? "" : "\n") + where + ": " + what;
  }
  bool isRight() const { return count_ == 0; }
  std::string complaints() {
    if (count_ > kMostComplaints) complaints_ += "\nand " + std::to_string(count_ - kMostComplaints) + " more mistakes";
    return std::move(complaints_);
  }

  void columns(const TableDefinition& definition);
  void memory(const TableData& data, uint64_t left);
  uint64_t textBytes(const TableData& data) const;
  void elements(const TableData& data);
  void origin();

private:
  std::map<std::string, uint32_t, std::less<>> byId_; // in UTF-8
  std::string complaints_;
  size_t count_ = 0;
};

void Loading::columns(const TableDefinition& definition) {
  table->definition = definition.id;
  for (const TableColumn& column : definition.columns) {
    std::string id;
    if (!toMemory(column.id, id))
      complain(column.place,
               "the column ID " + host::inQuotes(column.id) + " has characters that Windows-1250 does not have");
    if (id.size() > kColumnIdBytes)
      complain(column.place, "the column ID has " + std::to_string(id.size()) + " characters, expected at most " +
                                 std::to_string(kColumnIdBytes));
    byId_.emplace(column.id, static_cast<uint32_t>(table->columns.size()));
    table->columns.push_back({std::move(id), column.type, table->lineBytes});
    table->lineBytes += elementSize(column.type);
  }
}

// Room for texts: their size in memory is at most that in the file.
uint64_t Loading::textBytes(const TableData& data) const {
  if (std::ranges::none_of(table->columns, [](const auto& column) { return isText(column.type); })) return 0;
  uint64_t bytes = PlcTables::kMoreTextBytes;
  for (const TableLine& line : data.lines)
    for (const TableElement& element : line.elements) {
      const auto found = byId_.find(element.column);
      if (found != byId_.end() && isText(table->columns[found->second].type)) bytes += element.value.size();
    }
  return bytes;
}

void Loading::memory(const TableData& data, uint64_t left) {
  table->count = data.lineCount;
  table->selected = data.selected;
  table->capacity = std::min(data.lineCount + PlcTables::kMoreLines, PlcTables::kMostLines);
  const uint64_t bytes = uint64_t{table->capacity} * table->lineBytes, texts = textBytes(data);
  if (bytes + texts > left)
    complain(data.place, "the table needs " + std::to_string(bytes + texts) + " bytes, for " +
                             std::to_string(data.lineCount) + " lines and " +
                             std::to_string(table->capacity - data.lineCount) + " more; " + std::to_string(left) +
                             " of the " + std::to_string(PlcTables::kMostBytes) + " of all tables are left");
  else
    table->bytes.resize(bytes), table->texts.resize(texts), table->otherTexts.resize(texts);
}

void Loading::elements(const TableData& data) {
  for (const TableLine& line : data.lines)
    for (const TableElement& element : line.elements) {
      const auto found = byId_.find(element.column);
      if (found == byId_.end()) {
        complain(element.place, "the definition " + host::inQuotes(table->definition) + " has no column " +
                                    host::inQuotes(element.column));
        continue;
      }
      const PlcTable::Column& column = table->columns[found->second];
      const std::string wrong = readElement(*table, column.type, element.value, table->line(line.number) + column.at);
      if (!wrong.empty()) complain(element.place, "column " + host::inQuotes(element.column) + " " + wrong);
    }
}

// FNV-1a.
class Digest {
public:
  void add(const void* bytes, size_t size) {
    for (size_t i = 0; i < size; ++i) value_ = (value_ ^ static_cast<const uint8_t*>(bytes)[i]) * 0x100000001B3;
  }
  uint64_t value() const { return value_; }

private:
  uint64_t value_ = 0xCBF29CE484222325;
};

void Loading::origin() {
  Digest digest;
  digest.add(table->definition.c_str(), table->definition.size() + 1);
  for (const PlcTable::Column& column : table->columns) {
    digest.add(column.id.c_str(), column.id.size() + 1);
    digest.add(&column.type, sizeof column.type);
  }
  digest.add(&table->count, sizeof table->count);
  digest.add(&table->selected, sizeof table->selected);
  digest.add(table->bytes.data(), table->bytes.size());
  digest.add(table->texts.data(), table->texts.size());
  table->origin = digest.value();
}

} // namespace

uint64_t PlcTables::memoryWithout(uint32_t table) const {
  uint64_t bytes = 0;
  for (uint32_t i = 0; i < kTables; ++i)
    if (i != table && exists(i)) bytes += tables_[i]->bytes.size() + tables_[i]->texts.size();
  return bytes;
}

std::string PlcTables::load(uint32_t table, const TableDefinition& definition, const TableData& data) {
  if (table >= kTables)
    return data.place + ": there is no PLC table " + std::to_string(table) + ", expected 0 to " +
           std::to_string(kTables - 1);
  Loading loading;
  loading.columns(definition);
  loading.memory(data, kMostBytes - memoryWithout(table));
  if (loading.isRight()) loading.elements(data);
  if (!loading.isRight()) return loading.complaints();
  loading.origin();
  tables_[table] = std::move(loading.table);
  return {};
}

void PlcTables::remove(uint32_t table) {
  if (table < kTables) tables_[table].reset();
}

void PlcTables::stored(uint32_t table) noexcept {
  if (exists(table)) tables_[table]->dirty = false;
}

std::optional<TableData> PlcTables::contents(uint32_t table) const {
  if (!exists(table)) return std::nullopt;
  const PlcTable& t = *tables_[table];
  TableData data{.definition = t.definition, .lineCount = t.count, .selected = t.selected};
  for (uint32_t i = 0; i < t.count; ++i) {
    TableLine& line = data.lines.emplace_back();
    line.number = i;
    for (const PlcTable::Column& column : t.columns)
      line.elements.push_back({nc::shownText(column.id), writtenElement(t, column.type, t.line(i) + column.at), {}});
  }
  return data;
}

// Operator functions of PLC tables (see plc_tables.h; man. l.18560-18600: buttons of the editor).

namespace {

std::string called(uint32_t table) { return "PLC table " + std::to_string(table); }

} // namespace

std::string PlcTables::lineProblem(uint32_t table, uint32_t line) const {
  if (!exists(table)) return "there is no " + called(table);
  const uint32_t count = tables_[table]->count;
  if (line < count) return {};
  return called(table) + " has no line " + std::to_string(line) + "; its lines are " +
         (count == 0 ? "none" : "0 to " + std::to_string(count - 1));
}

template <class Value>
std::string PlcTables::editAny(uint32_t table, uint32_t line, std::string_view column, Value value) {
  if (std::string wrong = lineProblem(table, line); !wrong.empty()) return wrong;
  PlcTable& t = *tables_[table];
  std::string id;
  const auto found = std::find_if(t.columns.begin(), t.columns.end(),
                                  [&, known = toMemory(column, id)](const auto& c) { return known && c.id == id; });
  if (found == t.columns.end()) return called(table) + " has no column " + host::inQuotes(column);
  std::string wrong = readElement(t, found->type, value, t.line(line) + found->at);
  if (!wrong.empty()) return "column " + host::inQuotes(column) + " " + wrong;
  t.elementChanged = t.dirty = true;
  return {};
}

std::string PlcTables::edit(uint32_t table, uint32_t line, std::string_view column, std::string_view text) {
  return editAny(table, line, column, text);
}

std::string PlcTables::edit(uint32_t table, uint32_t line, std::string_view column, double number) {
  return editAny(table, line, column, number);
}

std::string PlcTables::selectByOperator(uint32_t table, uint32_t line) {
  if (std::string wrong = lineProblem(table, line); !wrong.empty()) return wrong;
  PlcTable& t = *tables_[table];
  if (t.selected == line) return {};
  t.selected = line;
  t.selectionChanged = t.dirty = true;
  return {};
}

std::string PlcTables::addLine(uint32_t table) {
  if (!exists(table)) return "there is no " + called(table);
  PlcTable& t = *tables_[table];
  if (t.count == t.capacity)
    return called(table) + " has " + std::to_string(t.count) + " lines, and there is no memory for another" +
           (t.count < kMostLines ? "; a restart makes room" : ": it is full");
  ++t.count; // the memory after the last line is zero
  t.elementChanged = t.dirty = true;
  return {};
}

std::string PlcTables::removeLine(uint32_t table, uint32_t line) {
  if (std::string wrong = lineProblem(table, line); !wrong.empty()) return wrong;
  PlcTable& t = *tables_[table];
  t.dropTexts(line);
  std::copy(t.line(line + 1), t.line(t.count), t.line(line));
  --t.count;
  std::fill_n(t.line(t.count), t.lineBytes, uint8_t{0});
  if (line <= t.selected) t.selectionChanged = true; // another line is selected, or its number has changed
  if (line < t.selected || (t.selected == t.count && t.selected > 0)) --t.selected;
  t.elementChanged = t.dirty = true;
  return {};
}

} // namespace rung::io
