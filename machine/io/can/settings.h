// Configuration of a control's CAN channels: attributes of CANChannel (man. l.3242-3285, l.9210-9240), control bytes of
// units, drives.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "machine/io/can/controller.h"

namespace rung::io {

struct CanSettings {
  struct Channel {
    bool active = false;
    uint32_t syncPeriod = 1;          // ms
    std::optional<uint32_t> physical; // PhysicalCanChannel
  };
  std::array<Channel, CanController::kChannels> channels;
  std::array<uint32_t, kUnitGroups> units{};
  std::array<std::array<uint8_t, 32>, kUnitGroups> controls{}; // by group and board
  uint32_t drives = 0;
  std::array<DriveType, kMostDrives> driveTypes{};

  // Sets a key, "CAN[1].InOut08Cnt", "CAN[1].INOUT08[0].CONTROL", "CAN[0].Drives", "drive.2.type" ...; case does not
  // matter. Returns "", or the error; nothing if the key is not one of CAN.
  std::optional<std::string> set(std::string_view key, std::string_view value);
  // Whether the channel is active, or has units or drives; `channel` is 1 or 2.
  bool isActive(uint32_t channel) const;
  // To be called before the first tick.
  void configure(CanController& control) const;

private:
  std::optional<std::string> setChannel(std::string_view key, std::string_view rest, uint32_t channel,
                                        std::string_view value);
  std::optional<std::string> setUnit(std::string_view key, std::string_view rest, std::string_view value);
  std::optional<std::string> setDrive(std::string_view key, std::string_view rest, std::string_view value);
};

} // namespace rung::io
