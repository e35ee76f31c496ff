// The simulated CNC of a GSK25i PLC (`config nc simulated`): before each slot of the PLC it reads X and G, advances by
// one slot of 8 ms and writes F. Its state depends only on the signals and the number of slots.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/gsk/machine.h"
#include "sim/gsk/operation.h"
#include "sim/gsk/plc_axes.h"
#include "sim/gsk/spindle.h"
#include "sim/gsk/window.h"

namespace rung::sim::gsk {

inline constexpr uint32_t kResetSlots = 25;   // RST stays on for 200 ms after its cause (l.5253: set by a parameter)
inline constexpr uint32_t kLowSpeedSlots = 3; // slots after which a low-speed window request is answered

class Simulator {
public:
  // Cold: as delivered. Warm: positions, programs and tables are kept, except volatile ones.
  void powerOn(bool warm);
  void step(const nc::gsk::SignalsIo& io);

  // Returns "", or the error.
  std::string loadProgram(std::string_view text, bool mdi);
  void pressReset() { resetKey_ = true; }
  void raiseAlarm(uint32_t number) { machine_.alarms.raise(number); }
  void turnWheel(uint32_t wheel, int64_t pulses) { manual_.turnWheel(wheel, pulses); }

  WindowAnswer answer(const WindowRequest& request, const nc::gsk::SignalsIo& io);

  // "MPOS.1" and so on (docs/dialects/simulated-nc-gsk.md).
  std::optional<double> quantity(std::string_view name) const;
  double machinePosition(uint32_t axis) const; // 0.001 mm, rounded down; 0 if the axis does not exist
  std::string setQuantity(std::string_view name, double value);

  // Configuration, before the first power-on.
  std::string setAxes(std::string_view names);
  void setParameter(uint32_t number, uint32_t axis, double value); // `axis` from 0
  void setJogSpeed(double speed) { manual_.jogSpeed = speed; }
  void setLimitSwitches(bool wired) { machine_.axes.limitSwitches = wired; }
  void setAbsoluteEncoders(bool absolute) { absoluteEncoders_ = absolute; }
  void setProtected(bool locked) { locked_ = locked; }

private:
  struct ConfiguredParameter {
    uint32_t number, axis;
    double value;
  };
  void followReset(const nc::gsk::SignalsIo& io);

  Machine machine_;
  Operation operation_;
  Manual manual_;
  PlcAxes plcAxes_;
  SpindlePositioning positioning_;
  ExternalData external_;
  std::vector<ConfiguredParameter> parameters_; // from the configuration, restored by a cold start
  bool absoluteEncoders_ = true;
  bool locked_ = false;
  bool resetKey_ = false;
  uint32_t resetSlots_ = 0;
};

} // namespace rung::sim::gsk
