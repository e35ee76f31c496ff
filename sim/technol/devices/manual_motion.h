// Commands of keys to the real-time part of the control (RtmCommand, man. l.17360-17630) for manual motion,
// preselection of an axis, the step of the handwheel, and SHIFT.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "sim/technol/devices/axis.h"

namespace rung::sim::technol {

enum class RtmKind : uint8_t {
  Move,         // keys of individual axes
  MoveSelected, // keys for the preselected axis
  MoveOrStep,   // MOVE_KNOB_STEP_UP, MOVENEG_KNOB_STEP_DOWN: MoveSelected, or, in SHIFT, steps of the handwheel
  Select,
  Rapid,       // RAPIDTRAVERSE
  Hold,        // HOLD: keys stay pressed; toggles
  KnobStep,    // KNOB_STEP1 to KNOB_STEP1000
  KnobStepBy,  // KNOB_STEP_UP, KNOB_STEP_DOWN
  KnobTurn,    // KNOB_INC, KNOB_DEC
  KnobEnable,  // KNOB_ENABLE1, KNOB_ENABLE2
  KnobDisable, // KNOB_DISABLE1, KNOB_DISABLE2
  ShiftToggle, // SHIFT_REQ
  ShiftSelect, // SHIFT_ENABLE, SHIFT_DISABLE
  ActivateToggle,
  Activate, // SHIFT_ACTIVATE, SHIFT_DEACTIVATE
};

// The steps of the handwheel in µm (l.17576).
inline constexpr uint16_t kKnobSteps[] = {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};

struct RtmCommand {
  RtmKind kind = RtmKind::Move;
  bool manual = false;          // IMMM: also switches manual motion on
  AxisMask plus = 0, minus = 0; // for Move, Select (plus)
  bool rapid = false;           // ...RT
  int32_t value = 0;            // step in µm; +1 for up, inc, plus; -1 for down, dec, minus; 1 on, 0 off; a wheel
};

// Parses a command. Axes are given by their number from 0 (MOVE03), or by the letters X, Y, Z in `letters`; a missing
// letter moves nothing.
std::optional<RtmCommand> rtmCommand(std::string_view name, std::string_view letters);

// Actions of the operator on panels during manual motion: keys, the preselected axis, the handwheel (man.
// l.17360-17630). Commands arrive between ticks and are processed in the next one, when the cells of the program are
// known.

class ManualPanel {
public:
  void reset() { *this = ManualPanel(); }
  void key(const RtmCommand& command, bool pressed);
  // Pulses of handwheel 1 or 2.
  void turn(int64_t pulses, uint32_t wheel = 1) {
    if (!wheelsOff_[wheel - 1]) pulses_ += pulses;
  }
  // The operator's switch for manual motion: its last change since the previous tick.
  void switchManual(bool on) { manual_ = on; }
  std::optional<bool> takeManual() { return std::exchange(manual_, std::nullopt); }

  // At the beginning of a tick: processes steps of the handwheel, SHIFT and preselection.
  void settle(const AxisInputs& in, AxisRequests& requests);
  void releaseKeys();
  // Takes the pulses since the last tick.
  int64_t takePulses() { return std::exchange(pulses_, 0); }

  AxisMask plus() const;
  AxisMask minus() const;
  bool rapid() const { return rapidKey_ || selectedRapid_ || rapidAxes_ != 0; }
  // The axis of the handwheel, from 1; 0: none.
  uint32_t selected() const { return selected_; }
  // Whether the axis was selected by a selection key, not together with a motion.
  bool selecting() const { return selected_ != 0 && selectedByKey_; }
  void select(uint32_t axis, bool byKey);

  template <class Archive>
  void state(Archive& archive) {
    archive(plus_, minus_, rapidAxes_, moveSelected_, selectedRapid_, rapidKey_, hold_, selectedByKey_, pulses_,
            manual_, choose_, moved_, stepTo_, stepBy_, moveOrStep_, moveOrStepHeld_, wheelsOff_, shiftSelect_,
            shiftActivate_, toggleShift_, toggleActive_);
    archive.atMost(selected_, kMaxAxes);
  }

private:
  void press(const RtmCommand& command);
  void release(const RtmCommand& command);
  AxisMask selectedBit() const { return selected_ == 0 ? AxisMask{0} : bitOf(selected_ - 1); }

  AxisMask plus_ = 0, minus_ = 0, rapidAxes_ = 0;
  int32_t moveSelected_ = 0; // +1, -1
  bool selectedRapid_ = false, rapidKey_ = false;
  bool hold_ = false; // keys stay pressed (HOLD)
  uint32_t selected_ = 0;
  bool selectedByKey_ = false;
  int64_t pulses_ = 0;
  std::optional<bool> manual_;
  AxisMask choose_ = 0, moved_ = 0; // since the last tick: selection keys, motion keys
  int32_t stepTo_ = 0, stepBy_ = 0;
  int32_t moveOrStep_ = 0; // +1, -1 since the last tick
  bool moveOrStepHeld_ = false;
  std::array<bool, 2> wheelsOff_ = {}; // set by KNOB_DISABLE1, KNOB_DISABLE2
  std::optional<bool> shiftSelect_, shiftActivate_;
  bool toggleShift_ = false, toggleActive_ = false;
};

// Manual motion AUTMAN with its handwheel, and SHIFT (man. chapter 20).

class ManualMotion {
public:
  ManualPanel panel;

  void reset() { *this = ManualMotion(); }
  // Ends manual motion; with `locked` it stays off until the program runs again (fault, HALT).
  void lock(bool locked);
  // Another mover takes the axis: it brakes.
  void drop(Axis& axis, uint32_t index);
  // One millisecond, before the axes move. `revolutions`: speed of the main spindle per minute.
  void drive(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, double revolutions);
  // Writes the cells of manual motion.
  void show(std::span<const Axis> axes, AxisOutputs& out) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(panel, on_, active_, locked_, external_, externalSelecting_, ordered_, wheels_, wheelTargets_, atStop_,
            stopPlaces_, shifts_, shifting_, shiftWasActive_, shiftActive_);
  }

private:
  struct Ordered {
    AxisMask plus = 0, minus = 0;
    bool rapid = false;
    template <class Archive>
    void state(Archive& archive) {
      archive(plus, minus, rapid);
    }
  };
  void activate(const AxisInputs& in, AxisRequests& requests);
  Ordered orders(const AxisInputs& in);
  double speed(const Axis& axis, const AxisInputs& in, double revolutions) const;
  void driveAxis(Axis& axis, uint32_t index, const AxisInputs& in, double perMinute);
  void driveWheel(Axis& axis, uint32_t index, const AxisInputs& in);
  void turnWheel(std::span<const Axis> axes, double steps);
  void watchStop(std::span<const Axis> axes, const AxisInputs& in);
  void driveShift(std::span<Axis> axes, const AxisInputs& in, const AxisRequests& requests, double steps);

  bool on_ = false, active_ = false, locked_ = false;
  bool external_ = false, externalSelecting_ = false;
  Ordered ordered_;
  AxisMask wheels_ = 0; // axes that the handwheel moves
  std::array<double, kMaxAxes> wheelTargets_ = {};
  bool atStop_ = true;
  std::array<double, kMaxAxes> stopPlaces_ = {};
  std::array<double, kMaxAxes> shifts_ = {}; // mm, target
  AxisMask shifting_ = 0;
  bool shiftWasActive_ = false, shiftActive_ = false;
};

} // namespace rung::sim::technol
