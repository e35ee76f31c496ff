// The motion of one axis along an ideal trapezoid: ramps of constant acceleration and runs of constant speed. A motion
// is planned once, as a sequence of phases, and evaluated in each time step by closed formulas, so errors do not
// accumulate and the end is exact. Lengths in mm (degrees), times in seconds.
#pragma once
#include <array>
#include <cstdint>
#include <utility>

#include "machine/io/axes/axis_attributes.h"

namespace rung::io {

class Motion {
public:
  static constexpr int64_t kTickNs = 1'000'000;

  double position() const { return position_; }
  double speed() const { return speed_; } // per second, signed
  bool isAtRest() const { return speed_ == 0 && time_ >= duration_; }
  bool isAtRestAt(double place) const { return isAtRest() && position_ == place; }
  // Seconds from the start of the planned motion to its end; infinite for a run.
  double duration() const { return duration_; }

  // Sets the position; the axis is at rest.
  void place(double position);

  // Commands. Repeating a command in progress changes nothing; another command starts at the current position and
  // speed. Accelerations are positive.
  void stop(double acceleration) { run(0, acceleration); }
  // Ramps to a signed speed and keeps it.
  void run(double speed, double acceleration);
  // Moves to a target with at most `speed`; if the axis cannot brake in time, it passes the target and returns to it.
  void moveTo(double target, double speed, double acceleration);
  // Runs past a position, which lies in the direction of the signed speed and beyond `inRange`, and brakes from there:
  // stops v * v / 2a after it.
  void runPast(double position, double speed, double acceleration);
  // The position from which the axis would move in the direction of the signed speed, no faster than it.
  double inRange(double speed, double acceleration) const;

  // Advances the time by `ns`, at least 0.
  void advance(int64_t ns);
  // One millisecond.
  void tick() { advance(kTickNs); }

  template <class Archive>
  void state(Archive& archive) {
    archive(position_, speed_, order_, phases_, last_, ns_, time_, duration_);
    archive.atMost(count_, kPhases);
    archive.atMost(phase_, kPhases - 1);
  }

private:
  enum class Kind : uint8_t { None, Run, To, Past };
  struct Order {
    Kind kind = Kind::None;
    double place = 0, speed = 0, acceleration = 0;
    bool operator==(const Order&) const = default;
    template <class Archive>
    void state(Archive& archive) {
      archive(kind, place, speed, acceleration);
    }
  };
  struct Phase {
    double begin = 0, position = 0, speed = 0, acceleration = 0; // values at its begin
    template <class Archive>
    void state(Archive& archive) {
      archive(begin, position, speed, acceleration);
    }
  };

  bool isNew(const Order& order);
  void rampTo(double speed, double acceleration);
  void cruise(double distance);
  void append(double seconds, double acceleration, double endPosition, double endSpeed);
  void approach(double target, double speed, double acceleration);
  // Completes the plan. `position` is exact; the phases reach it except for rounding errors.
  void end(double position, double speed);

  static constexpr uint32_t kPhases = 6;
  double position_ = 0, speed_ = 0;
  Order order_;
  std::array<Phase, kPhases> phases_ = {};
  uint32_t count_ = 0, phase_ = 0;
  Phase last_;     // state at the end of the phases so far; finally the end of the motion
  int64_t ns_ = 0; // since the motion was planned
  double time_ = 0, duration_ = 0;
};

// State of an axis shared by all its movers: its configuration, its commanded motion, and its current mover.

enum class Mover : uint8_t { None, SpindlePositioning, PositioningUnit, Reference, Manual };

struct DrivenAxis {
  AxisAttributes attributes;
  Motion motion;
  Mover mover = Mover::None;
  bool requested = false; // PO_OSxPI: a motion is requested, even where it is not permitted (l.6243-6250)
  bool negative = false;  // SM_POxPI: direction of that motion
  bool settled = true;    // the actual position follows `motion` within the configured tolerance

  void request(bool inNegative) {
    requested = true;
    negative = inNegative;
  }
  // The mover releases the axis: it brakes to a standstill, and its motion is reported until then.
  void leave(double acceleration) {
    mover = Mover::None;
    motion.stop(acceleration);
  }

  template <class Archive>
  void state(Archive& archive) {
    archive(motion, mover, requested, negative, settled);
  }
};

// The six positioning units (man. chapter 19): POS_INIT, POS_MODE, POS_CONTROL, POS_RESET. A unit moves an axis by a
// distance, fully controlled by the PLC. Axes are numbered from 1.

inline constexpr int64_t kLastSpace = 6; // index of the last transformation, from 0 (l.12166)

// Status record of POS_CONTROL as a word, first byte in the low bits (l.12065-12093).
inline constexpr uint16_t kUnitMoves = 0x0001, kUnitNegative = 0x0002, kUnitArrived = 0x0008;     // JEDE, SMER, POL
inline constexpr uint16_t kUnitAvailable = 0x0100, kUnitProgrammed = 0x0200, kUnitError = 0x0400; // DISP, PROG, ERR

// Bits of the second byte of the control record (l.12101-12133); the others stay unchanged.
inline constexpr uint8_t kControlBits = 0x0F;
inline constexpr uint8_t kControlMp = 1, kControlInit = 4, kControlContinue = 8;

class PositioningUnits {
public:
  static constexpr uint32_t kUnits = 6; // l.12040

  struct Mode {
    bool accepted = false; // otherwise the control record stays unchanged and is not remembered
    uint8_t control = 0;   // bits in kControlBits
  };
  struct State {
    uint16_t status = 0;
    bool programmed = false; // a control record is remembered, whose bits must become `control`
    uint8_t control = 0;
  };

  void reset() { *this = PositioningUnits(); }
  // `allowed`: the axis exists, its position loop is closed and no other part moves it.
  void init(DrivenAxis& axis, uint32_t number, bool allowed);
  // Distance in µm (1/1000 °), acceleration in mm/s² (l.12224-12238).
  Mode program(const DrivenAxis& axis, uint32_t number, int32_t length, uint16_t acceleration);
  // Speed in 1/65536 mm/min (l.12258).
  State control(const DrivenAxis& axis, uint32_t number, uint32_t feed, bool mp);
  void release(DrivenAxis& axis, uint32_t number);
  // The axis has become a spindle: its unit loses it.
  void lose(DrivenAxis& axis, uint32_t number);
  void fail(uint32_t number) { setBit(errors_, number - 1); }
  bool holds(uint32_t number) const { return find(number) != nullptr; }
  // Fault, HALT: all units brake.
  void brakeAll();

  void drive(DrivenAxis& axis, uint32_t number, const AxisPermits& in);
  void look(DrivenAxis& axis, uint32_t number);

  template <class Archive>
  void state(Archive& archive) {
    archive(units_, errors_);
  }

private:
  struct Unit {
    uint32_t axis = 0;       // 0: free
    bool programmed = false; // PROG
    bool arrived = false;    // POL
    bool braking = false;    // the motion was ended by POS_INIT
    bool placed = false;     // `target` is known: the axis has come to a standstill
    bool started = false;    // the axis has moved since POS_MODE
    bool initiated = false;  // a tick has passed since POS_MODE: INIC has become CONT
    bool mp = false;
    double feed = 0; // per second
    double acceleration = 0, length = 0, target = 0;
    bool underWay() const { return programmed && !arrived; }
    template <class Archive>
    void state(Archive& archive) {
      archive(programmed, arrived, braking, placed, started, initiated, mp, feed, acceleration, length, target);
      archive.atMost(axis, kMaxAxes);
    }
  };
  const Unit* find(uint32_t number) const;
  Unit* find(uint32_t number) { return const_cast<Unit*>(std::as_const(*this).find(number)); }
  Unit* unitFor(uint32_t number);
  static void follow(Unit& unit, DrivenAxis& axis, uint32_t index, const AxisPermits& in);
  static uint8_t controlOf(const Unit& unit);
  uint16_t statusOf(const DrivenAxis& axis, uint32_t number) const;

  std::array<Unit, kUnits> units_ = {};
  AxisMask errors_ = 0; // ERR, until a POS_INIT succeeds; one bit per axis
};

} // namespace rung::io
