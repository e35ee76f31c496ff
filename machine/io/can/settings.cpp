// Configuration of the CAN channels (see settings.h). Attributes have the names of the control's own configuration.
#include "machine/io/can/settings.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "machine/host/xml_reader.h"
#include "machine/io/device_call.h"
#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/text/letters.h"

namespace rung::io {
namespace {

using host::inQuotes;

constexpr int64_t kSpeeds[] = {100'000, 125'000, 250'000, 500'000, 1'000'000}; // bit/s
constexpr int64_t kServicePeriods[] = {250, 500, 1000};                        // us
constexpr int64_t kMostPhysicalChannel = 15, kMostSyncPeriod = 15;

std::string takes(std::string_view key, const std::string& what) { return inQuotes(key) + " takes " + what; }
std::string upTo(int64_t most) { return "0 to " + std::to_string(most); }

bool isOneOf(std::string_view text, std::span<const int64_t> values) {
  const auto number = nc::technol::integerOf(text);
  return number && std::find(values.begin(), values.end(), *number) != values.end();
}

std::string noAttribute(std::string_view key, uint32_t channel) {
  return "there is no attribute " + inQuotes(key) + "; " +
         (channel == 1 ? "CAN[0] has Active, Drives, SyncPeriod, CanSpeed, ServicePeriod and PhysicalCanChannel"
                       : "CAN[1] has Active, InOut08Cnt, Kla50Cnt, KnobCnt, INOUT08[i].CONTROL, KLA50[i].CONTROL, "
                         "Knob[i].CONTROL, SyncPeriod, CanSpeed, ServicePeriod and PhysicalCanChannel");
}

// Returns "", or a message with the values that the key takes.
template <class Value>
std::string put(Value& to, std::string_view key, std::string_view value, int64_t least, int64_t most,
                const std::string& what) {
  const auto number = numberBetween(value, least, most);
  if (!number) return takes(key, what);
  to = static_cast<Value>(*number);
  return {};
}

} // namespace

std::optional<std::string> CanSettings::set(std::string_view key, std::string_view value) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  if (nc::technol::takePrefix(rest, "DRIVE.")) return setDrive(key, rest, value);
  if (!nc::technol::takePrefix(rest, "CAN[1]")) {
    if (!nc::technol::takePrefix(rest, "CAN")) return std::nullopt;
    if (rest.starts_with('[')) return "channels are CAN[0] and CAN[1], not in " + inQuotes(key);
    if (!rest.starts_with('.')) return std::nullopt;
    return setChannel(key, rest, 1, value);
  }
  if (rest.ends_with(".CONTROL")) return setUnit(key, rest, value);
  return setChannel(key, rest, 2, value);
}

std::optional<std::string> CanSettings::setChannel(std::string_view key, std::string_view rest, uint32_t channel,
                                                   std::string_view value) {
  Channel& own = channels[channel - 1];
  if (rest == ".ACTIVE") return put(own.active, key, value, 0, 1, "0 or 1");
  if (rest == ".SYNCPERIOD") return put(own.syncPeriod, key, value, 1, kMostSyncPeriod, "1 to 15 ms");
  if (rest == ".CANSPEED")
    return isOneOf(value, kSpeeds) ? "" : takes(key, "100000, 125000, 250000, 500000 or 1000000");
  if (rest == ".SERVICEPERIOD") return isOneOf(value, kServicePeriods) ? "" : takes(key, "250, 500 or 1000");
  if (rest == ".PHYSICALCANCHANNEL") {
    own.physical = numberBetween(value, 0, kMostPhysicalChannel);
    return own.physical ? "" : takes(key, upTo(kMostPhysicalChannel));
  }
  if (channel == 1 && rest == ".DRIVES") return put(drives, key, value, 0, kMostDrives, upTo(kMostDrives));
  for (uint32_t group = 0; channel == 2 && rest.starts_with('.') && group < kUnitGroups; ++group)
    if (text::equalsIgnoringCase(rest.substr(1), kUnitGroupNames[group].count))
      return put(units[group], key, value, 0, kMostUnits[group], upTo(kMostUnits[group]));
  return noAttribute(key, channel);
}

// "CAN[1].INOUT08[0].CONTROL"; here units are numbered from 0.
std::optional<std::string> CanSettings::setUnit(std::string_view key, std::string_view rest, std::string_view value) {
  rest.remove_prefix(1);
  for (uint32_t group = 0; group < kUnitGroups; ++group) {
    std::string_view unit = rest;
    if (!text::takePrefixIgnoringCase(unit, kUnitGroupNames[group].unit)) continue;
    const uint32_t number = nc::technol::takeIndex(unit).value_or(0);
    if (unit == ".CONTROL" && number < kMostUnits[group])
      return put(controls[group][number], key, value, 0, 255, "0 to 255");
  }
  return inQuotes(key) + " is not a unit's control byte: CAN[1].INOUT08[0].CONTROL to [31], KLA50[0] to [3], Knob[0] "
                         "and [1]";
}

// "2.TYPE"
std::optional<std::string> CanSettings::setDrive(std::string_view key, std::string_view rest, std::string_view value) {
  const auto number = numberBetween(takeUntil(rest, '.'), 1, kMostDrives);
  if (!number || *number > drives)
    return inQuotes(key) + " is of no drive; there are " + std::to_string(drives) + " (CAN[0].Drives comes first)";
  if (rest != "TYPE") return "there is no attribute " + inQuotes(key) + "; a drive has type and sdo.INDEX.SUBINDEX";
  const bool unidrive = text::equalsIgnoringCase(value, "unidrive");
  if (!unidrive && !text::equalsIgnoringCase(value, "kollmorgen")) return takes(key, "kollmorgen or unidrive");
  driveTypes[*number - 1] = unidrive ? DriveType::Unidrive : DriveType::Kollmorgen;
  return "";
}

bool CanSettings::isActive(uint32_t channel) const {
  if (channels[channel - 1].active) return true;
  return channel == CanController::kDriveChannel ? drives > 0 : std::accumulate(units.begin(), units.end(), 0u) > 0;
}

void CanSettings::configure(CanController& control) const {
  control.drives().setSyncPeriod(channels[CanController::kDriveChannel - 1].syncPeriod);
  control.units().setSyncPeriod(channels[CanController::kUnitChannel - 1].syncPeriod);
  for (uint32_t group = 1; group <= kUnitGroups; ++group) {
    if (control.units().count(group) != units[group - 1]) control.units().configure(group, units[group - 1]);
    for (uint32_t i = 0; i < units[group - 1]; ++i) control.units().setControl(group, i + 1, controls[group - 1][i]);
  }
  control.drives().configure(drives);
  for (uint32_t i = 0; i < drives; ++i) control.drives().setType(i + 1, driveTypes[i]);
}

} // namespace rung::io
