// See channel_file.h.
#include "machine/io/channel_file.h"

#include <algorithm>

#include "machine/io/axes/axis_attributes.h"
#include "machine/io/can/controller.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::io {

using host::DeviceDefinition, host::DeviceKind;

namespace {

std::string_view valueOf(const DeviceDefinition& device, std::string_view name) {
  const auto found = std::ranges::find_if(
      device.attributes, [&](const auto& attribute) { return text::equalsIgnoringCase(attribute.name, name); });
  return found == device.attributes.end() ? std::string_view() : std::string_view(found->value);
}

// Attributes in l.3242-3285; the others concern EDS files and the connection of the channel.
bool isOfChannel(std::string_view name) {
  constexpr std::string_view kNames[] = {"Active",     "CanSpeed",   "ServicePeriod", "PhysicalCanChannel",
                                         "SyncPeriod", "InOut08Cnt", "Kla50Cnt",      "KnobCnt"};
  return std::ranges::any_of(kNames, [&](std::string_view known) { return text::equalsIgnoringCase(name, known); });
}

// The configuration key with the same meaning; "": there is none.
std::string keyOf(const DeviceDefinition& device, std::string_view name) {
  const std::string attribute = "." + std::string(name), index = "[" + std::to_string(device.number) + "]";
  switch (device.kind) {
  case DeviceKind::Axis:
    return AxisAttributes::has(name) ? "axis." + std::to_string(device.number + 1) + attribute : std::string();
  case DeviceKind::CanChannel:
    return device.number < CanController::kChannels && isOfChannel(name) ? "CAN" + index + attribute : std::string();
  case DeviceKind::ComChannel: return "COM" + index + attribute;
  case DeviceKind::Servo: break;
  }
  return {};
}

// Servo types with drives on CAN channel 1 (l.9242-9271): all except software, the machine model and EtherCAT. Drives
// are numbered from 1 without gaps (l.9203), like axes.
std::string configureServo(ConfiguredDevices& target, const DeviceDefinition& servo) {
  constexpr uint32_t kFirstDrive = 3, kLastDrive = 27, kModel = 18, kFirstUnidrive = 7, kLastUnidrive = 9;
  const std::string_view type = valueOf(servo, "ServoType");
  if (type.empty()) return {};
  const auto number = text::wholeIn<uint32_t>(type);
  if (!number) return "ServoType: expected the number of a type, found '" + std::string(type) + "'";
  if (*number < kFirstDrive || *number > kLastDrive || *number == kModel) return {};
  const bool isUnidrive = *number >= kFirstUnidrive && *number <= kLastUnidrive;
  const std::string drives = std::to_string(std::max(target.drives(), servo.number + 1));
  if (std::string wrong = target.set("CAN[0].Drives", drives); !wrong.empty()) return wrong;
  return target.set("drive." + std::to_string(servo.number + 1) + ".type", isUnidrive ? "unidrive" : "kollmorgen");
}

std::string configureDevice(ConfiguredDevices& target, const DeviceDefinition& device) {
  if (device.kind == DeviceKind::Servo) return configureServo(target, device);
  // A channel that is not active has no units (l.3246), whatever its attributes are.
  if (device.kind == DeviceKind::CanChannel && valueOf(device, "Active") != "1") return {};
  for (const DeviceDefinition::Attribute& attribute : device.attributes) {
    const std::string key = keyOf(device, attribute.name);
    if (key.empty()) continue;
    if (std::string wrong = target.set(key, attribute.value); !wrong.empty()) return wrong;
  }
  return {};
}

} // namespace

std::string configureDevices(ConfiguredDevices& target, std::span<const DeviceDefinition> definitions) {
  for (const DeviceDefinition& device : definitions)
    if (const std::string wrong = configureDevice(target, device); !wrong.empty()) return device.place + ": " + wrong;
  return {};
}

} // namespace rung::io
