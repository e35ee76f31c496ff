// One axis of the simulated machine: its configuration, where it is physically and what it measures, its zero pulses,
// and who moves it. Places in mm (degrees), speeds in mm/min (degrees/min), accelerations in mm/s² (degrees/s²).
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

// The place of `motion` is the physical one without the shift.
class Axis : public io::DrivenAxis {
public:
  Motion shift;         // SHIFT (l.11057): added to the path after the interpolator, not measured
  bool spindle = false; // speed loop, from AX_SPI to SPI_AX

  // At power-up: at its place, measuring 0.
  void reset();
  double physical() const { return motion.position() + shift.position(); }
  double measured() const { return motion.position() + offset_; }
  double speedPerMinute() const { return (motion.speed() + shift.speed()) * 60; }
  bool moves() const { return !motion.isAtRest() || !shift.isAtRest(); }
  // The place where it is has this measure.
  void setMeasured(double value) { offset_ = value - motion.position(); }
  // Puts it there, physically and measured.
  void setPhysical(double place);
  // The place of `motion` with this measure.
  double placeOf(double measure) const { return measure - offset_; }

  // Its mover leaves it: it brakes to a standstill, until which its motion is reported.
  void brake(double acceleration);
  void tick();

  // Runs in the direction of the signed speed (per minute) past the next zero pulse and brakes from there. A pulse
  // counts from where the speed is at most that and has the right direction.
  void seekPulse(double perMinute, double acceleration);
  // It has passed the pulse, which thereby has the measure `value`.
  bool passedPulse(double value);
  void forgetPulse() { seeks_ = false; }
  double pulse() const { return pulse_; } // the place of `motion` of the last one

private:
  double nextPulse(double from, bool downwards) const;

  double offset_ = 0;
  bool seeks_ = false, seeksDownwards_ = false;
  double pulse_ = 0;
};

// The cells of the program that the axes read and write, as plain numbers. A mask has a bit an axis: axis n is bit n
// - 1.

using io::AxisMask;
using io::bitOf;
using io::clearBit;
using io::has;
using io::Hold;
using io::setBit;

// Only read. What is not said otherwise is as after MODULE_INIT.
struct AxisInputs : io::AxisPermits {
  AxisMask manualEnabled = 0;                       // MPxMAN l.6216
  AxisMask refSwitch = 0, reverseSwitch = 0;        // KRx, KRRx l.6668
  AxisMask slowSwitch = 0;                          // ZPRx
  AxisMask servoSwitch = 0;                         // REF_SERV_n, servo n is that of axis n
  AxisMask blockMotion = 0;                         // axes that a block of the part program moves, of the scenario
  bool block = false;                               // a block of the part program is under way
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

  // FEED_OVR = 0 leaves the potentiometer %F, which the simulation has at 100 %.
  double override() const { return (feedOvr ? feedOverride / 1000. : 1.) * (feedMultiplier / 1000.); }
};

// Written by both sides: copied in before the ticks and out after them.
struct AxisRequests {
  AxisMask positioning = 0;                   // POLOHV_x: 0 written by the program aborts SPI_AX (l.7968)
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
};

// Only written, all of them for axes that exist.
struct AxisOutputs : io::AxisReport {
  bool inPosition = true;                          // INPOS: nothing moves but spindles
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
  std::array<double, kMaxAxes> speed = {};         // mm/min, signed: RTM.Axis.Inc_Ax, without what SHIFT adds
  std::array<double, kMaxAxes> shiftSpeed = {};    // mm/min: what it adds
  AxisMask movedByHand = 0;                        // their speed is that of manual motion
};

enum class Stop : uint8_t { None, Normal, Emergency };

// What the log is to say: `ANALOG: axis 17`.
struct Complaint {
  std::string_view instruction, operand;
  int64_t value = 0;
  std::string_view reason; // begins with a blank, or nothing: out of range
  std::string text() const {
    return std::string(instruction) + ": " + std::string(operand) + " " + std::to_string(value) + std::string(reason);
  }
};

// Messages that have not been fetched yet; the newest are lost when there are too many.
class Complaints {
public:
  void add(const Complaint& complaint) {
    if (count_ < kMost) list_[count_++] = complaint;
  }
  bool empty() const { return count_ == 0; }
  // The oldest.
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
