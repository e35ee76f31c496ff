// The module cells that simulated devices use (module_cells.h): process data of EtherCAT slaves, servos with EtherCAT
// drives, positions and increments of axes.
#pragma once
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/core/memory.h"
#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/run/instance.h"
#include "sim/technol/devices/axes.h"
#include "sim/technol/devices/axis.h"
#include "sim/technol/devices/ethercat_servo.h"
#include "sim/technol/devices/ethercat_slaves.h"
#include "sim/technol/devices/keyboards.h"
#include "sim/technol/module_cells.h"

namespace rung::sim::technol {

// The value at a point from axes 1 to `axisCount` and servos with a drive, in the point's type. Nothing: they have no
// value for it.
std::optional<uint64_t> givenAt(const ModulePoint& point, const AxisOutputs& axes, uint32_t axisCount,
                                const EthercatServos::Cells& servos);

// To be called before the ticks of a scan: takes outputs of the network. A servo is connected if its status word and
// control word are ends of connections; its status, error and position are then those of the connections.
void takeOutputs(const ModuleCells& cells, EthercatImage& image, EthercatServos::Cells& servos);
// To be called after the ticks: gives inputs of the network and the values of axes and servos.
void giveInputs(ModuleCells& cells, const EthercatImage& image, const EthercatServos::Cells& servos,
                const AxisOutputs& axes, uint32_t axisCount);

// Elements of the real-time manager that are also cells of the program under another name (kSharedElements).

class SharedPoints {
public:
  SharedPoints() = default; // for a program without these cells
  explicit SharedPoints(const rung_program& program);

  // To be called before the devices work: copies values set by a connection or a scenario to the program's cells.
  void take(const core::Memory& memory, const ModuleCells& cells) const;
  // To be called after the devices have worked: copies the program's cells to the elements.
  void give(const core::Memory& memory, ModuleCells& cells) const;

private:
  static constexpr uint32_t kMembers = 16;
  const core::Place& placeOf(const ModulePoint& point) const { return places_[point.part][point.number]; }

  std::array<std::array<core::Place, kMembers>, std::size(kSharedElements)> places_;
};

// The cells and the procedure of a program for keyboards (man. ch. 11, l.16936-16961, l.1614-1626).

class KeyboardPlaces {
public:
  KeyboardPlaces() = default; // for a program without these cells
  explicit KeyboardPlaces(const rung_program& program);

  // TL1W to TL4W, TL1K, TL2K, TL1P.
  void write(const core::Memory& memory, const Keyboards& keyboards) const;
  // Calls _ON_CMD, unless the program is stopped.
  void runCommand(runtime::Instance& instance, int64_t code, bool pressed) const;

private:
  static constexpr uint32_t kShown = 7, kMembers = 5;
  std::array<std::array<core::Place, kMembers>, kShown> cells_;
  nc::technol::Procedure onCommand_;
};

// The machine around the devices, as far as its inputs only say where an axis is or repeat other bits (inventory of the
// services, 15.1):
//   config switch.P1IN.2 1 -1000 -5      1 while axis 1 is physically within -1000 to -5 mm
//   config follow.P1IN.0 P0OUT.3@100ms   the same 100 ms later; /P0OUT.3 its opposite. Shorter changes do not come
//   through

class InputWiring {
public:
  // Returns "", or the error; nothing for other keys.
  std::optional<std::string> configure(std::string_view key, std::string_view value, Axes& axes);
  void locate(const rung_program& program);
  // All sources count as unchanged for a long time.
  void powerOn(const core::Memory& memory);
  // To be called before MODULE_INPUT, `us` after the last call.
  void pass(const core::Memory& memory, const Axes& axes, int64_t us);

  template <class Archive>
  void state(Archive& archive) {
    archive(nowUs_);
    archive.each(wires_);
  }

private:
  struct Bit {
    std::string name; // NAME, or NAME.n of a cell
    core::Place place;
  };
  struct Wire {
    Bit input, source;
    bool inverted = false;
    int64_t delayUs = 0;
    bool level = false; // level of the source, since sinceUs
    int64_t sinceUs = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(level, sinceUs);
    }
  };
  std::string follow(std::string_view key, std::string_view input, std::string_view value);

  std::vector<Bit> switches_; // the indices are the axes' handles
  std::vector<Wire> wires_;
  int64_t nowUs_ = 0;
};

} // namespace rung::sim::technol
