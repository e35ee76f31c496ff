// Requests to tables and areas (see table_requests.h).
#include "machine/io/tables/table_requests.h"

#include <iterator>

namespace rung::io {

namespace {

constexpr std::string_view kOrders[] = {"",
                                        "PLCT_GET_INT",
                                        "PLCT_GET_REAL",
                                        "PLCT_GET_STR",
                                        "PLCT_GET_BIN",
                                        "PLCT_SET_INT",
                                        "PLCT_SET_REAL",
                                        "PLCT_SET_STR",
                                        "PLCT_SET_BIN",
                                        "PLCT_COL_INDEX",
                                        "PLCT_COL_ID",
                                        "PLCT_COL_TYPE",
                                        "PLCT_GET_SELLINE",
                                        "PLCT_SET_SELLINE",
                                        "PLCT_CHANGED",
                                        "PLCT_GET_LINESCOUNT"};

// Arguments 0 to 2 are table, line, column, the fourth is the value; results are DR and the value.
constexpr uint32_t kTextOfColumn = 1, kValueIn = 3, kValueOut = 1;
using Room = std::array<uint8_t, nc::technol::kMostArgumentBytes>;

std::span<const uint8_t> asBytes(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

TableError get(PlcTables& tables, TableOrder order, DeviceCall& call) {
  const uint32_t table = call.number(0), line = call.number(1), column = call.number(2);
  TableError error = TableError::None;
  if (order == TableOrder::GetInt) {
    int32_t value = 0;
    error = tables.getInt(table, line, column, value);
    call.set(kValueOut, value);
  } else if (order == TableOrder::GetReal) {
    double value = 0;
    error = tables.getReal(table, line, column, value);
    call.setReal(kValueOut, value);
  } else if (order == TableOrder::GetText) {
    std::string_view text;
    error = tables.getText(table, line, column, text);
    call.setBytes(kValueOut, asBytes(text));
  } else {
    std::span<const uint8_t> bytes;
    error = tables.getBinary(table, line, column, bytes);
    call.setBytes(kValueOut, bytes);
  }
  return error;
}

TableError put(PlcTables& tables, TableOrder order, DeviceCall& call) {
  const uint32_t table = call.number(0), line = call.number(1), column = call.number(2);
  Room room;
  switch (order) {
  case TableOrder::SetInt: return tables.setInt(table, line, column, static_cast<int32_t>(call.arg(kValueIn)));
  case TableOrder::SetReal: return tables.setReal(table, line, column, call.real(kValueIn));
  case TableOrder::SetText: return tables.setText(table, line, column, call.text(kValueIn, room));
  default: return tables.setBinary(table, line, column, call.bytes(kValueIn, room));
  }
}

TableError column(PlcTables& tables, TableOrder order, DeviceCall& call) {
  const uint32_t table = call.number(0);
  if (order == TableOrder::ColumnIndex) {
    Room room;
    uint32_t number = 0;
    const TableError error = tables.columnIndex(table, call.text(kTextOfColumn, room), number);
    call.set(kValueOut, number);
    return error;
  }
  if (order == TableOrder::ColumnId) {
    std::string_view id;
    const TableError error = tables.columnId(table, call.number(1), id);
    call.setBytes(kValueOut, asBytes(id));
    return error;
  }
  ColumnType type{};
  const TableError error = tables.columnType(table, call.number(1), type);
  call.set(kValueOut, static_cast<int64_t>(type));
  return error;
}

TableError lines(PlcTables& tables, TableOrder order, DeviceCall& call) {
  const uint32_t table = call.number(0);
  uint32_t number = 0;
  TableChange change{};
  TableError error = TableError::None;
  switch (order) {
  case TableOrder::SelectedLine: error = tables.selectedLine(table, number); break;
  case TableOrder::Select: return tables.select(table, call.number(1));
  case TableOrder::LineCount: error = tables.lineCount(table, number); break;
  default: error = tables.takeChange(table, change); number = static_cast<uint32_t>(change);
  }
  call.set(kValueOut, number);
  return error;
}

TableError carryOut(PlcTables& tables, TableOrder order, DeviceCall& call) {
  if (order <= TableOrder::GetBinary) return get(tables, order, call);
  if (order <= TableOrder::SetBinary) return put(tables, order, call);
  if (order <= TableOrder::ColumnType) return column(tables, order, call);
  return lines(tables, order, call);
}

} // namespace

TableOrder tableOrder(std::string_view service) { return orderOf<TableOrder>(kOrders, service); }

std::optional<uint32_t> bytesArgumentOf(TableOrder order) {
  if (order == TableOrder::SetText || order == TableOrder::SetBinary) return kValueIn;
  return order == TableOrder::ColumnIndex ? std::optional(kTextOfColumn) : std::nullopt;
}

void answerTable(PlcTables& tables, TableOrder order, DeviceCall& call) {
  call.set(0, static_cast<int64_t>(carryOut(tables, order, call)));
}

namespace {

// RLO and DR: done, to be asked again, or an error (man. l.15557-15561).
void setArea(DeviceCall& call, AreaResult result) {
  call.set(0, result == AreaResult::Done ? 1 : 0);
  call.set(1, result == AreaResult::Locked ? 0 : static_cast<int64_t>(result));
}

} // namespace

// Arguments: area, offset, size; the bytes are the third result or the fourth argument.
void readShared(SharedAreas& areas, DeviceCall& call) {
  setArea(call, areas.read(call.number(0), call.number(1), call.makeBytes(2, call.number(2))));
}

void writeShared(SharedAreas& areas, DeviceCall& call) {
  Room room;
  setArea(call, areas.write(call.number(0), call.number(1), call.bytes(3, room)));
}

} // namespace rung::io
