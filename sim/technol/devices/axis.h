// One axis of the simulated machine: its configuration, its physical and measured positions, its zero pulses, and its
// mover. Positions in mm (degrees), speeds in mm/min (degrees/min), accelerations in mm/s² (degrees/s²).
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "machine/io/axes/axis_attributes.h"
#include "machine/io/axes/motion.h"

namespace rung::sim::technol {

using io::AxisAttributes;
using io::kDegreesPerTurn;
using io::kFarthest;
using io::kMaxAxes;
using io::Motion;
using io::Mover;

// The position of `motion` is the physical one without the shift.
class Axis : public io::DrivenAxis {
public:
  Motion shift;         // SHIFT (l.11057): added to the path after the interpolator, not measured
  bool spindle = false; // speed loop, from AX_SPI to SPI_AX

  // Power-up: the axis is at its configured position and measures 0.
  void reset();
  double physical() const { return motion.position() + shift.position(); }
  double measured() const { return motion.position() + offset_; }
  double speedPerMinute() const { return (motion.speed() + shift.speed()) * 60; }
  bool moves() const { return !motion.isAtRest() || !shift.isAtRest(); }
  // Sets the measure at the current position.
  void setMeasured(double value) { offset_ = value - motion.position(); }
  // Sets the physical and the measured position.
  void setPhysical(double place);
  // The position of `motion` for a measure.
  double placeOf(double measure) const { return measure - offset_; }

  // The mover releases the axis: it brakes to a standstill, and its motion is reported until then.
  void brake(double acceleration);
  void tick();

  // Runs in the direction of the signed speed (per minute) past the next zero pulse and brakes from there. A pulse
  // counts once the axis has the right direction and at most this speed.
  void seekPulse(double perMinute, double acceleration);
  // Returns whether the axis has passed the pulse; the measure at the pulse is then `value`.
  bool passedPulse(double value);
  void forgetPulse() { seeks_ = false; }
  double pulse() const { return pulse_; } // position of `motion` at the last pulse

  template <class Archive>
  void state(Archive& archive) {
    archive(shift, spindle, offset_, seeks_, seeksDownwards_, pulse_);
    io::DrivenAxis::state(archive);
  }

private:
  double nextPulse(double from, bool downwards) const;

  double offset_ = 0;
  bool seeks_ = false, seeksDownwards_ = false;
  double pulse_ = 0;
};

// The program's cells that the axes read and write, as plain numbers. A mask has one bit per axis: axis n is bit n - 1.

using io::AxisMask;
using io::bitOf;
using io::clearBit;
using io::has;
using io::Hold;
using io::setBit;

// Cells that are only read. The default values are those after MODULE_INIT.
struct AxisInputs : io::AxisPermits {
  AxisMask manualEnabled = 0;                       // MPxMAN l.6216
  AxisMask refSwitch = 0, reverseSwitch = 0;        // KRx, KRRx l.6668
  AxisMask slowSwitch = 0;                          // ZPRx
  AxisMask servoSwitch = 0;                         // REF_SERV_n; servo n belongs to axis n
  AxisMask blockMotion = 0;                         // axes that a block of the part program moves, from the scenario
  bool block = false;                               // a block of the part program is in progress
  bool stopPi = false;                              // STOPPI l.6396
  bool feedOvr = false;                             // FEED_OVR l.6530
  uint16_t feedOverride = 1000;                     // WORD.BZH09, 1/1000
  uint16_t feedMultiplier = 1000;                   // FEED_OVR_MULTIPLIER, 1/1000 l.6542
  std::array<int64_t, kMaxAxes> refpointDist = {};  // REFPOINT_DIST, 1/65536 µm l.6647
  std::array<int32_t, kMaxAxes> servoPosition = {}; // SERVO_POSITION, in µm

  // Manual motion, l.10842-11056.
  bool autmanAllowed = true;                    // EN_AUTMAN
  bool autmanReq = false;                       // AUTMAN_REQ
  bool externalControl = false;                 // REQ_EXT_CONT_AUTMAN
  bool externalSelect = false;                  // REQ_EXT_SELECT_AUTMAN
  bool externalRapid = false;                   // REQ_EXT_G00_AUTMAN
  bool externalFeed = false;                    // REQ_EXT_FEED_AUTMAN
  bool externalRapidFeed = false;               // REQ_EXT_FEED_G00_AUTMAN
  AxisMask externalPlus = 0, externalMinus = 0; // EXM_x0, EXM_x1
  uint16_t feed = 0;                            // EXT_FEED_AUTMAN, mm/min or µm/rev
  uint16_t rapidFeed = 0;                       // EXT_FEED_G00_AUTMAN, mm/min
  bool perRevolution = false;                   // G95_AUTMAN
  bool noWheelSelect = false;                   // AUTMAN_WHEEL_DIS
  bool selectToggles = false;                   // AUTMAN_KNOB_TOGGLE
  uint8_t shiftEnable = 0x3F;                   // SHIFT_ENABLE

  // With FEED_OVR = 0 the potentiometer %F applies, which is always at 100 % in the simulation.
  double override() const { return (feedOvr ? feedOverride / 1000. : 1.) * (feedMultiplier / 1000.); }
};

// Cells that both sides write: copied in before the ticks and out after them.
struct AxisRequests {
  AxisMask positioning = 0;                   // POLOHV_x: the program aborts SPI_AX by writing 0 (l.7968)
  AxisMask homing = 0;                        // HOMING l.6640
  AxisMask homingReq = 0, homingStartReq = 0; // HOMING_REQ, HOMING_START_REQ
  bool homingSingle = false, homingPlc = false, homingGroup = false;
  AxisMask homingAxes = 0;      // PB_HOMING_AXIS l.11776
  AxisMask nonlinearEnable = 0; // NlcAxisEnable
  AxisMask softLimits = 0;      // SLS_REFER
  bool stopReq = false, stopEmergencyReq = false;
  bool autmanSelect = false, autmanCancel = false; // l.11022-11030
  bool shiftSelected = false, shiftActive = false; // REQ_ESHIFT, ACT_ESHIFT
  uint16_t knobStep = 0;                           // KNOB_STEP, µm

  template <class Archive>
  void state(Archive& archive) {
    archive(positioning, homing, homingReq, homingStartReq, homingSingle, homingPlc, homingGroup, homingAxes,
            nonlinearEnable, softLimits, stopReq, stopEmergencyReq, autmanSelect, autmanCancel, shiftSelected,
            shiftActive, knobStep);
  }
};

// Cells that are only written, all of them for axes that exist.
struct AxisOutputs : io::AxisReport {
  bool inPosition = true;                          // INPOS: nothing moves except spindles
  bool reference = false;                          // REFPI
  bool manual = false;                             // ACK_AUTMAN
  bool atStop = true;                              // INPOS_STOP
  bool panelControl = false, wheelControl = false; // AUTMAN_CONT_NC, AUTMAN_CONT_TOC
  bool selecting = false, rapid = false;           // AUTMAN_CONT_SELECT, AUTMAN_CONT_G00
  AxisMask manualPlus = 0, manualMinus = 0;        // MM_x0, MM_x1
  uint8_t shiftControl = 0;                        // SHIFT_CONTROL
  std::array<int32_t, 6> shift = {};               // SHIFT_x, 1/8 µm
  std::array<uint8_t, kMaxAxes> knobSelected = {}; // KnobSelAxn: 1 manual, 2 SHIFT
  std::array<double, kMaxAxes> position = {};      // mm: RTM.Axis.Posk_Ax, k < 6
  std::array<double, kMaxAxes> shiftMm = {};       // Pos6ShiftAxn; POS6 is position + shiftMm
  std::array<double, kMaxAxes> speed = {};         // mm/min, signed: RTM.Axis.Inc_Ax, without the speed of SHIFT
  std::array<double, kMaxAxes> shiftSpeed = {};    // mm/min: the speed of SHIFT
  AxisMask movedByHand = 0;                        // axes whose speed is that of manual motion

  template <class Archive>
  void state(Archive& archive) {
    archive(inPosition, reference, manual, atStop, panelControl, wheelControl, selecting, rapid, manualPlus,
            manualMinus, shiftControl, shift, knobSelected, position, shiftMm, speed, shiftSpeed, movedByHand);
    io::AxisReport::state(archive);
  }
};

enum class Stop : uint8_t { None, Normal, Emergency };

// A message for the log: `ANALOG: axis 17`.
struct Complaint {
  std::string_view instruction, operand;
  int64_t value = 0;
  std::string_view reason; // begins with a blank; empty: out of range
  std::string text() const {
    return std::string(instruction) + ": " + std::string(operand) + " " + std::to_string(value) + std::string(reason);
  }
};

// Messages that have not been taken yet; if there are too many, the newest are lost.
class Complaints {
public:
  void add(const Complaint& complaint) {
    if (count_ < kMost) list_[count_++] = complaint;
  }
  bool empty() const { return count_ == 0; }
  // Takes the oldest message.
  bool take(Complaint& complaint) {
    if (count_ == 0) return false;
    complaint = list_[0];
    --count_;
    for (uint32_t i = 0; i < count_; ++i) list_[i] = list_[i + 1];
    return true;
  }

private:
  static constexpr uint32_t kMost = 16;
  std::array<Complaint, kMost> list_ = {};
  uint32_t count_ = 0;
};

} // namespace rung::sim::technol
