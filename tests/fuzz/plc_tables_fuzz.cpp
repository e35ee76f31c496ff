// libFuzzer target: any bytes as the definition and as the data of a PLC table.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ir/support/check.h"
#include "machine/io/tables/plc_tables.h"

using namespace rung::io;
using namespace rung::host;

namespace {

TableDefinition materials() {
  const auto column = [](const char* id, ColumnType type) { return TableColumn{.id = id, .type = type, .place = "f"}; };
  return {.id = "Materials",
          .columns = {column("Feed", ColumnType::Real), column("Count", ColumnType::Int),
                      column("Název", ColumnType::Text), column("Key", ColumnType::Binary)},
          .place = "f"};
}

void checkDefinition(const TableDefinition& definition) {
  for (const TableColumn& column : definition.columns) {
    RUNG_CHECK(!column.id.empty() && column.type >= ColumnType::Int && column.type <= ColumnType::Binary,
               "a column has a name and a type");
    const auto same = [&](const TableColumn& other) { return other.id == column.id; };
    RUNG_CHECK(std::ranges::count_if(definition.columns, same) == 1, "a column has a name of its own");
  }
}

// What was loaded is written and read as the same.
void checkTable(const PlcTables& tables) {
  const std::string text = tableDataText(*tables.contents(0));
  TableData data;
  RUNG_CHECK(parseTableData("f", text, data).empty(), "what is written is well-formed");
  PlcTables again;
  RUNG_CHECK(again.load(0, materials(), data).empty(), "what is written is right");
  RUNG_CHECK(tableDataText(*again.contents(0)) == text, "what is written is stable");
}

void checkData(const TableData& data) {
  RUNG_CHECK(data.lineCount <= kMostLines && (data.selected == 0 || data.selected < data.lineCount),
             "the selected line is there");
  for (const TableLine& line : data.lines) RUNG_CHECK(line.number < data.lineCount, "a line is there");
  PlcTables tables;
  const std::string mistakes = tables.load(0, materials(), data);
  RUNG_CHECK(mistakes.empty() || mistakes.starts_with("f:"), "a mistake has a place");
  if (mistakes.empty() && data.lineCount <= 1000) checkTable(tables);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  TableDefinition definition;
  TableData data;
  const std::string ofDefinition = parseTableDefinition("f", text, definition);
  const std::string ofData = parseTableData("f", text, data);
  RUNG_CHECK(ofDefinition.empty() || ofDefinition.starts_with("f:"), "a mistake has a place");
  RUNG_CHECK(ofData.empty() || ofData.starts_with("f:"), "a mistake has a place");
  if (ofDefinition.empty()) checkDefinition(definition);
  if (ofData.empty()) checkData(data);
  return 0;
}
