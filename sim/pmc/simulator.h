// The simulated CNC of the PMC family (`config nc simulated`): before each slot of the PLC it reads X and G, advances
// by one slot of 8 ms and writes F. Its state depends only on the signals and the number of slots.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/pmc/external_data.h"
#include "sim/pmc/machine.h"
#include "sim/pmc/operation.h"
#include "sim/pmc/plc_axes.h"
#include "sim/pmc/spindle.h"
#include "sim/pmc/window.h"

namespace rung::sim::pmc {

inline constexpr uint32_t kResetSlots = 25;   // RST stays on for 200 ms after its cause (l.5253: set by a parameter)
inline constexpr uint32_t kLowSpeedSlots = 3; // slots after which a low-speed window request is answered

class Simulator {
public:
  // The table of the CNC outlives it.
  explicit Simulator(const Cnc& cnc) : cnc_(&cnc), machine_(cnc), operation_(cnc), plcAxes_(*cnc.model) {}

  // Cold: as delivered. Warm: positions, programs and tables are kept, except volatile ones.
  void powerOn(bool warm);
  void step(const nc::pmc::SignalsIo& io);

  template <class Archive>
  void state(Archive& archive) {
    archive(machine_, operation_, manual_, plcAxes_, positioning_, external_, resetKey_, resetSlots_, slots_);
  }

  // Returns "", or the error.
  std::string loadProgram(std::string_view text, bool mdi);
  void pressReset() { resetKey_ = true; }
  void raiseAlarm(uint32_t number) { machine_.alarms.raise(number); }
  // Whether a message of the program puts the CNC into the alarm state; it lasts while the message is shown.
  void setMessageAlarm(bool shown) { machine_.messageAlarm = shown; }
  void turnWheel(uint32_t wheel, int64_t pulses) { manual_.turnWheel(wheel, pulses); }

  void answer(const core::ServiceRequest& request, const nc::pmc::SignalsIo& io, core::ServiceReply& reply) {
    cnc_->answer(request, {machine_, operation_, io, locked_, slots_}, reply);
  }

  // "MPOS.1" and so on (docs/dialects/simulated-nc-DIALECT.md).
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
  void followReset(const nc::pmc::SignalsIo& io);

  const Cnc* cnc_;
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
  uint64_t slots_ = 0; // since the power-on
};

} // namespace rung::sim::pmc
