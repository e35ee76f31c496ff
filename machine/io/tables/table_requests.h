// PLCT_* and SA_*: PLC tables and shared areas (man. ch. 17, 18.3).
#pragma once
#include <optional>
#include <string_view>

#include "machine/io/device_call.h"
#include "machine/io/shared/shared_areas.h"
#include "machine/io/tables/plc_tables.h"

namespace rung::io {

// The index of the argument that refers to bytes of the program; nothing: none does.
std::optional<uint32_t> bytesArgumentOf(ServiceKind kind);
void answerTable(PlcTables& tables, DeviceCall& call);

void answerArea(SharedAreas& areas, DeviceCall& call);

} // namespace rung::io
