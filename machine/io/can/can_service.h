// The CAN channels of this machine beside a program: interfaces by SocketCAN, the control's units and drives, orders of
// packets, and the cells of all that (man. ch. 9, 13.14).
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
  // The channel, 1 or 2, is this interface, which may be switched off, and come and go. "" or why this machine cannot
  // serve it at all.
  std::string open(uint32_t channel, const std::string& interface);
  // The channel is a descriptor that takes and gives a `can_frame` at a time, and becomes the service's.
  void adopt(uint32_t channel, int descriptor);
  void configure() { settings_.configure(control_); }

  // ---- the end of the host, and reports The program is over: units get outputs that are 0, drives are disabled, and
  // the interfaces are left.
  void close();
  // Null: the channel does not exist. Counts and state: any thread.
  const SocketCan* port(uint32_t channel) const { return isOpen_[channel - 1] ? &ports_[channel - 1] : nullptr; }

  // Orders that a replacement of the program has ended, and messages about drives and units; any one thread.
  bool takeEnded(EndedOrder& order) { return calls_.takeEnded(order); }
  bool takeMessage(DriveMessage& message) { return ofDrives_.pop(message); }
  bool takeMessage(UnitMessage& message) { return ofUnits_.pop(message); }

  // ---- the scan; nothing waits, allocates or locks
  // The clock has moved on: what is due of each millisecond.
  void step(int64_t ns) noexcept;
  // At a power-on, before MODULE_INIT.
  void powerOn() noexcept;
  void answer(DeviceCall& call) { calls_.answer(call); }
  // Before MODULE_INPUT: what has come is in the cells, and procedures of orders have run.
  void show(runtime::Instance& instance, const CanPlaces& places) noexcept;
  // At the end of a scan: what the program wants until the next.
  void take(const core::Memory& memory, const CanPlaces& places) noexcept;
  // A program that is stopped has no orders, and its packets are dropped.
  void dropPackets(runtime::Instance& instance, const CanPlaces& places) noexcept;
  // After a fault: drives are disabled.
  void disableDrives() noexcept { driveOrders_ = {}; }
  // Another program has taken over: orders of packets continue with its buffers and procedures.
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
  std::array<uint8_t, kOutputPorts> shownErrors_{}; // in the cells
  DriveStates drives_;
  core::FixedRing<DriveMessage, 64> ofDrives_;
  core::FixedRing<UnitMessage, 256> ofUnits_;
  int64_t restNs_ = 0; // of the millisecond that has begun
};

} // namespace rung::io
