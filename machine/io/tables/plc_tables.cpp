// What a program asks of PLC tables (see plc_tables.h).
#include "machine/io/tables/plc_tables.h"

#include <cmath>
#include <cstring>

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

} // namespace rung::io
