// Analogue outputs, spindles and positioning units of a program. Orders to axes that this host does not move for it are
// refused: SPI_AX, REGUL_*, and POS_* of axes without pins (inventory of the services, 17).
#pragma once
#include <array>
#include <atomic>
#include <string>
#include <vector>

#include "machine/io/analog/analog_requests.h"
#include "machine/io/axes/positioned_axes.h"
#include "rtlib/run/instance.h"

namespace rung::io {

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
  bool answer(DeviceOrder order, DeviceCall& call, const AxisCells& cells);
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
  std::atomic<uint32_t> refused_{0}, outOfRange_{0}; // a bit for each order
  uint32_t refusedReported_ = 0, outOfRangeReported_ = 0;
};

} // namespace rung::io
