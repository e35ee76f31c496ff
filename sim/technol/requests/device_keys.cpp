// Keys that are pressed and released, by an event or by a bit that is connected to the virtual keyboard (see
// simulated_devices.h; man. ch. 11, l.12493-12503).
#include "sim/technol/requests/simulated_devices.h"

namespace rung::sim::technol {
namespace {

constexpr EventKey kKeys[] = {required({"keyboard", 0, Keyboards::kKeyboards - 1}),
                              required({"scan", 0, Keyboards::kKeys - 1}), required({"state"})};

} // namespace

std::string SimulatedDevices::keyEvent(runtime::Instance& instance, std::span<const NcArgument> given) {
  if (std::string wrong = wrongKeys("KEY", given, kKeys); !wrong.empty()) return wrong;
  const EventKeys keys(given);
  const uint32_t keyboard = *keys.number<uint32_t>("keyboard");
  const std::string number = std::to_string(keyboard);
  if (!keyboards_.exists(keyboard))
    return "keyboard " + number + " has no keys; `config KbdConfig" + number + " FILE` gives it some";
  pressKey(instance, keyboard, *keys.number<uint32_t>("scan"), *keys.number<uint32_t>("state") != 0);
  return {};
}

void SimulatedDevices::pressKey(runtime::Instance& instance, uint32_t keyboard, uint32_t scan, bool pressed) {
  const KeyActions actions = keyboards_.key(keyboard, scan, pressed);
  keyboardPlaces_.write(instance.memory(), keyboards_);
  axes_.key(actions.rtmCommand, pressed);
  if (actions.plcCommand) keyboardPlaces_.runCommand(instance, *actions.plcCommand, pressed);
}

void SimulatedDevices::takeVirtualKeys(runtime::Instance& instance, const ModuleCells& cells) {
  for (const ModuleCells::PointCell& point : cells.points()) {
    if (point.point.kind != ModulePoint::Kind::Key) continue;
    const bool pressed = cells.at(point.cell).bits != 0;
    if (pressed != keyboards_.isPressed(Keyboards::kVirtual, point.point.number))
      pressKey(instance, Keyboards::kVirtual, point.point.number, pressed);
  }
}

} // namespace rung::sim::technol
