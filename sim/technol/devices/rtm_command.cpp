// Commands of keys (see rtm_command.h).
#include "sim/technol/devices/rtm_command.h"

#include <algorithm>
#include <iterator>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/text/number.h"

namespace rung::sim::technol {
namespace {

using nc::technol::takePrefix;

struct Fixed {
  std::string_view name;
  RtmKind kind;
  int32_t value;
};
constexpr Fixed kFixed[] = {
    {"RAPIDTRAVERSE", RtmKind::Rapid, 0},
    {"HOLD", RtmKind::Hold, 0},
    {"KNOB_STEP_UP", RtmKind::KnobStepBy, 1},
    {"KNOB_STEP_DOWN", RtmKind::KnobStepBy, -1},
    {"KNOB_INC", RtmKind::KnobTurn, 1},
    {"KNOB_DEC", RtmKind::KnobTurn, -1},
    {"SHIFT_REQ", RtmKind::ShiftToggle, 0},
    {"SHIFT_ACT", RtmKind::ActivateToggle, 0},
    {"SHIFT_ENABLE", RtmKind::ShiftSelect, 1},
    {"SHIFT_DISABLE", RtmKind::ShiftSelect, 0},
    {"SHIFT_ACTIVATE", RtmKind::Activate, 1},
    {"SHIFT_DEACTIVATE", RtmKind::Activate, 0},
    {"KNOB_ENABLE1", RtmKind::KnobEnable, 1},
    {"KNOB_ENABLE2", RtmKind::KnobEnable, 2},
    {"KNOB_DISABLE1", RtmKind::KnobDisable, 1},
    {"KNOB_DISABLE2", RtmKind::KnobDisable, 2},
    {"MOVE_KNOB_STEP_UP", RtmKind::MoveOrStep, 1},
    {"MOVENEG_KNOB_STEP_DOWN", RtmKind::MoveOrStep, -1},
};

// 00 to 15.
std::optional<AxisMask> takeNumber(std::string_view& text) {
  if (text.size() < 2) return std::nullopt;
  const auto number = text::numberIn<uint32_t>(text.substr(0, 2));
  if (!number || *number >= kMaxAxes) return std::nullopt;
  text.remove_prefix(2);
  return bitOf(*number);
}

std::optional<AxisMask> takeLetter(std::string_view& text, std::string_view letters) {
  if (text.empty() || text[0] < 'X' || text[0] > 'Z') return std::nullopt;
  const size_t index = letters.find(text[0]);
  text.remove_prefix(1);
  return index < kMaxAxes ? bitOf(static_cast<uint32_t>(index)) : AxisMask{0};
}

void addDirection(std::string_view& text, AxisMask axes, RtmCommand& command) {
  AxisMask& mask = takePrefix(text, "NEG") ? command.minus : command.plus;
  mask = static_cast<AxisMask>(mask | axes);
}

// What follows MOVE: 03NEGRT, X, XNEGY, NEGRT.
std::optional<RtmCommand> move(std::string_view text, std::string_view letters, RtmCommand command) {
  if (const auto axes = takeNumber(text)) {
    addDirection(text, *axes, command);
  } else {
    bool any = false;
    while (const auto letter = takeLetter(text, letters)) {
      any = true;
      addDirection(text, *letter, command);
    }
    if (!any) command.kind = RtmKind::MoveSelected;
    if (!any) command.value = takePrefix(text, "NEG") ? -1 : 1;
  }
  command.rapid = takePrefix(text, "RT");
  if (!text.empty()) return std::nullopt;
  return command;
}

std::optional<RtmCommand> select(std::string_view text, std::string_view letters, RtmCommand command) {
  const auto number = takeNumber(text);
  const auto axes = number ? number : takeLetter(text, letters);
  if (!axes || !text.empty()) return std::nullopt;
  command.kind = RtmKind::Select;
  command.plus = *axes;
  return command;
}

std::optional<RtmCommand> knobStep(std::string_view text, RtmCommand command) {
  const auto step = text::numberIn<int32_t>(text);
  if (!step || std::ranges::find(kKnobSteps, *step) == std::end(kKnobSteps)) return std::nullopt;
  command.kind = RtmKind::KnobStep;
  command.value = *step;
  return command;
}

} // namespace

std::optional<RtmCommand> rtmCommand(std::string_view name, std::string_view letters) {
  RtmCommand command;
  if (!takePrefix(name, "RTMID_")) return std::nullopt;
  command.manual = takePrefix(name, "I");
  if (!takePrefix(name, "MMM_")) return std::nullopt;
  for (const Fixed& fixed : kFixed)
    if (name == fixed.name) {
      command.kind = fixed.kind;
      command.value = fixed.value;
      return command;
    }
  if (takePrefix(name, "MOVE")) return move(name, letters, command);
  if (takePrefix(name, "SEL")) return select(name, letters, command);
  if (takePrefix(name, "KNOB_STEP")) return knobStep(name, command);
  return std::nullopt;
}

} // namespace rung::sim::technol
