// Keys of the CAN devices (see can_devices.h). Attributes have the names of the control's own configuration
// (man. l.3242-3285, l.9210-9240).
#include <algorithm>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/control/technol/values.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "tools/sim/technol/devices/can_devices.h"

namespace rung::sim::technol {
namespace {

using namespace devices;

constexpr std::string_view kGroupNames[kUnitGroups] = {"INOUT08", "KLA50", "KNOB"}; // of keys, in capitals
constexpr std::string_view kCountNames[kUnitGroups] = {".INOUT08CNT", ".KLA50CNT", ".KNOBCNT"};
constexpr int64_t kSpeeds[] = {100'000, 125'000, 250'000, 500'000, 1'000'000}; // bit/s
constexpr int64_t kServicePeriods[] = {250, 500, 1000};                        // us
constexpr int64_t kMostPhysicalChannel = 15, kMostSyncPeriod = 15;

std::string inQuotes(std::string_view text) { return "'" + std::string(text) + "'"; }
std::string takes(std::string_view key, const std::string& what) { return inQuotes(key) + " takes " + what; }

// Nothing where it is not a number within these limits.
std::optional<uint32_t> numberIn(std::string_view text, int64_t least, int64_t most) {
  const auto number = nc::technol::integerOf(text);
  return number && *number >= least && *number <= most ? std::optional(static_cast<uint32_t>(*number)) : std::nullopt;
}

bool isOneOf(std::string_view text, std::span<const int64_t> values) {
  const auto number = nc::technol::integerOf(text);
  return number && std::find(values.begin(), values.end(), *number) != values.end();
}

// The text up to the character, which both go away from `text`; all of it where the character is not there.
std::string_view takeUntil(std::string_view& text, char end) {
  const size_t at = std::min(text.find(end), text.size());
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return part;
}

} // namespace

std::optional<std::string> CanDevices::configure(std::string_view key, std::string_view value) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  if (nc::technol::takePrefix(rest, "DRIVE.")) return configureDrive(key, rest, value);
  if (!nc::technol::takePrefix(rest, "CAN[1]")) {
    if (!nc::technol::takePrefix(rest, "CAN")) return std::nullopt;
    if (rest.starts_with('[')) return "channels are CAN[0] and CAN[1], not in " + inQuotes(key);
    if (!rest.starts_with('.')) return std::nullopt;
    return configureChannel(key, rest, 1, value);
  }
  if (rest.ends_with(".CONTROL")) return configureUnit(key, rest, value);
  return configureChannel(key, rest, 2, value);
}

std::optional<std::string> CanDevices::configureChannel(std::string_view key, std::string_view rest, uint32_t channel,
                                                        std::string_view value) {
  SimulatedCanBus& bus = buses_[channel - 1];
  if (rest == ".ACTIVE") {
    const auto active = numberIn(value, 0, 1);
    if (!active) return takes(key, "0 or 1");
    bus.setActive(*active == 1 || !bus.units().empty() || !bus.drives().empty());
    return "";
  }
  if (rest == ".SYNCPERIOD") {
    const auto period = numberIn(value, 1, kMostSyncPeriod);
    if (!period) return takes(key, "1 to 15 ms");
    channel == 1 ? control_.drives().setSyncPeriod(*period) : control_.units().setSyncPeriod(*period);
    return "";
  }
  if (rest == ".CANSPEED")
    return isOneOf(value, kSpeeds) ? "" : takes(key, "100000, 125000, 250000, 500000 or 1000000");
  if (rest == ".SERVICEPERIOD") return isOneOf(value, kServicePeriods) ? "" : takes(key, "250, 500 or 1000");
  if (rest == ".PHYSICALCANCHANNEL")
    return numberIn(value, 0, kMostPhysicalChannel) ? "" : takes(key, "0 to " + std::to_string(kMostPhysicalChannel));
  if (channel == 1 && rest == ".DRIVES") {
    const auto count = numberIn(value, 0, kMostDrives);
    if (!count) return takes(key, "0 to " + std::to_string(kMostDrives));
    setDrives(*count);
    return "";
  }
  for (uint32_t group = 1; channel == 2 && group <= kUnitGroups; ++group) {
    if (rest != kCountNames[group - 1]) continue;
    const auto count = numberIn(value, 0, kMostUnits[group - 1]);
    if (!count) return takes(key, "0 to " + std::to_string(kMostUnits[group - 1]));
    setUnits(group, *count);
    return "";
  }
  return "there is no attribute " + inQuotes(key) + "; " +
         (channel == 1 ? "CAN[0] has Active, Drives, SyncPeriod, CanSpeed, ServicePeriod and PhysicalCanChannel"
                       : "CAN[1] has Active, InOut08Cnt, Kla50Cnt, KnobCnt, INOUT08[i].CONTROL, KLA50[i].CONTROL, "
                         "Knob[i].CONTROL, SyncPeriod, CanSpeed, ServicePeriod and PhysicalCanChannel");
}

// "CAN[1].INOUT08[0].CONTROL": units count from 0 here.
std::optional<std::string> CanDevices::configureUnit(std::string_view key, std::string_view rest,
                                                     std::string_view value) {
  rest.remove_prefix(1);
  for (uint32_t group = 1; group <= kUnitGroups; ++group) {
    std::string_view unit = rest;
    if (!nc::technol::takePrefix(unit, kGroupNames[group - 1])) continue;
    const uint32_t number = nc::technol::takeIndex(unit).value_or(0);
    if (unit != ".CONTROL" || number >= kMostUnits[group - 1]) break;
    const auto control = numberIn(value, 0, 255);
    if (!control) return takes(key, "0 to 255");
    controls_[group - 1][number] = static_cast<uint8_t>(*control);
    control_.units().setControl(group, number + 1, static_cast<uint8_t>(*control));
    return "";
  }
  return inQuotes(key) + " is not a unit's control byte: CAN[1].INOUT08[0].CONTROL to [31], KLA50[0] to [3], Knob[0] "
                         "and [1]";
}

void CanDevices::setUnits(uint32_t group, uint32_t count) {
  std::vector<SimulatedUnit>& units = buses_[1].units();
  std::erase_if(units, [&](const SimulatedUnit& unit) { return unit.group() == group; });
  for (uint32_t board = 1; board <= count; ++board) units.emplace_back(group, board);
  control_.units().configure(group, count);
  for (uint32_t i = 0; i < count; ++i) control_.units().setControl(group, i + 1, controls_[group - 1][i]);
  if (count > 0) buses_[1].setActive(true);
}

// ---- drives ---------------------------------------------------------------------------------------------------------

void CanDevices::setDrives(uint32_t count) {
  std::vector<SimulatedDrive>& drives = buses_[0].drives();
  while (drives.size() > count) drives.pop_back();
  while (drives.size() < count) drives.emplace_back(static_cast<uint32_t>(drives.size() + 1));
  control_.drives().configure(count);
  if (count > 0) buses_[0].setActive(true);
}

// "2.TYPE", "2.SDO.0X2003.1"
std::optional<std::string> CanDevices::configureDrive(std::string_view key, std::string_view rest,
                                                      std::string_view value) {
  const auto number = numberIn(takeUntil(rest, '.'), 1, kMostDrives);
  SimulatedDrive* const drive = number ? findDrive(*number) : nullptr;
  if (drive == nullptr)
    return inQuotes(key) + " is of no drive; there are " + std::to_string(drives()) + " (CAN[0].Drives comes first)";
  if (nc::technol::takePrefix(rest, "SDO.")) return configureObject(key, rest, *number, value);
  if (rest != "TYPE") return "there is no attribute " + inQuotes(key) + "; a drive has type and sdo.INDEX.SUBINDEX";
  const bool unidrive = text::equalsIgnoringCase(value, "unidrive");
  if (!unidrive && !text::equalsIgnoringCase(value, "kollmorgen")) return takes(key, "kollmorgen or unidrive");
  const DriveType type = unidrive ? DriveType::Unidrive : DriveType::Kollmorgen;
  drive->setType(type);
  control_.drives().setType(*number, type);
  return "";
}

// The value is VALUE/BYTES, and `ro` or `wo` after it.
std::optional<std::string> CanDevices::configureObject(std::string_view key, std::string_view rest, uint32_t drive,
                                                       std::string_view value) {
  const auto index = numberIn(text::lower(takeUntil(rest, '.')), 0, 0xFFFF);
  const auto subindex = numberIn(text::lower(rest), 0, 0xFF);
  if (!index || !subindex) return inQuotes(key) + " does not name an object; expected sdo.0x2003.1";
  std::string_view left = text::trimmed(value);
  const std::string_view number = takeUntil(left, '/');
  const auto bytes = numberIn(takeUntil(left, ' '), 1, 4);
  const std::string_view access = text::trimmed(left);
  const bool isAccess = access.empty() || access == "ro" || access == "wo";
  const int64_t end = bytes ? int64_t{1} << 8 * *bytes : 0;
  const auto content = bytes && *bytes != 3 && isAccess ? nc::technol::integerOf(number) : std::nullopt;
  if (!content || *content >= end || *content < -end / 2)
    return takes(key, "VALUE/BYTES with 1, 2 or 4 bytes, and 'ro' or 'wo' after it");
  findDrive(drive)->addObject({{static_cast<uint16_t>(*index), static_cast<uint8_t>(*subindex)},
                               *bytes,
                               static_cast<uint32_t>(*content) & static_cast<uint32_t>(end - 1),
                               access == "ro"   ? ObjectAccess::ReadOnly
                               : access == "wo" ? ObjectAccess::WriteOnly
                                                : ObjectAccess::ReadWrite});
  return "";
}

} // namespace rung::sim::technol
