// Files of PLC tables (see table_files.h).
#include "machine/io/tables/table_files.h"

#include <algorithm>
#include <optional>
#include <sys/stat.h>
#include <utility>

#include "rtlib/load/file.h"

namespace rung::io {
namespace {

using host::inQuotes;

constexpr mode_t kModes = 07777;

void addLine(std::string& text, const std::string& line) {
  if (!line.empty()) text += (text.empty() ? "" : "\n") + line;
}

std::string wrongNumber(const std::string& path, uint32_t number) {
  if (number < PlcTables::kTables) return {};
  return path + ": " + std::to_string(number) + " is not the number of a PLC table, expected 0 to " +
         std::to_string(PlcTables::kTables - 1);
}

mode_t modeOf(const std::string& path) {
  struct stat about{};
  return ::stat(path.c_str(), &about) == 0 ? about.st_mode & kModes : runtime::Writing().mode;
}

} // namespace

std::string TableFiles::setDefinition(uint32_t number, const std::string& path) {
  definitions_.erase(number);
  std::string wrong = wrongNumber(path, number);
  TableDefinition definition;
  if (wrong.empty()) wrong = readTableDefinition(path, definition);
  if (wrong.empty()) definitions_.emplace(number, std::move(definition));
  return wrong;
}

std::string TableFiles::setTable(uint32_t number, const std::string& path) {
  files_.erase(number);
  std::string wrong = wrongNumber(path, number);
  TableFile file{.path = path};
  if (wrong.empty()) wrong = readTableData(path, file.data);
  if (wrong.empty()) files_.emplace(number, std::move(file));
  return wrong;
}

const TableDefinition* TableFiles::definitionOf(const TableData& data, std::string& wrong) const {
  const TableDefinition* found = nullptr;
  std::vector<std::string_view> ids;
  for (const auto& [number, definition] : definitions_) {
    ids.push_back(definition.id);
    if (definition.id != data.definition) continue;
    if (found != nullptr)
      wrong = data.place + ": there are two table definitions " + inQuotes(data.definition) + ", at " + found->place +
              " and at " + definition.place + "; expected one";
    found = &definition;
  }
  if (found == nullptr)
    wrong = data.place + ": there is no table definition " + inQuotes(data.definition) +
            (ids.empty() ? ", and no other one" : ", expected " + host::listed(ids));
  return found;
}

std::string TableFiles::loadOne(PlcTables& tables, uint32_t number, const TableFile& file) const {
  tables.remove(number);
  std::string wrong;
  const TableDefinition* definition = definitionOf(file.data, wrong);
  return wrong.empty() ? tables.load(number, *definition, file.data) : wrong;
}

std::string TableFiles::load(PlcTables& tables) const {
  std::string wrong;
  for (uint32_t i = 0; i < PlcTables::kTables; ++i)
    if (!files_.contains(i)) tables.remove(i);
  for (const auto& [number, file] : files_) addLine(wrong, loadOne(tables, number, file));
  return wrong;
}

std::string TableFiles::save(PlcTables& tables, int64_t nowNs) {
  const bool changed =
      std::any_of(files_.begin(), files_.end(), [&](const auto& f) { return tables.isDirty(f.first); });
  if (!changed || nowNs < nextSaveNs_) return {};
  nextSaveNs_ = nowNs + kBetweenSavesNs;
  return saveNow(tables);
}

std::string TableFiles::saveNow(PlcTables& tables) const {
  std::string wrong;
  for (const auto& [number, file] : files_) {
    const std::optional<TableData> data = tables.isDirty(number) ? tables.contents(number) : std::nullopt;
    if (!data) continue;
    const std::string text = tableDataText(*data);
    const std::string failed = runtime::replaceFile(file.path, text, {.mode = modeOf(file.path), .lasts = true});
    addLine(wrong, failed);
    if (failed.empty()) tables.stored(number);
  }
  return wrong;
}

} // namespace rung::io
