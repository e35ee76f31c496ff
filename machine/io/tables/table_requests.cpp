// Requests to tables and areas (see table_requests.h).
#include "machine/io/tables/table_requests.h"

namespace rung::io {

namespace {

using enum ServiceKind;

// Arguments 0 to 2 are table, line, column, the fourth is the value; results are DR and the value.
constexpr uint32_t kTextOfColumn = 1, kValueIn = 3, kValueOut = 1;
using Room = std::array<uint8_t, nc::technol::kMostArgumentBytes>;

std::span<const uint8_t> asBytes(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

TableError get(PlcTables& tables, DeviceCall& call) {
  const uint32_t table = call.number(0), line = call.number(1), column = call.number(2);
  TableError error = TableError::None;
  if (call.kind() == TableGetInt) {
    int32_t value = 0;
    error = tables.getInt(table, line, column, value);
    call.set(kValueOut, value);
  } else if (call.kind() == TableGetReal) {
    double value = 0;
    error = tables.getReal(table, line, column, value);
    call.setReal(kValueOut, value);
  } else if (call.kind() == TableGetText) {
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

TableError put(PlcTables& tables, DeviceCall& call) {
  const uint32_t table = call.number(0), line = call.number(1), column = call.number(2);
  Room room;
  switch (call.kind()) {
  case TableSetInt: return tables.setInt(table, line, column, static_cast<int32_t>(call.arg(kValueIn)));
  case TableSetReal: return tables.setReal(table, line, column, call.real(kValueIn));
  case TableSetText: return tables.setText(table, line, column, call.text(kValueIn, room));
  default: return tables.setBinary(table, line, column, call.bytes(kValueIn, room));
  }
}

TableError column(PlcTables& tables, DeviceCall& call) {
  const uint32_t table = call.number(0);
  if (call.kind() == TableColumnIndex) {
    Room room;
    uint32_t number = 0;
    const TableError error = tables.columnIndex(table, call.text(kTextOfColumn, room), number);
    call.set(kValueOut, number);
    return error;
  }
  if (call.kind() == TableColumnId) {
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

TableError lines(PlcTables& tables, DeviceCall& call) {
  const uint32_t table = call.number(0);
  uint32_t number = 0;
  TableChange change{};
  TableError error = TableError::None;
  switch (call.kind()) {
  case TableSelectedLine: error = tables.selectedLine(table, number); break;
  case TableSelect: return tables.select(table, call.number(1));
  case TableLineCount: error = tables.lineCount(table, number); break;
  default: error = tables.takeChange(table, change); number = static_cast<uint32_t>(change);
  }
  call.set(kValueOut, number);
  return error;
}

TableError carryOut(PlcTables& tables, DeviceCall& call) {
  if (call.kind() <= TableGetBinary) return get(tables, call);
  if (call.kind() <= TableSetBinary) return put(tables, call);
  if (call.kind() <= TableColumnType) return column(tables, call);
  return lines(tables, call);
}

} // namespace

std::optional<uint32_t> bytesArgumentOf(ServiceKind kind) {
  if (kind == TableSetText || kind == TableSetBinary) return kValueIn;
  return kind == TableColumnIndex ? std::optional(kTextOfColumn) : std::nullopt;
}

void answerTable(PlcTables& tables, DeviceCall& call) { call.set(0, static_cast<int64_t>(carryOut(tables, call))); }

namespace {

// Sets RLO and DR: done, to be repeated, or an error (man. l.15557-15561).
void setArea(DeviceCall& call, AreaResult result) {
  call.set(0, result == AreaResult::Done ? 1 : 0);
  call.set(1, result == AreaResult::Locked ? 0 : static_cast<int64_t>(result));
}

} // namespace

// Arguments: area, offset, size; the bytes are the third result or the fourth argument.
void answerArea(SharedAreas& areas, DeviceCall& call) {
  if (call.kind() == AreaRead)
    return setArea(call, areas.read(call.number(0), call.number(1), call.makeBytes(2, call.number(2))));
  Room room;
  setArea(call, areas.write(call.number(0), call.number(1), call.bytes(3, room)));
}

} // namespace rung::io
