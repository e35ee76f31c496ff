// The pins of the axes that positioning units move: PREFIX.position-command and its like.
#pragma once
#include <string>
#include <vector>

#include "tools/host-devices/positioned_axes.h"
#include "tools/mapping/file.h"
#include "tools/plc/pin_cell.h"

namespace rung::host_devices {

class AxisPins {
public:
  // Adds those of an axis to the map, whose box leaves them alone. "" or what is wrong.
  std::string add(mapping::File& map, uint32_t axis, const std::string& prefix);
  // As many cells as the map has pins, in their order; cells and access outlive this.
  void connect(const plc::PinCell* cells, const plc::PinAccess& access) noexcept;

  // ---- the scan; nothing without cells
  void read(PositionedAxes& axes) const noexcept;
  void write(const PositionedAxes& axes) const noexcept;

private:
  struct Pins {
    uint32_t axis = 0;
    uint32_t first = 0; // in File::pins
  };
  std::vector<Pins> pins_;
  const plc::PinCell* cells_ = nullptr;
  const plc::PinAccess* access_ = nullptr;
};

} // namespace rung::host_devices
