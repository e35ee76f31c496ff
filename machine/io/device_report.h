// Reports of changes in the devices for the operator, one sentence each. Service thread; the scan never waits for it.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "machine/io/com/tty_line.h"
#include "machine/io/host_devices.h"

namespace rung::io {

class DeviceReport {
public:
  DeviceReport(Devices& devices, const com::TtyThread& tty) : devices_(devices), tty_(tty) {}

  // The changes since the last call. Losses, and repeated messages of a drive or unit, are reported at most once a
  // second.
  std::vector<std::string> next();

private:
  struct Channel {
    BusState state = BusState::Active;
    uint64_t lost = 0, full = 0, timeouts = 0;
    bool isFull = false, isUnheard = false;
  };
  void states(std::vector<std::string>& lines);
  void orders(std::vector<std::string>& lines);
  void messages(std::vector<std::string>& lines, int64_t now);
  void losses(std::vector<std::string>& lines);
  void ports(std::vector<std::string>& lines);

  Devices& devices_;
  const com::TtyThread& tty_;
  template <class Message>
  struct Said {
    Message message;
    int64_t untilNs = 0; // the message is not repeated until then
  };
  using SaidOfUnits = std::array<Said<UnitMessage>, kMostUnits[0]>;
  template <class Message>
  static void say(const Message& message, Said<Message>& said, int64_t now, std::vector<std::string>& lines);
  std::array<Channel, CanController::kChannels> channels_;
  std::array<Said<DriveMessage>, kMostDrives> saidOfDrives_; // the last message of each
  std::array<SaidOfUnits, kUnitGroups> saidOfUnits_;
  std::vector<std::string> portProblems_;
  std::array<uint32_t, com::kMostPorts> portLosses_{};
  int64_t nextLossesNs_ = 0;
  bool areasReported_ = false;
};

} // namespace rung::io
