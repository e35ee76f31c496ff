// Tables of services by dialect name.
#include "rtlib/nc/service.h"

#include "rtlib/nc/fanuc/services.h"
#include "rtlib/nc/gsk/services.h"
#include "rtlib/nc/nct/services.h"
#include "rtlib/nc/technol/services.h"

namespace rung::nc {
namespace {

template <class Rows>
auto* rowIn(const Rows& rows, uint32_t kind) {
  return kind - 1 < std::size(rows) ? &rows[kind - 1] : nullptr;
}

// Null for another dialect.
const technol::DeviceService* technolService(std::string_view dialect, uint32_t kind) {
  return dialect == "technol" ? rowIn(technol::deviceServices(), kind) : nullptr;
}

} // namespace

const ServiceRow* serviceOf(std::string_view dialect, uint32_t kind) {
  if (dialect == "fanuc") return rowIn(fanuc::kServices, kind);
  if (dialect == "gsk") return rowIn(gsk::kServices, kind);
  if (dialect == "nct") return rowIn(nct::kServices, kind);
  const technol::DeviceService* row = technolService(dialect, kind);
  return row == nullptr ? nullptr : &row->service;
}

const technol::DeviceService* technol::deviceServiceOf(std::string_view dialect, uint32_t kind) {
  const DeviceService* row = technolService(dialect, kind);
  return row == nullptr || row->device == Device::None ? nullptr : row;
}

bool hasDevices(std::string_view dialect) { return technolService(dialect, 1) != nullptr; }

uint32_t serviceKind(std::string_view dialect, std::string_view text) {
  for (uint32_t kind = 1; const ServiceRow* row = serviceOf(dialect, kind); ++kind)
    if (row->text == text) return kind;
  return kUnknownService;
}

} // namespace rung::nc
