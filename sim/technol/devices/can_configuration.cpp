// Keys of the CAN devices (see can_devices.h): those of the control's channels, and objects of the simulated drives.
#include "machine/host/xml_reader.h"
#include "machine/io/key_text.h"
#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "sim/technol/devices/can_devices.h"

namespace rung::sim::technol {

using namespace io;

namespace {

using host::inQuotes;

// "DRIVE.2.SDO.0X2003.1": the drive's number, and what follows SDO is left of the name.
std::optional<uint32_t> takeDriveOfObject(std::string_view& name) {
  if (!nc::technol::takePrefix(name, "DRIVE.")) return std::nullopt;
  const auto drive = numberBetween(takeUntil(name, '.'), 0, UINT32_MAX);
  return nc::technol::takePrefix(name, "SDO.") ? drive : std::nullopt;
}

} // namespace

std::optional<std::string> CanDevices::configure(std::string_view key, std::string_view value) {
  if (const Problem object = configureObject(key, value)) return object;
  const Problem wrong = settings_.set(key, value);
  if (wrong && wrong->empty()) follow(settings_);
  return wrong;
}

void CanDevices::follow(const CanSettings& settings) {
  settings.configure(control_);
  SimulatedCanBus& ofUnits = buses_[CanController::kUnitChannel - 1];
  for (uint32_t group = 1; group <= kUnitGroups; ++group) ofUnits.setUnits(group, settings.units[group - 1]);
  setDrives(settings.drives);
  for (uint32_t i = 0; i < settings.drives; ++i) findDrive(i + 1)->setType(settings.driveTypes[i]);
  for (SimulatedCanBus& bus : buses_) bus.setActive(settings.isActive(bus.number()));
}

void CanDevices::setDrives(uint32_t count) {
  std::vector<SimulatedDrive>& drives = buses_[CanController::kDriveChannel - 1].drives();
  while (drives.size() > count) drives.pop_back();
  while (drives.size() < count) drives.emplace_back(static_cast<uint32_t>(drives.size() + 1));
}

// The value is VALUE/BYTES, and `ro` or `wo` after it.
std::optional<std::string> CanDevices::configureObject(std::string_view key, std::string_view value) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  const auto of = takeDriveOfObject(rest);
  if (!of) return std::nullopt;
  SimulatedDrive* const drive = findDrive(*of);
  if (drive == nullptr)
    return inQuotes(key) + " is of no drive; there are " + std::to_string(drives()) + " (CAN[0].Drives comes first)";
  const auto index = numberBetween(text::lower(takeUntil(rest, '.')), 0, 0xFFFF);
  const auto subindex = numberBetween(text::lower(rest), 0, 0xFF);
  if (!index || !subindex) return inQuotes(key) + " does not name an object; expected sdo.0x2003.1";
  std::string_view left = text::trimmed(value);
  const std::string_view number = takeUntil(left, '/');
  const auto bytes = numberBetween(takeUntil(left, ' '), 1, 4);
  const std::string_view access = text::trimmed(left);
  const bool isAccess = access.empty() || access == "ro" || access == "wo";
  const int64_t end = bytes ? int64_t{1} << 8 * *bytes : 0;
  const auto content = bytes && *bytes != 3 && isAccess ? nc::technol::integerOf(number) : std::nullopt;
  if (!content || *content >= end || *content < -end / 2)
    return inQuotes(key) + " takes VALUE/BYTES with 1, 2 or 4 bytes, and 'ro' or 'wo' after it";
  drive->addObject({{static_cast<uint16_t>(*index), static_cast<uint8_t>(*subindex)},
                    *bytes,
                    static_cast<uint32_t>(*content) & static_cast<uint32_t>(end - 1),
                    access == "ro"   ? ObjectAccess::ReadOnly
                    : access == "wo" ? ObjectAccess::WriteOnly
                                     : ObjectAccess::ReadWrite});
  return "";
}

} // namespace rung::sim::technol
