// Devices as the control's own file of the channel describes them (see simulated_devices.h). Its elements have the
// attributes that keys of the configuration have; others belong to parts of the control that are not simulated.
#include <algorithm>
#include <iterator>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "tools/sim/technol/requests/simulated_devices.h"

namespace rung::sim::technol {

using control_files::DeviceDefinition;
using control_files::DeviceKind;

namespace {

std::string_view valueOf(const DeviceDefinition& device, std::string_view name) {
  const auto found = std::ranges::find_if(
      device.attributes, [&](const auto& attribute) { return text::equalsIgnoringCase(attribute.name, name); });
  return found == device.attributes.end() ? std::string_view() : std::string_view(found->value);
}

// l.3242-3285; the others are about EDS files and how the channel is reached.
bool isOfChannel(std::string_view name) {
  constexpr std::string_view kNames[] = {"Active",     "CanSpeed",   "ServicePeriod", "PhysicalCanChannel",
                                         "SyncPeriod", "InOut08Cnt", "Kla50Cnt",      "KnobCnt"};
  return std::ranges::any_of(kNames, [&](std::string_view known) { return text::equalsIgnoringCase(name, known); });
}

// The key of the configuration that says the same; "": none does.
std::string keyOf(const DeviceDefinition& device, std::string_view name) {
  constexpr uint32_t kCanChannels = devices::CanController::kChannels;
  const std::string attribute = "." + std::string(name), index = "[" + std::to_string(device.number) + "]";
  switch (device.kind) {
  case DeviceKind::Axis:
    return AxisAttributes::has(name) ? "axis." + std::to_string(device.number + 1) + attribute : std::string();
  case DeviceKind::CanChannel:
    return device.number < kCanChannels && isOfChannel(name) ? "CAN" + index + attribute : std::string();
  case DeviceKind::ComChannel: return "COM" + index + attribute;
  case DeviceKind::Servo: break;
  }
  return {};
}

} // namespace

std::string SimulatedDevices::define(std::span<const DeviceDefinition> devices) {
  for (const DeviceDefinition& device : devices)
    if (const std::string wrong = define(device); !wrong.empty()) return device.place + ": " + wrong;
  return {};
}

std::string SimulatedDevices::define(const DeviceDefinition& device) {
  if (device.kind == DeviceKind::Servo) return defineServo(device);
  // A channel that is not active has no units (l.3246), whatever is said of them.
  if (device.kind == DeviceKind::CanChannel && valueOf(device, "Active") != "1") return {};
  for (const DeviceDefinition::Attribute& attribute : device.attributes) {
    const std::string key = keyOf(device, attribute.name);
    if (key.empty()) continue;
    if (const auto wrong = configure(key, attribute.value, {}); wrong && !wrong->empty()) return *wrong;
  }
  return {};
}

// Types of servos whose drives are on CAN channel 1 (l.9242-9271): all but software, the model of a machine and
// EtherCAT. Drives are numbered from 1 up without gaps (l.9203), as axes are.
std::string SimulatedDevices::defineServo(const DeviceDefinition& servo) {
  constexpr uint32_t kFirstDrive = 3, kLastDrive = 27, kModel = 18, kFirstUnidrive = 7, kLastUnidrive = 9;
  const std::string_view type = valueOf(servo, "ServoType");
  if (type.empty()) return {};
  const auto number = text::numberIn<uint32_t>(type);
  if (!number) return "ServoType: expected the number of a type, found '" + std::string(type) + "'";
  if (*number < kFirstDrive || *number > kLastDrive || *number == kModel) return {};
  const std::string drives = std::to_string(std::max(can_.drives(), servo.number + 1));
  const bool isUnidrive = *number >= kFirstUnidrive && *number <= kLastUnidrive;
  const std::string key = "drive." + std::to_string(servo.number + 1) + ".type";
  if (const auto wrong = configure("CAN[0].Drives", drives, {}); wrong && !wrong->empty()) return *wrong;
  return configure(key, isUnidrive ? "unidrive" : "kollmorgen", {}).value_or("");
}

} // namespace rung::sim::technol
