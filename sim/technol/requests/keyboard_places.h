// The cells and the procedure of a program that belong to keyboards (man. ch. 11, l.16936-16961, l.1614-1626).
#pragma once
#include <array>

#include "rtlib/nc/control/technol/cells.h"
#include "sim/technol/devices/keyboards.h"

namespace rung::sim::technol {

class KeyboardPlaces {
public:
  KeyboardPlaces() = default; // a program that has nothing
  explicit KeyboardPlaces(const rung_program& program);

  // TL1W to TL4W, TL1K, TL2K, TL1P.
  void write(const core::Memory& memory, const Keyboards& keyboards) const;
  // _ON_CMD. A program that is stopped takes no part.
  void runCommand(runtime::Instance& instance, int64_t code, bool pressed) const;

private:
  static constexpr uint32_t kShown = 7, kMembers = 5;
  std::array<std::array<core::Place, kMembers>, kShown> cells_;
  nc::technol::Procedure onCommand_;
};

} // namespace rung::sim::technol
