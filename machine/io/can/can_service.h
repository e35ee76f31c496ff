// The CAN channels of this machine for a program: SocketCAN interfaces, the control's units and drives, packet
// subscriptions, and their cells (man. ch. 9, 13.14).
#pragma once
#include <array>
#include <string>

#include "machine/io/can/can_requests.h"
#include "machine/io/can/settings.h"
#include "machine/io/can/socket_can.h"

namespace rung::io {

class CanService {
public:
  // ---- before start
  CanSettings& settings() { return settings_; }
  const CanSettings& settings() const { return settings_; }
  // Connects channel 1 or 2 to this interface, which may be down, and disappear and return. Returns "", or why this
  // machine cannot serve it at all.
  std::string open(uint32_t channel, const std::string& interface);
  // Connects the channel to a descriptor that reads and writes one `can_frame` at a time; the service closes it.
  void adopt(uint32_t channel, int descriptor);
  void configure() { settings_.configure(control_); }

  // ---- power-off and reports
  // The program has ended: sets the outputs of units to 0, disables drives, and closes the interfaces.
  void close();
  // Null: the channel does not exist. Counts and state may be read by any thread.
  const SocketCan* port(uint32_t channel) const { return isOpen_[channel - 1] ? &ports_[channel - 1] : nullptr; }

  // Packet subscriptions ended by a replacement of the program, and messages about drives and units; any one thread.
  bool takeEnded(EndedOrder& order) { return calls_.takeEnded(order); }
  bool takeMessage(DriveMessage& message) { return ofDrives_.pop(message); }
  bool takeMessage(UnitMessage& message) { return ofUnits_.pop(message); }

  // ---- scan thread; nothing waits, allocates or locks
  // Advances the clock: does the work of each millisecond that has passed.
  void step(int64_t ns) noexcept;
  // At a power-on, before MODULE_INIT.
  void powerOn() noexcept;
  void answer(DeviceCall& call) { calls_.answer(call); }
  // Before MODULE_INPUT: writes received data to the cells, and runs the procedures of packet subscriptions.
  void show(runtime::Instance& instance, const CanPlaces& places) noexcept;
  // At the end of a scan: reads the program's commands for the time until the next scan.
  void take(const core::Memory& memory, const CanPlaces& places) noexcept;
  // A stopped program has no packet subscriptions, and its packets are dropped.
  void dropPackets(runtime::Instance& instance, const CanPlaces& places) noexcept;
  // After a fault: disables drives.
  void disableDrives() noexcept { driveOrders_ = {}; }
  // Another program has taken over: packet subscriptions continue with its buffers and procedures.
  void relocate(const CanPlaces& former, const CanPlaces& now, const runtime::Relocation& relocation) noexcept {
    calls_.relocate(former, now, relocation);
  }

private:
  void tick() noexcept;
  bool exists() const { return isOpen_[0] || isOpen_[1]; }

  CanSettings settings_;
  std::array<SocketCan, CanController::kChannels> ports_;
  std::array<bool, CanController::kChannels> isOpen_{};
  CanController control_;
  CanCalls calls_{control_};
  UnitOrders unitOrders_;
  DriveOrders driveOrders_;
  UnitStates units_;
  std::array<uint8_t, kOutputPorts> shownErrors_{}; // value last written to the cells
  DriveStates drives_;
  core::FixedRing<DriveMessage, 64> ofDrives_;
  core::FixedRing<UnitMessage, 256> ofUnits_;
  int64_t restNs_ = 0; // elapsed part of the current millisecond
};

} // namespace rung::io
