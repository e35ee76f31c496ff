// Keyboards in a program (see keyboard_places.h).
#include "sim/technol/requests/keyboard_places.h"

#include <iterator>

#include "sim/technol/events.h"

namespace rung::sim::technol {
namespace {

constexpr const char* kStructures[] = {"TL1W", "TL2W", "TL3W", "TL4W", "TL1K", "TL2K", "TL1P"};
constexpr const char* kNames[] = {"TL_Function", "TL_FunctionReq", "TL_Fun1State", "TL_Fun2State", "TL_Fun3State"};

} // namespace

KeyboardPlaces::KeyboardPlaces(const rung_program& program) : onCommand_(program, "_ON_CMD") {
  static_assert(std::size(kStructures) == kShown && std::size(kNames) == kMembers);
  for (uint32_t keyboard = 0; keyboard < kShown; ++keyboard)
    for (uint32_t i = 0; i < kMembers; ++i)
      cells_[keyboard][i] = nc::technol::locateSignal(program, std::string(kStructures[keyboard]) + "." + kNames[i]);
}

void KeyboardPlaces::write(const core::Memory& memory, const Keyboards& keyboards) const {
  for (uint32_t keyboard = 0; keyboard < kShown; ++keyboard) {
    const KeyboardState& state = keyboards.state(keyboard);
    const uint8_t values[] = {state.function, state.requested, state.states[0], state.states[1], state.states[2]};
    for (uint32_t i = 0; i < kMembers; ++i) memory.write(cells_[keyboard][i], values[i]);
  }
}

void KeyboardPlaces::runCommand(runtime::Instance& instance, int64_t code, bool pressed) const {
  if (!instance.stopped()) onCommand_.run(instance, commandRegister(code), pressed);
}

} // namespace rung::sim::technol
