// PLC tables from the contents of their files and back (see plc_tables.h).
#include <algorithm>
#include <map>
#include <utility>

#include "machine/io/tables/plc_tables.h"
#include "rtlib/nc/technol/code_page.h"

namespace rung::io {
namespace {

constexpr size_t kMostComplaints = 100;
constexpr size_t kColumnIdBytes = 255;

// A table that is being made, with what is wrong with it.
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
  for (const host::TableColumn& column : definition.columns) {
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

// Room for texts: none is longer in memory than it is written.
uint64_t Loading::textBytes(const TableData& data) const {
  if (std::ranges::none_of(table->columns, [](const auto& column) { return isText(column.type); })) return 0;
  uint64_t bytes = PlcTables::kMoreTextBytes;
  for (const host::TableLine& line : data.lines)
    for (const host::TableElement& element : line.elements) {
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
  for (const host::TableLine& line : data.lines)
    for (const host::TableElement& element : line.elements) {
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
    host::TableLine& line = data.lines.emplace_back();
    line.number = i;
    for (const PlcTable::Column& column : t.columns)
      line.elements.push_back({nc::shownText(column.id), writtenElement(t, column.type, t.line(i) + column.at), {}});
  }
  return data;
}

} // namespace rung::io
