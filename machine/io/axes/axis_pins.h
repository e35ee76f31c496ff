// The pins of the axes that positioning units move: PREFIX.position-command and its like.
#pragma once
#include <string>
#include <vector>

#include "machine/host/mapping_file.h"
#include "machine/host/pin_cell.h"
#include "machine/io/axes/positioned_axes.h"

namespace rung::io {

class AxisPins {
public:
  // Adds those of an axis to the map, whose box leaves them alone. "" or what is wrong.
  std::string add(host::File& map, uint32_t axis, const std::string& prefix);
  // As many cells as the map has pins, in their order; cells and access outlive this.
  void connect(const host::PinCell* cells, const host::PinAccess& access) noexcept;

  // ---- the scan; nothing without cells
  void read(PositionedAxes& axes) const noexcept;
  void write(const PositionedAxes& axes) const noexcept;

private:
  struct Pins {
    uint32_t axis = 0;
    uint32_t first = 0; // in File::pins
  };
  std::vector<Pins> pins_;
  const host::PinCell* cells_ = nullptr;
  const host::PinAccess* access_ = nullptr;
};

} // namespace rung::io
