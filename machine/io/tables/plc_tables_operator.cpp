// What an operator does with PLC tables (see plc_tables.h; man. l.18560-18600: buttons of the editor).
#include <algorithm>
#include <array>

#include "machine/io/tables/plc_tables.h"

namespace rung::io {
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
  if (line <= t.selected) t.selectionChanged = true; // another line, or another number of it
  if (line < t.selected || (t.selected == t.count && t.selected > 0)) --t.selected;
  t.elementChanged = t.dirty = true;
  return {};
}

} // namespace rung::io
