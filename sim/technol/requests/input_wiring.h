// The machine around the devices, as far as its inputs only say where an axis is or repeat other bits (inventory of the
// services, 15.1):
//   config switch.P1IN.2 1 -1000 -5      1 while axis 1 is physically within -1000 to -5 mm
//   config follow.P1IN.0 P0OUT.3@100ms   the same 100 ms later; /P0OUT.3 its opposite. Shorter changes do not come
//   through
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/run/instance.h"
#include "sim/technol/devices/axes.h"

namespace rung::sim::technol {

class InputWiring {
public:
  // "" or what is wrong; nothing: another key.
  std::optional<std::string> configure(std::string_view key, std::string_view value, Axes& axes);
  void locate(const rung_program& program);
  // Everything has been as it is for long.
  void powerOn(const core::Memory& memory);
  // Before MODULE_INPUT, `us` after the last time.
  void pass(const core::Memory& memory, const Axes& axes, int64_t us);

private:
  struct Bit {
    std::string name; // NAME, or NAME.n of a cell
    core::Place place;
  };
  struct Wire {
    Bit input, source;
    bool inverted = false;
    int64_t delayUs = 0;
    bool level = false; // of the source, since sinceUs
    int64_t sinceUs = 0;
  };
  std::string follow(std::string_view key, std::string_view input, std::string_view value);

  std::vector<Bit> switches_; // their places are the axes' handles
  std::vector<Wire> wires_;
  int64_t nowUs_ = 0;
};

} // namespace rung::sim::technol
