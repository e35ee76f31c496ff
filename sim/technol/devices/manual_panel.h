// What the operator does on panels during manual motion: keys, the preselected axis, the handwheel (man.
// l.17360-17630). Orders come between ticks and are settled in the next one, when the cells of the program are known.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "sim/technol/devices/rtm_command.h"

namespace rung::sim::technol {

class ManualPanel {
public:
  void reset() { *this = ManualPanel(); }
  void key(const RtmCommand& command, bool pressed);
  // Handwheel 1 or 2.
  void turn(int64_t pulses, uint32_t wheel = 1) {
    if (!wheelsOff_[wheel - 1]) pulses_ += pulses;
  }
  // The operator's switch of manual motion: what it was put to since the last tick.
  void switchManual(bool on) { manual_ = on; }
  std::optional<bool> takeManual() { return std::exchange(manual_, std::nullopt); }

  // At the beginning of a tick: steps of the handwheel, SHIFT, the preselection.
  void settle(const AxisInputs& in, AxisRequests& requests);
  void releaseKeys();
  // Pulses since the last tick.
  int64_t takePulses() { return std::exchange(pulses_, 0); }

  AxisMask plus() const;
  AxisMask minus() const;
  bool rapid() const { return rapidKey_ || selectedRapid_ || rapidAxes_ != 0; }
  // The axis for the handwheel, from 1; 0 none.
  uint32_t selected() const { return selected_; }
  // By a key of selection, not along with a motion.
  bool selecting() const { return selected_ != 0 && selectedByKey_; }
  void select(uint32_t axis, bool byKey);

private:
  void press(const RtmCommand& command);
  void release(const RtmCommand& command);
  AxisMask selectedBit() const { return selected_ == 0 ? AxisMask{0} : bitOf(selected_ - 1); }

  AxisMask plus_ = 0, minus_ = 0, rapidAxes_ = 0;
  int32_t moveSelected_ = 0; // +1, -1
  bool selectedRapid_ = false, rapidKey_ = false;
  bool hold_ = false; // keys stay pressed
  uint32_t selected_ = 0;
  bool selectedByKey_ = false;
  int64_t pulses_ = 0;
  std::optional<bool> manual_;
  AxisMask choose_ = 0, moved_ = 0; // since the last tick: keys of selection, keys of motion
  int32_t stepTo_ = 0, stepBy_ = 0;
  int32_t moveOrStep_ = 0; // +1, -1 since the last tick
  bool moveOrStepHeld_ = false;
  std::array<bool, 2> wheelsOff_ = {}; // by KNOB_DISABLE1, KNOB_DISABLE2
  std::optional<bool> shiftSelect_, shiftActivate_;
  bool toggleShift_ = false, toggleActive_ = false;
};

} // namespace rung::sim::technol
