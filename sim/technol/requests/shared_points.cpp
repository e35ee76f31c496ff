// Cells of the program as elements of the real-time manager (see shared_points.h).
#include "sim/technol/requests/shared_points.h"

#include <string>

#include "rtlib/nc/control/technol/cells.h"

namespace rung::sim::technol {
namespace {

constexpr bool isShared(const ModulePoint& point) { return point.kind == ModulePoint::Kind::Shared; }

// SHIFT_ENABLE has a bit an axis, of the first eight (l.11120).
core::Place bitOfAxis(const rung_program& program, std::string_view cell, uint32_t axis) {
  const auto whole = nc::technol::signalPlace(program, cell);
  const auto bit = whole ? runtime::bitOf(*whole, axis) : std::nullopt;
  return bit ? runtime::locate({program, nullptr}, *bit) : core::Place();
}

} // namespace

SharedPoints::SharedPoints(const rung_program& program) {
  for (uint32_t row = 0; row < places_.size(); ++row) {
    const SharedElement& shared = kSharedElements[row];
    const bool isBitOfAxis = shared.cell == "SHIFT_ENABLE";
    const std::string cell(shared.cell);
    for (uint32_t i = 0; i < kMembers; ++i)
      places_[row][i] =
          isBitOfAxis ? bitOfAxis(program, cell, i)
                      : nc::technol::locateSignal(program, shared.area == "RTM.Axis" ? cell : cell + std::to_string(i));
  }
}

void SharedPoints::take(const core::Memory& memory, const ModuleCells& cells) const {
  for (const ModuleCells::PointCell& at : cells.points()) {
    const ModuleCell& cell = cells.at(at.cell);
    if (isShared(at.point) && cell.bits != cell.given) memory.write(placeOf(at.point), cell.bits);
  }
}

void SharedPoints::give(const core::Memory& memory, ModuleCells& cells) const {
  for (const ModuleCells::PointCell& at : cells.points()) {
    if (!isShared(at.point)) continue;
    ModuleCell& cell = cells.at(at.cell);
    cell.bits = cell.given = memory.read(placeOf(at.point));
  }
}

} // namespace rung::sim::technol
