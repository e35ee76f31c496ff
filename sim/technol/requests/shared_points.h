// Elements of the real-time manager that are cells of the program under another name (kSharedElements).
#pragma once
#include <array>
#include <iterator>

#include "rtlib/core/memory.h"
#include "sim/technol/module_cells.h"

namespace rung::sim::technol {

class SharedPoints {
public:
  SharedPoints() = default; // a program that has nothing
  explicit SharedPoints(const rung_program& program);

  // Before the devices: what a connection or a scenario has put at an element goes into the program's cell.
  void take(const core::Memory& memory, const ModuleCells& cells) const;
  // After them: elements are as the program's cells.
  void give(const core::Memory& memory, ModuleCells& cells) const;

private:
  static constexpr uint32_t kMembers = 16;
  const core::Place& placeOf(const ModulePoint& point) const { return places_[point.part][point.number]; }

  std::array<std::array<core::Place, kMembers>, std::size(kSharedElements)> places_;
};

} // namespace rung::sim::technol
