// Cells of axes (see axis_cells.h).
#include "machine/io/axes/axis_cells.h"

#include "rtlib/nc/control/technol/cells.h"

namespace rung::io {

std::string nameOfAxis(std::string_view pattern, uint32_t axis) {
  constexpr const char* kLetters[] = {"X", "Y", "Z"};
  const size_t at = pattern.find_first_of("#%");
  const bool letter = pattern[at] == '#' && axis <= 3;
  return std::string(pattern.substr(0, at)) + (letter ? kLetters[axis - 1] : std::to_string(axis)) +
         std::string(pattern.substr(at + 1));
}

AxisBits::AxisBits(const rung_program& program, std::string_view pattern) {
  for (uint32_t axis = 1; axis <= kMaxAxes; ++axis)
    places_[axis - 1] = nc::technol::locateSignal(program, nameOfAxis(pattern, axis));
}

AxisMask AxisBits::read(const core::Memory& memory) const {
  AxisMask mask = 0;
  for (uint32_t i = 0; i < kMaxAxes; ++i)
    if (memory.read(places_[i]) != 0) setBit(mask, i);
  return mask;
}

void AxisBits::write(const core::Memory& memory, AxisMask which, AxisMask mask) const {
  for (uint32_t i = 0; i < kMaxAxes; ++i)
    if (has(which, i)) memory.write(places_[i], has(mask, i) ? 1 : 0);
}

AxisCells::AxisCells(const rung_program& program)
    : enabled_(program, "MP#PI"), limitPlus_(program, "KH#0"), limitMinus_(program, "KH#1"), loops_(program, "VAZBA_#"),
      motions_(program, "PO_OS#PI"), directions_(program, "SM_PO#PI") {
  nc::technol::locateElements(program, "B_POL_EX", positionEx_);
  nc::technol::locateElements(program, "B_POL", positionShort_);
  nc::technol::locateElements(program, "B_INK_EX", incrementEx_);
  nc::technol::locateElements(program, "B_INK", incrementShort_);
  for (uint32_t space = 1; space <= positionOfSpaces_.size(); ++space)
    nc::technol::locateElements(program, "POSITION_POS" + std::to_string(space) + "_EX", positionOfSpaces_[space - 1]);
}

void AxisCells::read(const core::Memory& memory, AxisPermits& permits) const {
  permits.enabled = enabled_.read(memory);
  permits.limitPlus = limitPlus_.read(memory);
  permits.limitMinus = limitMinus_.read(memory);
}

// A position is the sum of both buffers (l.5988); all of it is in B_POL.
void AxisCells::write(const core::Memory& memory, AxisMask which, const AxisReport& report) const {
  motions_.write(memory, which, report.motion);
  directions_.write(memory, which, report.negative);
  for (uint32_t i = 0; i < kMaxAxes; ++i) {
    if (!has(which, i)) continue;
    if (i < positionShort_.size()) {
      memory.write(positionShort_[i], static_cast<uint64_t>(report.positionShort[i]));
      memory.write(incrementShort_[i], 0);
    }
    memory.write(positionEx_[i], static_cast<uint64_t>(report.positionEx[i]));
    memory.write(incrementEx_[i], 0);
    for (const auto& places : positionOfSpaces_) memory.write(places[i], static_cast<uint64_t>(report.positionEx[i]));
  }
}

} // namespace rung::io
