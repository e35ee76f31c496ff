// The axes of this machine that positioning units of a program move (man. ch. 19). Each axis is a drive that gets a
// commanded position in every step and reports its actual position; the commanded positions follow the same trapezoid
// as those of simulated axes.
#pragma once
#include <array>
#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/mapping_file.h"
#include "machine/host/pins.h"
#include "machine/io/analog/analog.h"
#include "machine/io/axes/axis_requests.h"
#include "rtlib/run/instance.h"

namespace rung::io {

// Values from and to the drive of an axis; mm (degrees).
struct DriveInputs {
  double position = 0;  // actual position
  bool homed = false;   // commands and `position` have the same origin
  bool enabled = false; // the drive follows its commands
  bool fault = false;
};
struct DriveOutputs {
  double position = 0; // commanded position
  bool enable = false; // VAZBA_x: the position loop must be closed (l.6306)
};

class PositionedAxes final : public PositionTarget {
public:
  // ---- before start
  void add(uint32_t axis);
  static bool takes(std::string_view attribute);
  // Sets an attribute; the axis may be added later. Returns "", or the error.
  std::string set(uint32_t axis, std::string_view attribute, std::string_view value);
  bool has(int64_t axis) const { return axis >= 1 && axis <= kMaxAxes && io::has(added_, index(axis)); }
  AxisMask added() const { return added_; }

  // ---- scan thread; nothing waits, allocates or locks
  void powerOn() noexcept;
  // Uses the current `inputs` of the added axes, and computes their `outputs`.
  void step(int64_t ns) noexcept;
  DriveInputs& inputs(uint32_t axis) { return axes_[axis - 1].in; }
  DriveOutputs outputs(uint32_t axis) const;
  // At the end of a scan: reads the permits and VAZBA_x of the program, which apply until the next scan.
  void take(const core::Memory& memory, const AxisCells& cells) noexcept;
  // Before MODULE_INPUT: writes motions and positions to the cells.
  void show(const core::Memory& memory, const AxisCells& cells) noexcept;
  // Fault, HALT, power-off: the axes brake; they continue when the program commands it.
  void brake() noexcept { units_.brakeAll(); }
  bool atRest() const noexcept;
  // Opens all position loops: no drive needs to be enabled any longer.
  void open() noexcept { loops_ = 0; }
  // AX_SPI: the axis is a spindle until the next power-on.
  void becomeSpindle(uint32_t axis) noexcept;

  void posInit(int64_t axis, int64_t space, bool loopClosed) override;
  PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration) override;
  PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp) override;
  void posReset(int64_t axis) override;

  // ---- any one thread except the scan thread: adds a sentence for each new refusal and loss
  void report(std::vector<std::string>& lines);

private:
  // The reason why a unit cannot move an axis.
  enum class Obstacle : uint8_t { None, NotHomed, NotEnabled, Fault, TooFar, Open, Spindle, NoUnit };
  static constexpr size_t kObstacles = 8;
  using Masks = std::array<std::atomic<AxisMask>, kObstacles>;

  struct Axis : DrivenAxis {
    double maxDifference = 0.01;    // largest distance to a position that counts as reached; mm
    double followingErrorLimit = 0; // mm; 0: not checked
    bool spindle = false;
    bool begun = false; // the drive has reported a position
    DriveInputs in;
  };
  static uint32_t index(int64_t axis) { return static_cast<uint32_t>(axis - 1); }
  static Obstacle obstacleOf(const Axis& axis);
  static bool follows(Obstacle obstacle) { return obstacle != Obstacle::NotHomed && obstacle != Obstacle::NotEnabled; }
  void step(Axis& axis, uint32_t number, int64_t ns) noexcept;
  void note(Masks& masks, Obstacle obstacle, uint32_t number) noexcept;
  void forget(uint32_t number) noexcept;
  static void reportNew(const Masks& masks, std::array<AxisMask, kObstacles>& reported, std::string_view what,
                        std::vector<std::string>& lines);

  std::array<Axis, kMaxAxes> axes_ = {};
  PositioningUnits units_;
  AxisPermits permits_;
  AxisReport report_;
  AxisMask added_ = 0;
  AxisMask loops_ = 0;       // VAZBA_x at the end of the last scan
  Masks refused_{}, lost_{}; // since the last successful POS_INIT
  std::array<AxisMask, kObstacles> refusedReported_{}, lostReported_{};
};

// Analogue outputs, spindles and positioning units of a program. Requests for axes that this host does not move for the
// program are refused: SPI_AX, REGUL_*, and POS_* of axes without pins (inventory of the services, 17).

// The cells SU_OUT_PLC.
class OutputPlaces {
public:
  OutputPlaces() = default; // for a program without these cells
  explicit OutputPlaces(const rung_program& program);
  void zero(const core::Memory& memory) const;

private:
  std::array<core::Place, kAnalogPorts> outputs_;
};

class AxisService final : public AnalogTarget {
public:
  PositionedAxes& positioned() { return positioned_; }

  // ---- scan thread; nothing waits, allocates or locks
  void powerOn() noexcept;
  // Returns false if the request is refused.
  bool answer(DeviceCall& call, const AxisCells& cells);
  // After a fault: sets outputs to 0; positioning units brake.
  void fault(const core::Memory& memory, const OutputPlaces& places) noexcept;

  // ---- any one thread except the scan thread: adds a sentence for each problem that occurs for the first time
  void report(std::vector<std::string>& lines);

private:
  void analogPort(int64_t port) override;
  AnalogOutput analog(int64_t value) override { return outputs_.put(value); }
  AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi) override;
  AnalogOutput analogSpi(int64_t value, int64_t axis) override;
  AnalogOutput axSpi(int64_t axis, SpindleRole role) override;
  void spiMain(int64_t axis) override;

  AnalogOutputs outputs_;
  PositionedAxes positioned_;
  uint32_t spindles_ = 0;                            // set by AX_SPI, one bit per axis
  std::atomic<uint32_t> refused_{0}, outOfRange_{0}; // one bit per kind of request, from AnalogPort on
  uint32_t refusedReported_ = 0, outOfRangeReported_ = 0;
};

// The pins of the axes that positioning units move: PREFIX.position-command and the others.

class AxisPins {
public:
  // Adds the pins of an axis to the map; the host itself does not access them. Returns "", or the error.
  std::string add(host::File& map, uint32_t axis, const std::string& prefix);
  // `cells` has one cell per pin of the map, in the order of the pins; cells and access must outlive this object.
  void connect(const host::PinCell* cells, const host::PinAccess& access) noexcept;

  // ---- scan thread; does nothing without cells
  void read(PositionedAxes& axes) const noexcept;
  void write(const PositionedAxes& axes) const noexcept;

private:
  struct Pins {
    uint32_t axis = 0;
    uint32_t first = 0; // index into File::pins
  };
  std::vector<Pins> pins_;
  const host::PinCell* cells_ = nullptr;
  const host::PinAccess* access_ = nullptr;
};

} // namespace rung::io
