// PLCT_* and SA_*: PLC tables and shared areas (man. ch. 17, 18.3).
#pragma once
#include <optional>
#include <string_view>

#include "tools/device-requests/device_call.h"
#include "tools/devices/shared/shared_areas.h"
#include "tools/devices/tables/plc_tables.h"

namespace rung::device_requests {

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
void answerTable(devices::PlcTables& tables, TableOrder order, DeviceCall& call);

void readShared(devices::SharedAreas& areas, DeviceCall& call);
void writeShared(devices::SharedAreas& areas, DeviceCall& call);

} // namespace rung::device_requests
