// The simulated CNC beside a GSK25i PLC (`config nc simulated`): it reads X and G, advances by one slot of 8 ms and
// writes F, before each slot of the PLC. Everything is a function of the signals and the number of slots.
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

inline constexpr uint32_t kResetSlots = 25;   // RST stays 200 ms after its cause (l.5253: set by a parameter)
inline constexpr uint32_t kLowSpeedSlots = 3; // a low-speed window request is answered so many slots later

class Simulator {
public:
  // Cold: as delivered. Warm: positions, programs and tables stay, but for what is volatile.
  void powerOn(bool warm);
  void step(const nc::gsk::SignalsIo& io);

  // "" or what is wrong.
  std::string loadProgram(std::string_view text, bool mdi);
  void pressReset() { resetKey_ = true; }
  void raiseAlarm(uint32_t number) { machine_.alarms.raise(number); }
  void turnWheel(uint32_t wheel, int64_t pulses) { manual_.turnWheel(wheel, pulses); }

  WindowAnswer answer(const WindowRequest& request, const nc::gsk::SignalsIo& io);

  // "MPOS.1" and so on (docs/dialects/simulated-nc-gsk.md).
  std::optional<double> quantity(std::string_view name) const;
  double machinePosition(uint32_t axis) const; // 0.001 mm, rounded down; 0 of one that is not there
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
  std::vector<ConfiguredParameter> parameters_; // of the configuration, put back by a cold start
  bool absoluteEncoders_ = true;
  bool locked_ = false;
  bool resetKey_ = false;
  uint32_t resetSlots_ = 0;
};

} // namespace rung::sim::gsk
