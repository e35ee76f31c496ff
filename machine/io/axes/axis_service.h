// The axes of this machine that positioning units of a program move (man. ch. 19). Each is a drive that is given a
// place in every step and says where it is; between the orders of the program and these places is the trapezoid that
// simulated axes have, too.
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

// Of the drive of an axis; mm (degrees).
struct DriveInputs {
  double position = 0;  // where the axis is
  bool homed = false;   // commands and `position` count from the same place
  bool enabled = false; // the drive goes where it is commanded
  bool fault = false;
};
struct DriveOutputs {
  double position = 0; // commanded
  bool enable = false; // VAZBA_x: the position loop is to be closed (l.6306)
};

class PositionedAxes final : public PositionTarget {
public:
  // ---- before start
  void add(uint32_t axis);
  static bool takes(std::string_view attribute);
  // "" or what is wrong; the axis may be added later.
  std::string set(uint32_t axis, std::string_view attribute, std::string_view value);
  bool has(int64_t axis) const { return axis >= 1 && axis <= kMaxAxes && io::has(added_, index(axis)); }
  AxisMask added() const { return added_; }

  // ---- the scan; nothing waits, allocates or locks
  void powerOn() noexcept;
  // `inputs` of now, of the axes that were added; what they are to do is in `outputs` then.
  void step(int64_t ns) noexcept;
  DriveInputs& inputs(uint32_t axis) { return axes_[axis - 1].in; }
  DriveOutputs outputs(uint32_t axis) const;
  // At the end of a scan: what the program wants until the next.
  void take(const core::Memory& memory, const AxisCells& cells) noexcept;
  // Before MODULE_INPUT.
  void show(const core::Memory& memory, const AxisCells& cells) noexcept;
  // They brake, and continue when the program orders it (fault, HALT, its end).
  void brake() noexcept { units_.brakeAll(); }
  bool atRest() const noexcept;
  // No drive needs to be enabled any more.
  void open() noexcept { loops_ = 0; }
  // AX_SPI: a spindle until the next power-on.
  void becomeSpindle(uint32_t axis) noexcept;

  void posInit(int64_t axis, int64_t space, bool loopClosed) override;
  PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration) override;
  PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp) override;
  void posReset(int64_t axis) override;

  // ---- any one thread but the scan's: a sentence for each refusal and loss that is new
  void report(std::vector<std::string>& lines);

private:
  // What keeps a unit from an axis.
  enum class Obstacle : uint8_t { None, NotHomed, NotEnabled, Fault, TooFar, Open, Spindle, NoUnit };
  static constexpr size_t kObstacles = 8;
  using Masks = std::array<std::atomic<AxisMask>, kObstacles>;

  struct Axis : DrivenAxis {
    double maxDifference = 0.01;    // of a place that is reached; mm
    double followingErrorLimit = 0; // mm; 0: not checked
    bool spindle = false;
    bool begun = false; // a place has come
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
  Masks refused_{}, lost_{}; // since the last POS_INIT that has succeeded
  std::array<AxisMask, kObstacles> refusedReported_{}, lostReported_{};
};

// Analogue outputs, spindles and positioning units of a program. Orders to axes that this host does not move for it are
// refused: SPI_AX, REGUL_*, and POS_* of axes without pins (inventory of the services, 17).

// SU_OUT_PLC.
class OutputPlaces {
public:
  OutputPlaces() = default; // a program that has nothing
  explicit OutputPlaces(const rung_program& program);
  void zero(const core::Memory& memory) const;

private:
  std::array<core::Place, kAnalogPorts> outputs_;
};

class AxisService final : public AnalogTarget {
public:
  PositionedAxes& positioned() { return positioned_; }

  // ---- the scan; nothing waits, allocates or locks
  void powerOn() noexcept;
  // False: it is refused.
  bool answer(DeviceCall& call, const AxisCells& cells);
  // After a fault: outputs are 0, positioning units brake.
  void fault(const core::Memory& memory, const OutputPlaces& places) noexcept;

  // ---- any one thread but the scan's: a sentence for what went wrong for the first time
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
  uint32_t spindles_ = 0;                            // by AX_SPI, a bit each
  std::atomic<uint32_t> refused_{0}, outOfRange_{0}; // a bit for each kind of request, from AnalogPort on
  uint32_t refusedReported_ = 0, outOfRangeReported_ = 0;
};

// The pins of the axes that positioning units move: PREFIX.position-command and its like.

class AxisPins {
public:
  // Adds those of an axis to the map, whose host leaves them alone. "" or what is wrong.
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
