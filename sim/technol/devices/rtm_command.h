// Commands of keys to the real-time part of the control (RtmCommand, man. l.17360-17630): those that order manual
// motion, preselect an axis, set the step of the handwheel, and SHIFT.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/technol/devices/axis_cells.h"

namespace rung::sim::technol {

enum class RtmKind : uint8_t {
  Move,         // keys of axes
  MoveSelected, // keys for the axis that is preselected
  MoveOrStep,   // MOVE_KNOB_STEP_UP, MOVENEG_KNOB_STEP_DOWN: those, or in SHIFT steps of the handwheel
  Select,
  Rapid,       // RAPIDTRAVERSE
  Hold,        // HOLD: keys stay pressed, on and off
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
  bool manual = false;          // IMMM: manual motion is switched on as well
  AxisMask plus = 0, minus = 0; // of Move, Select (plus)
  bool rapid = false;           // ...RT
  int32_t value = 0;            // step in µm; +1 or -1 for up, inc, plus and down, dec, minus; 1 on, 0 off; a wheel
};

// Axes by their number from 0 (MOVE03), or by letter X, Y, Z among `letters`; a letter that is not there moves nothing.
std::optional<RtmCommand> rtmCommand(std::string_view name, std::string_view letters);

} // namespace rung::sim::technol
