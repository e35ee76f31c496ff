// The CAN channels of this machine beside a program: interfaces by SocketCAN, the control's units and drives, orders of
// packets, and the cells of all that (man. ch. 9, 13.14).
#pragma once
#include <array>
#include <string>

#include "tools/device-requests/can_requests.h"
#include "tools/devices/can/settings.h"
#include "tools/devices/can/socket_can.h"

namespace rung::host_devices {

class CanService {
public:
  // ---- before start
  devices::CanSettings& settings() { return settings_; }
  const devices::CanSettings& settings() const { return settings_; }
  // The channel, 1 or 2, is this interface, which may be switched off, and come and go. "" or why this machine cannot
  // serve it at all.
  std::string open(uint32_t channel, const std::string& interface);
  // The channel is a descriptor that takes and gives a `can_frame` at a time, and becomes the service's.
  void adopt(uint32_t channel, int descriptor);
  void configure() { settings_.configure(control_); }

  // ---- whoever ends the host, and reports
  // The program is over: units get outputs that are 0, drives are disabled, and the interfaces are left.
  void close();
  // Null: the channel does not exist. Counts and state: any thread.
  const devices::SocketCan* port(uint32_t channel) const {
    return isOpen_[channel - 1] ? &ports_[channel - 1] : nullptr;
  }

  // Orders that a replacement of the program has ended, and messages about drives and units; any one thread.
  bool takeEnded(device_requests::EndedOrder& order) { return calls_.takeEnded(order); }
  bool takeMessage(devices::DriveMessage& message) { return ofDrives_.pop(message); }
  bool takeMessage(devices::UnitMessage& message) { return ofUnits_.pop(message); }

  // ---- the scan; nothing waits, allocates or locks
  // The clock has moved on: what is due of each millisecond.
  void step(int64_t ns) noexcept;
  // At a power-on, before MODULE_INIT.
  void powerOn() noexcept;
  void answer(device_requests::CanOrder order, device_requests::DeviceCall& call) { calls_.answer(order, call); }
  // Before MODULE_INPUT: what has come is in the cells, and procedures of orders have run.
  void show(host::Instance& instance, const device_requests::CanPlaces& places) noexcept;
  // At the end of a pass: what the program wants until the next.
  void take(const rt::Memory& memory, const device_requests::CanPlaces& places) noexcept;
  // A program that is stopped has no orders, and its packets are dropped.
  void dropPackets(host::Instance& instance, const device_requests::CanPlaces& places) noexcept;
  // After a fault: drives are disabled.
  void disableDrives() noexcept { driveOrders_ = {}; }
  // Another program has taken over: orders of packets continue with its buffers and procedures.
  void relocate(const device_requests::CanPlaces& former, const device_requests::CanPlaces& now,
                const host::Relocation& relocation) noexcept {
    calls_.relocate(former, now, relocation);
  }

private:
  void tick() noexcept;
  bool exists() const { return isOpen_[0] || isOpen_[1]; }

  devices::CanSettings settings_;
  std::array<devices::SocketCan, devices::CanController::kChannels> ports_;
  std::array<bool, devices::CanController::kChannels> isOpen_{};
  devices::CanController control_;
  device_requests::CanCalls calls_{control_};
  devices::UnitOrders unitOrders_;
  devices::DriveOrders driveOrders_;
  devices::UnitStates units_;
  std::array<uint8_t, devices::kOutputPorts> shownErrors_{}; // in the cells
  devices::DriveStates drives_;
  rt::FixedRing<devices::DriveMessage, 64> ofDrives_;
  rt::FixedRing<devices::UnitMessage, 256> ofUnits_;
  int64_t restNs_ = 0; // of the millisecond that has begun
};

} // namespace rung::host_devices
