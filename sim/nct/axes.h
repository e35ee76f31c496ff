// The signals and parameters of the axes (man. 7.10, 7.13, 7.15), looked up once.
#pragma once
#include <array>

#include "rtlib/nc/control/nct/signal_memory.h"
#include "rtlib/nc/nct/axis_codes.h"
#include "sim/nct/parameters.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

struct AxisSignals {
  BitSignal detachRequest{"AP_DETCHR"}, detached{"AN_DETCHA"};
  BitSignal openRequest{"AP_OPNR"}, slaveOpenRequest{"AP_SSLOP"}, open{"AN_OPNA"};
  BitSignal encoderDisabled{"AP_EFD"};
  BitSignal plcRequest{"AP_PLCR"}, plcOwns{"AN_PLCA"};
  BitSignal go{"AP_GOR"}, going{"AN_GOA"}, reset{"AP_RES"};
  BitSignal bufferEmpty{"AN_BEPTY"}, motionDone{"AN_IEPTY"};
  BitSignal wantsPositive{"AN_MTNRP"}, wantsNegative{"AN_MTNRN"}, wantsRapid{"AN_RAPR"};
  BitSignal noPositive{"AP_MTNDP"}, noNegative{"AP_MTNDN"}, noRapid{"AP_RAPD"}, noFeed{"AP_FEEDD"};
  BitSignal switchPositive{"AP_LIMP"}, switchNegative{"AP_LIMN"};
  BitSignal range1BPositive{"AP_LIMSELP"}, range1BNegative{"AP_LIMSELN"};
  BitSignal overPositive{"AN_OTP"}, overNegative{"AN_OTN"};
  BitSignal jogPositive{"AP_JOGP"}, jogNegative{"AP_JOGN"};
  BitSignal lock{"AP_LCK"};
  BitSignal parkRequest{"AP_PARKR"}, parked{"AN_PARKA"};
  BitSignal syncRequest{"AP_SYNCR"}, syncSlave{"AN_SYNCA"}, syncMaster{"AN_SYNCM"};
  BitSignal exchangeRequest{"AP_MIXR"}, exchangeSlave{"AN_MIXA"}, exchangeMaster{"AN_MIXM"};
  BitSignal superRequest{"AP_SPRPNR"}, superSlave{"AN_SPRPNA"}, superMaster{"AN_SPRPNM"};
  BitSignal mirrorRequest{"AP_MIRR"}, mirrored{"AN_MIRA"};
  BitSignal driveReference{"AP_RPE"}, referenced{"AN_RPE"}, referenceEnd{"AN_REFEND"};
  BitSignal atReference[4] = {BitSignal("AN_REFP1"), BitSignal("AN_REFP2"), BitSignal("AN_REFP3"),
                              BitSignal("AN_REFP4")};
  BitSignal inPosition{"AN_INPOS"}, atIndex{"AN_INDP"}, lubrication{"AN_LUBR"}, alarm{"AN_AXALM"};
  BitSignal onSwitch{"N_SW"}, belowSwitch{"N_SWN"}, aboveSwitch{"N_SWP"};

  BitSignal holdAll{"P_HOLD0"}, hold{"CP_HOLD"};
  BitSignal jogMode{"CN_JOG"}, incrementMode{"CN_INCR"}, handwheelMode{"CN_HNDL"}, referenceMode{"CN_REFP"};
  BitSignal jogRapid{"CP_JOGRAP"}, noRange1{"CP_LIM1DIS"};
  WordSignal jogFeed{"CP_JOGFD"}, machiningSpindle{"CP_SINP"};
  RealSignal increment{"CP_INC"}, feedOverride{"CP_FOVER"}, rapidOverride{"CP_ROVER"};
  WordSignal handwheelAxis[4] = {WordSignal("P_H1AS"), WordSignal("P_H2AS"), WordSignal("P_H3AS"),
                                 WordSignal("P_H4AS")};
  WordSignal handwheelMove{"HWMOVE"};

  // Masks of bits in one word that are written together.
  uint32_t acknowledges = BitSignal::masks({open, mirrored, plcOwns});
  uint32_t position =
      BitSignal::masks({inPosition, alarm, referenced, referenceEnd, atReference[0], atReference[1], atReference[2],
                        atReference[3], atIndex, overPositive, overNegative, lubrication});
  uint32_t motion = BitSignal::masks({wantsPositive, wantsNegative, wantsRapid});
  uint32_t switches = BitSignal::masks({onSwitch, belowSwitch, aboveSwitch});
};

struct AxisParameters {
  ParameterPlace assign{2}, name{100}, properties{106}, indexDistance{110};
  ParameterPlace reference[4] = {ParameterPlace(200), ParameterPlace(201), ParameterPlace(202), ParameterPlace(203)};
  ParameterPlace jogControl{316}, servoControl{514}, inPosition{516}, referenceType{900};
  ParameterPlace rangeEnable{1000};
  ParameterPlace range1APositive{1002}, range1ANegative{1003}, range1BPositive{1004}, range1BNegative{1005};
  ParameterPlace lubricationDistance{1273};
  ParameterPlace syncMaster{2101}, syncConfig{2102}, exchangeMaster{2104}, superMaster{2107}, superConfig{2108};
};

// The axes of the machine: positions, motions by MOVCMND commands (man. 6.15), by hand (jog, increments, handwheels,
// reference point) and for part programs, and the signals AN_…, AP_… (man. 7.13). Motions have no ramps: an axis moves
// at its speed or is at rest. Positions are in the unit of the machine (mm, degrees), speeds in units per minute.
//
// A machine position is the commanded one; the encoder lags by kLag times the velocity.

inline constexpr double kLag = 0.02;           // s: time by which the measured position lags the command
inline constexpr double kPulsesPerUnit = 1000; // of an axis encoder
inline constexpr int32_t kHandwheels = 4;

struct AxisCommand {
  enum class Kind : uint8_t { None, Move, Incremental, Dwell, DwellTurns, Jog, Handwheel };
  Kind kind = Kind::None;
  bool rapid = false;
  bool perRevolution = false;
  bool machine = false;     // `distance` is a machine position; otherwise in the current coordinate system
  bool toReference = false; // ends with AN_RPE=1
  double distance = 0;      // target, distance, seconds or revolutions
  double speed = 0;         // per minute or revolution; 0 with Jog: from N0316

  template <class Archive>
  void state(Archive& archive) {
    archive(kind, rapid, perRevolution, machine, toReference, distance, speed);
  }
};

class Axes final : public Topic {
public:
  explicit Axes(Links& links);

  // Axes count from 0. An axis exists if N0002 Axis Assign > 0 and AN_DETCHA=0 (l.8467).
  bool exists(uint32_t axis) const;
  bool plcOwns(uint32_t axis) const; // AP_PLCR=1 and AN_PLCA=1
  double machinePosition(uint32_t axis) const { return axes_[axis].position; }
  double measuredPosition(uint32_t axis) const { return axes_[axis].position - lag(axis); }
  double velocity(uint32_t axis) const { return axes_[axis].velocity; } // units/s
  double lag(uint32_t axis) const { return axes_[axis].velocity * kLag; }
  // The channel that the axis is assigned to, from 0.
  uint32_t channelOf(uint32_t axis) const;

  // MOVCMND. Refused: FL_ER (l.3118-3124); Full: the single-block buffer contains a command.
  enum class Load : uint8_t { Accepted, Full, Refused };
  Load load(int64_t axis, int64_t code, double speed, double distance);

  // For part programs: moves to an absolute machine position, subject to the overrides, holds and disables of its
  // channel and axis; `perMinute` 0 is rapid traverse.
  void moveTo(uint32_t axis, double target, double perMinute);
  bool moving(uint32_t axis) const { return axes_[axis].program.kind != AxisCommand::Kind::None; }
  void setProgramHold(uint32_t channel, bool hold) { programHold_[channel] = hold; }
  void cancel(uint32_t axis);
  // The workpiece's zero point in machine coordinates.
  double zeroPoint(uint32_t axis) const { return axes_[axis].zeroPoint; }

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"handwheel", "axis_alarm"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void cycle() override;
  void timeSlice() override;
  void retain(Retained& retained) override;

  template <class Archive>
  void state(Archive& archive) {
    archive(axes_, programHold_, pulses_, turned_);
  }

private:
  struct Axis {
    double position = 0;
    double zeroPoint = 0;
    double velocity = 0;
    double target = 0;      // of `active` or `program`, once execution has begun
    double rest = 0;        // remaining dwell: seconds or revolutions
    double lubrication = 0; // distance since the last request
    AxisCommand active;     // PLC command in the interpolator
    AxisCommand buffer;     // PLC command in the buffer
    AxisCommand program;    // command of a part program
    double lockedAt = 0;    // measured position under axis lock
    double steps = 0;       // increments and pulses still to move
    bool referenced = false;
    bool referenceEnd = false;
    bool locked = false;
    bool alarm = false;
    bool detached = false;
    bool wantsPositive = false;
    bool wantsNegative = false;
    bool wantsRapid = false;
    int32_t jogBefore = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(position, zeroPoint, velocity, target, rest, lubrication, active, buffer, program, lockedAt, steps,
              referenced, referenceEnd, locked, alarm, detached, wantsPositive, wantsNegative, wantsRapid, jogBefore);
    }
  };
  enum class Pace : uint8_t { Feed, Rapid };

  bool get(const BitSignal& signal, uint32_t axis) const { return links().signals.get(signal, axis); }
  void set(const BitSignal& signal, uint32_t axis, bool value) const { links().signals.set(signal, axis, value); }
  int32_t parameter(const ParameterPlace& place, uint32_t axis) const { return links().parameters->dword(place, axis); }
  double real(const ParameterPlace& place, uint32_t axis) const { return links().parameters->real(place, axis); }
  bool option(const ParameterPlace& place, uint32_t bit, uint32_t axis) const {
    return links().parameters->bit(place, bit, axis);
  }

  // axes.cpp
  bool assigned(uint32_t axis) const { return parameter(parameters_.assign, axis) > 0; }
  void readParameters();
  bool rotary(uint32_t axis) const;
  void name(std::string_view names);

  // Once per PLC cycle: requests and acknowledgements, positions as signals
  void acknowledge(uint32_t axis);
  struct Coupling {
    const BitSignal &request, &slave, &master;
    const ParameterPlace& masterNumber;
  };
  void acknowledge(uint32_t axis, uint32_t asked, uint32_t answers, const Coupling& coupling);
  bool free(uint32_t axis) const;
  void writePositionSignals(uint32_t axis);
  void writeSwitches();
  bool atStrokeLimit(uint32_t axis, bool positive) const;

  // Every time slice
  void stepPlc(uint32_t axis);
  void reset(uint32_t axis);
  void take(uint32_t axis);
  bool execute(uint32_t axis, const AxisCommand& command);
  bool dwell(uint32_t axis, double perSecond);
  void stepProgram(uint32_t axis);
  void stepManual(uint32_t axis);
  void stepIncrement(uint32_t axis, uint32_t channel);
  void stepReference(uint32_t axis);
  void moveSteps(uint32_t axis, double perMinute);
  double jogSpeed(uint32_t axis) const;
  double manualSpeed(uint32_t axis) const;
  double spindleSpeed(uint32_t axis) const;
  int32_t jogDirection(uint32_t axis) const;
  int32_t pulsesFor(uint32_t axis) const;
  double increment(uint32_t axis) const { return links().signals.get(signals_.increment, channelOf(axis)); }
  bool moveTowards(uint32_t axis, double target, double perMinute, Pace pace);
  bool mayMove(uint32_t axis, bool positive, Pace pace) const;
  double strokeLimit(uint32_t axis, bool positive) const;
  void shift(uint32_t axis, double way);
  void follow(uint32_t master, double way);
  void writeMotionSignals(uint32_t axis);

  std::array<Axis, nc::nct::kAxes> axes_{};
  std::array<bool, nc::nct::kChannels> programHold_{};
  std::array<int32_t, kHandwheels> pulses_{}; // since the last time slice
  std::array<int32_t, kHandwheels> turned_{}; // HWMOVE of this time slice
  double rapid_ = 10000;                      // units/min
  double jog_ = 1000;                         // units/min, if N0316 does not select the table
  bool absolute_ = true;                      // encoders
  AxisSignals signals_;
  AxisParameters parameters_;
  uint32_t assigned_ = 0; // one bit each; valid for `revision_`, like switches_
  uint32_t switches_ = 0; // switches that have an axis
  uint32_t revision_ = 0;
  std::vector<ParameterPlace> switchAxis_, switchLow_, switchHigh_; // N1101…, N1133…, N1165…
};

} // namespace rung::sim::nct
