// A CAN interface of the machine, by SocketCAN. An internal thread moves frames between the descriptor and two rings;
// the scan thread accesses only the rings and makes no system call.
//
// The descriptor may be any one that reads and writes one `struct can_frame` at a time; tests use a socket pair.
#pragma once
#include <atomic>
#include <string>
#include <thread>

#include "machine/io/can/channel.h"
#include "rtlib/core/handover.h"

struct can_frame; // NOLINT(readability-identifier-naming): of the kernel

namespace rung::io {

class SocketCan final : public CanPort {
public:
  static constexpr uint32_t kToBus = 128, kFromBus = 256;

  // Counts since the start.
  struct Counts {
    uint64_t sent = 0, received = 0;
    uint64_t lost = 0;     // received while the ring to the program was full
    uint64_t full = 0;     // failed attempts to send because the interface's queue was full
    uint64_t errors = 0;   // error frames
    uint64_t timeouts = 0; // error frames that report a transmission time-out or a missing acknowledgement
  };

  SocketCan() = default;
  ~SocketCan() override { close(); }

  // Serves an interface, "can0". It may be down, and disappear and return: it is opened again as often as needed.
  // Returns "", or why this machine cannot serve it at all.
  std::string open(const std::string& interface);
  // Serves a descriptor, and closes it at the end. If the other side closes it, the port stays down.
  void adopt(int descriptor);
  void close();

  BusState state() const override { return state_.load(std::memory_order_acquire); }
  bool transmit(const CanPacket& packet) override;
  bool receive(CanPacket& packet) override { return fromBus_.pop(packet); }

  Counts counts() const;

private:
  void start();
  void run();
  bool reopen();
  void lose();
  bool moveOut();
  bool moveIn();
  void takeIn(const can_frame& frame);
  void takeError(uint32_t classes);

  std::string interface_; // "": an adopted descriptor
  int descriptor_ = -1;   // used only by the thread while it runs
  bool hasPending_ = false;
  struct Order {
    CanPacket packet;
    uint32_t loss = 0; // value of losses_ when the packet was queued
  };
  Order pending_; // taken from the ring, not yet accepted by the interface
  std::thread thread_;

  std::atomic<bool> stop_ = false;
  std::atomic<BusState> state_ = BusState::Inactive;
  std::atomic<uint64_t> sent_ = 0, received_ = 0, full_ = 0, errors_ = 0, timeouts_ = 0;
  std::atomic<uint32_t> losses_ = 0;
  core::FixedRing<Order, kToBus> toBus_;
  core::FixedRing<CanPacket, kFromBus> fromBus_;
};

} // namespace rung::io
