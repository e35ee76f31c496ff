// The axes of the simulated TECHNOL control and everything that moves them: spindles, SPI_AX, positioning units,
// references, manual motion (man. chapters 12, 13.1, 15, 19, 20). It does not access the program's memory: cells are
// passed as plain structs (axis.h). Axes and ports are numbered from 1. After the configuration only functions that
// return texts allocate.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/io/axes/motion.h"
#include "sim/technol/devices/manual_motion.h"
#include "sim/technol/devices/reference.h"
#include "sim/technol/devices/spindles.h"

namespace rung::sim::technol {

using io::kLastSpace;
using io::PositioningUnits;

class Axes {
public:
  // An input bit that is 1 while an axis is physically within low … high (mm).
  struct Switch {
    uint64_t bit = 0; // handle of the caller
    uint32_t axis = 0;
    double low = 0, high = 0;
  };

  // Sets the keys `axes` and `axis.N.ATTRIBUTE`. Returns "", or the error.
  std::string configure(std::string_view key, std::string_view value);
  // Adds `switch.BIT AXIS LOW HIGH`; several switches of one bit are combined.
  std::string addSwitch(uint64_t bit, std::string_view value);
  std::span<const Switch> switches() const { return switches_; }
  bool isClosed(const Switch& contact) const;
  // The configuration for axes that do not exist; "": none.
  std::string configurationProblem() const;

  uint32_t count() const { return static_cast<uint32_t>(letters_.size()); }
  std::string_view letters() const { return letters_; }
  bool exists(uint32_t axis) const { return axis >= 1 && axis <= count(); }

  // Power-up, cold and warm start. STOP PLC changes nothing: motions continue with the last commands.
  void powerUp();
  void startPlc() { manual_.lock(false); }
  // Fault, HALT, after MODULE_HALT: units brake, manual motion ends; the caller sets SU_OUT_PLC to 0.
  void fault();

  // One millisecond. Both parameters have the cells of the previous scan; `requests` is changed.
  void tick(const AxisInputs& in, AxisRequests& requests);
  // The current cells, including those that a command changes at once (PO_OSxPI of SPI_AX).
  void show(AxisOutputs& out) const;

  // Instructions. If an operand is out of range or its axis does not exist, nothing happens except a complaint.
  void analogPort(int64_t port);
  AnalogOutput analog(int64_t value) { return spindles_.put(value); }
  AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi); // ANALOG val,axis[,spi]; 0 if not given
  AnalogOutput analogSpi(int64_t value, int64_t axis);
  AnalogOutput axSpi(int64_t axis, SpindleRole role);
  void spiMain(int64_t axis);
  // Returns whether POLOHV_x must be 1 at once.
  bool spiAx(int64_t axis, const SpindlePositioningOrder& order);
  void regul(int64_t axis, int64_t set); // for axes 1-6
  // `loopClosed`: current value of VAZBA_x.
  void posInit(int64_t axis, int64_t space, bool loopClosed);
  PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration);
  PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp);
  void posReset(int64_t axis);

  // Actions of the operator. They return "", or the error.
  void stop(bool emergency) { operatorStop_ = emergency ? Stop::Emergency : Stop::Normal; }
  std::string reference(std::string_view type, AxisMask axes);
  void autman(bool on) { manual_.panel.switchManual(on); }
  std::string rtm(std::string_view command, bool pressed);
  // The same as `rtm`, without messages; commands for other parts of the control do nothing.
  void key(std::string_view command, bool pressed);
  void handwheel(int64_t pulses, uint32_t wheel = 1) { manual_.panel.turn(pulses, wheel); } // wheel 1 or 2

  // Takes the oldest complaint for the log; returns false if there is none.
  bool takeComplaint(Complaint& complaint) { return complaints_.take(complaint); }

  // Quantities of an axis that exists: NC.MPOS, NC.TRUE, NC.SPEED, NC.SPINDLE, NC.MAINSPINDLE, NC.REGUL; outputs of
  // ports in units of 10 V.
  double measured(uint32_t axis) const { return axes_[axis - 1].measured(); }
  double physical(uint32_t axis) const { return axes_[axis - 1].physical(); }
  double speedPerMinute(uint32_t axis) const { return axes_[axis - 1].speedPerMinute(); }
  uint32_t spindleRole(uint32_t axis) const { return spindles_.role(axes_[axis - 1], axis); }
  uint32_t mainSpindle() const { return spindles_.main(); }
  uint32_t regulator(uint32_t axis) const { return spindles_.regulator(axis); }
  double output(uint32_t port) const { return spindles_.output(port); }
  void setMeasured(uint32_t axis, double value) { axes_[axis - 1].setMeasured(value); }
  void setPhysical(uint32_t axis, double place) { axes_[axis - 1].setPhysical(place); }

  // Without complaints: they are taken at the end of each part of a scan and of each event.
  template <class Archive>
  void state(Archive& archive) {
    archive(axes_, positioning_, spindles_, units_, reference_, manual_, operatorStop_, stopPiWas_, aborted_,
            blockMotion_);
  }

private:
  std::span<Axis> existing() { return {axes_.data(), count()}; }
  std::span<const Axis> existing() const { return {axes_.data(), count()}; }
  Stop takeStop(const AxisInputs& in, AxisRequests& requests);
  bool inRange(std::string_view instruction, int64_t axis);
  bool usable(std::string_view instruction, int64_t axis);
  void dropPositioning(uint32_t index);
  double mainRevolutions() const;

  std::string letters_ = "XYZC";
  std::vector<Switch> switches_;
  std::map<uint32_t, std::string> configured_; // axes in configuration keys, with the first key
  std::array<Axis, kMaxAxes> axes_ = {};
  std::array<SpindlePositioning, kMaxAxes> positioning_ = {};
  Spindles spindles_;
  PositioningUnits units_;
  Reference reference_;
  ManualMotion manual_;
  Complaints complaints_;
  Stop operatorStop_ = Stop::None;
  bool stopPiWas_ = false;
  AxisMask aborted_ = 0;     // axes whose POLOHV_x a command has ended
  AxisMask blockMotion_ = 0; // value in the last tick
};

} // namespace rung::sim::technol
