// Analogue outputs of a control, and the spindle roles of axes that decide which output an instruction sets (TECHNOL
// manual, chapter 12). Ports and axes are numbered from 1; 0 is none. The port of an axis has the axis's number
// (l.7707).
#pragma once
#include <array>
#include <cstdint>

#include "machine/host/mapping_file.h"
#include "machine/io/axes/axis_requests.h"
#include "machine/io/device_call.h"
#include "rung/program.h"

namespace rung::io {

inline constexpr uint32_t kAnalogPorts = 16;   // l.7730
inline constexpr int64_t kRegulatorSets = 4;   // l.8443
inline constexpr int32_t kFullOutput = 0x7FFF; // 10 V (l.8226)

// A change of a port's cell SU_OUT_PLC[port - 1], in units of 10 V (l.14639).
struct AnalogOutput {
  uint32_t port = 0; // 0: no change
  double value = 0;
};

// Second operand of AX_SPI (l.7985-7998).
enum class SpindleRole : uint8_t { Off = 0, Main = 1, Assistant = 2, Keep = 3 };

class AnalogOutputs {
public:
  void reset() { *this = AnalogOutputs(); }
  // SU_OUT_PLC := 0 (fault, HALT).
  void zeroOutputs() { outputs_ = {}; }

  // ANALOG_PORT: the active port until the next ANALOG_PORT (l.7730).
  void selectPort(uint32_t port) { activePort_ = port; }
  // ANALOG [val]: sets the active port, limited to ±7FFFh (l.7773-7783).
  AnalogOutput put(int64_t value) { return putOn(activePort_, value); }
  // ANALOG val,axis[,spi]: sets the output of the current main (1) or assistant spindle (2) (l.8130-8138); without spi
  // (0), that of the axis of the last AX_SPI (l.8048), or of `axis` if there was none.
  AnalogOutput putOnSpindle(int64_t value, uint32_t axis, uint32_t spi);
  // ANALOG_SPI val,axis.
  AnalogOutput putOn(uint32_t port, int64_t value);
  // AX_SPI axis[,spi]. Returns a change only if the role switches the spindle off: its output becomes 0.
  AnalogOutput switchTo(uint32_t axis, SpindleRole role);
  // SPI_MAIN axis: makes a spindle the main spindle.
  void makeMain(uint32_t axis);
  // SPI_AX: the axis is no longer a spindle.
  void leave(uint32_t axis);

  uint32_t main() const { return main_; }
  uint32_t assistant() const { return assistant_; }
  // Whether AX_SPI axis,0 has switched the spindle off.
  bool isOff(uint32_t axis) const { return (off_ >> (axis - 1) & 1) != 0; }
  // Units of 10 V.
  double output(uint32_t port) const { return double{outputs_[port - 1]} / kFullOutput; }

  template <class Archive>
  void state(Archive& archive) {
    archive(outputs_, off_);
    for (uint32_t* number : {&activePort_, &main_, &assistant_, &lastSwitched_}) archive.atMost(*number, kAnalogPorts);
  }

private:
  std::array<double, kAnalogPorts> outputs_ = {}; // whole numbers, -7FFFh to 7FFFh
  uint32_t activePort_ = 0;
  uint32_t main_ = 0, assistant_ = 0;
  uint32_t lastSwitched_ = 0; // axis of the last AX_SPI
  uint32_t off_ = 0;          // one bit per axis
};

// The analogue outputs of a TECHNOL program as pins of a host.

// Adds the pins analog-out-1 to analog-out-16, floats with the values of SU_OUT_PLC, 1 is 10 V (man. l.14639), if the
// program has instructions of analogue outputs. Names that the map already has are left out.
void addAnalogPins(host::File& map, const rung_program& program);

// ANALOG_PORT, ANALOG, ANALOG_SPI, AX_SPI and SPI_MAIN: analogue outputs and spindles (man. ch. 12).

// The owner of the outputs. Operands have been checked by outOfRange; an axis may still not exist.
class AnalogTarget {
public:
  virtual void analogPort(int64_t port) = 0;
  virtual AnalogOutput analog(int64_t value) = 0; // on the active port
  virtual AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi) = 0;
  virtual AnalogOutput analogSpi(int64_t value, int64_t axis) = 0;
  virtual AnalogOutput axSpi(int64_t axis, SpindleRole role) = 0;
  virtual void spiMain(int64_t axis) = 0;

protected:
  ~AnalogTarget() = default;
};

// Returns false for other requests.
bool answerAnalog(AnalogTarget& target, DeviceCall& call);

} // namespace rung::io
