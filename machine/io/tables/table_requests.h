// PLCT_* and SA_*: PLC tables and shared areas (man. ch. 17, 18.3).
#pragma once
#include <optional>
#include <string_view>

#include "machine/io/device_call.h"
#include "machine/io/shared/shared_areas.h"
#include "machine/io/tables/plc_tables.h"

namespace rung::io {

// What a request asks for; None: no such service.
enum class TableOrder : uint8_t {
  None,
  GetInt,
  GetReal,
  GetText,
  GetBinary,
  SetInt,
  SetReal,
  SetText,
  SetBinary,
  ColumnIndex,
  ColumnId,
  ColumnType,
  SelectedLine,
  Select,
  Changed,
  LineCount,
};
TableOrder tableOrder(std::string_view service);
// The argument that means bytes of the program; nothing: none does.
std::optional<uint32_t> bytesArgumentOf(TableOrder order);
void answerTable(PlcTables& tables, TableOrder order, DeviceCall& call);

void readShared(SharedAreas& areas, DeviceCall& call);
void writeShared(SharedAreas& areas, DeviceCall& call);

} // namespace rung::io
