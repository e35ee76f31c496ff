// SocketCAN (see socket_can.h). Needs only the kernel's headers.
#include "machine/io/can/socket_can.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "rtlib/run/realtime.h"

namespace rung::io {
namespace {

constexpr int kTurnMs = 1; // longest time that a packet waits for the thread, which the scan does not wake
constexpr auto kReopenEvery = std::chrono::milliseconds(200);
constexpr uint32_t kAtOnce = 64; // frames read before others are sent

can_frame frameOf(const CanPacket& packet) {
  can_frame frame{};
  frame.can_id = packet.id | (packet.remote != 0 ? CAN_RTR_FLAG : 0);
  frame.can_dlc = packet.length;
  std::memcpy(frame.data, packet.data, sizeof packet.data);
  return frame;
}

CanPacket packetOf(const can_frame& frame) {
  CanPacket packet{.id = static_cast<uint16_t>(frame.can_id & CAN_SFF_MASK),
                   .remote = static_cast<uint8_t>((frame.can_id & CAN_RTR_FLAG) != 0 ? 1 : 0),
                   .length = frame.can_dlc};
  std::memcpy(packet.data, frame.data, sizeof packet.data);
  return onBus(packet);
}

// Returns -1 with errno if the machine has no CAN, or the interface does not exist or is down.
int openInterface(const std::string& name) {
  const int descriptor = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor < 0) return -1;
  const can_err_mask_t all = CAN_ERR_MASK;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(name.c_str()));
  int error = ENODEV; // index 0 would mean all interfaces
  socklen_t size = sizeof error;
  if (address.can_ifindex != 0 && setsockopt(descriptor, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &all, sizeof all) == 0 &&
      bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size); // ENETDOWN if it is down
  if (error == 0) return descriptor;
  ::close(descriptor);
  errno = error;
  return -1;
}

bool isFull(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == ENOBUFS; }

} // namespace

std::string SocketCan::open(const std::string& interface) {
  close();
  if (interface.empty() || interface.size() >= IFNAMSIZ) return "'" + interface + "' is not the name of an interface";
  const int probe = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  if (probe < 0) return "this system opens no CAN sockets: " + std::string(std::strerror(errno));
  ::close(probe);
  interface_ = interface;
  start();
  return {};
}

void SocketCan::adopt(int descriptor) {
  close();
  interface_.clear();
  descriptor_ = descriptor;
  start();
}

void SocketCan::start() {
  toBus_.drop();
  state_ = descriptor_ >= 0 ? BusState::Active : BusState::Down;
  stop_ = false;
  thread_ = std::thread([this] { run(); });
}

void SocketCan::close() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  hasPending_ = false;
  state_ = BusState::Inactive;
}

// Packets are not kept while the bus is off: an old command to a machine must not be sent when the bus returns.
bool SocketCan::transmit(const CanPacket& packet) {
  const uint32_t loss = losses_.load(std::memory_order_acquire); // before the state: current if that is active
  return state() == BusState::Active && toBus_.push({onBus(packet), loss});
}

SocketCan::Counts SocketCan::counts() const { return {sent_, received_, fromBus_.lost(), full_, errors_, timeouts_}; }

// ---- the thread -----------------------------------------------------------------------------------------------------

void SocketCan::run() {
  runtime::becomeHelper();
  while (!stop_) {
    if (descriptor_ < 0 && !reopen()) continue;
    const bool good = moveIn() && moveOut();
    if (!good) {
      lose();
      continue;
    }
    pollfd entry{.fd = descriptor_, .events = POLLIN, .revents = 0};
    poll(&entry, 1, kTurnMs);
  }
}

// Opens the descriptor; otherwise waits a while, or until the end is requested, and returns false.
bool SocketCan::reopen() {
  if (!interface_.empty()) descriptor_ = openInterface(interface_);
  if (descriptor_ >= 0) {
    state_.store(BusState::Active, std::memory_order_release);
    return true;
  }
  for (auto waited = std::chrono::milliseconds(0); waited < kReopenEvery && !stop_;
       waited += std::chrono::milliseconds(10))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return false;
}

void SocketCan::lose() {
  state_.store(BusState::Down, std::memory_order_release);
  losses_.fetch_add(1, std::memory_order_acq_rel); // packets in the ring, or just being added, are outdated
  ::close(descriptor_);
  descriptor_ = -1;
  hasPending_ = false;
}

// Returns false if the descriptor is no longer usable. If the interface has no room, the packet waits for the next
// turn.
bool SocketCan::moveOut() {
  while (hasPending_ || toBus_.pop(pending_)) {
    hasPending_ = pending_.loss == losses_.load(std::memory_order_relaxed);
    if (!hasPending_) continue;
    const can_frame frame = frameOf(pending_.packet);
    if (send(descriptor_, &frame, sizeof frame, MSG_NOSIGNAL | MSG_DONTWAIT) < 0) {
      if (isFull(errno)) full_.fetch_add(1, std::memory_order_relaxed);
      return isFull(errno) || errno == EINTR;
    }
    hasPending_ = false;
    sent_.fetch_add(1, std::memory_order_relaxed);
  }
  return true;
}

bool SocketCan::moveIn() {
  for (uint32_t i = 0; i < kAtOnce; ++i) {
    can_frame frame{};
    const ssize_t bytes = recv(descriptor_, &frame, sizeof frame, MSG_DONTWAIT);
    if (bytes < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    if (bytes == 0) return false; // the other side of a socket pair is closed
    if (bytes == sizeof frame) takeIn(frame);
  }
  return true;
}

void SocketCan::takeIn(const can_frame& frame) {
  if ((frame.can_id & CAN_ERR_FLAG) != 0) return takeError(frame.can_id);
  if ((frame.can_id & CAN_EFF_FLAG) != 0) return; // programs use 11-bit identifiers
  state_.store(BusState::Active, std::memory_order_release);
  received_.fetch_add(1, std::memory_order_relaxed);
  fromBus_.push(packetOf(frame));
}

void SocketCan::takeError(uint32_t classes) {
  errors_.fetch_add(1, std::memory_order_relaxed);
  if ((classes & (CAN_ERR_TX_TIMEOUT | CAN_ERR_ACK)) != 0) timeouts_.fetch_add(1, std::memory_order_relaxed);
  if ((classes & CAN_ERR_BUSOFF) != 0) {
    state_.store(BusState::BusOff, std::memory_order_release);
    hasPending_ = false;
    for (Order old; toBus_.pop(old);) {
    }
  }
  if ((classes & CAN_ERR_RESTARTED) != 0) state_.store(BusState::Active, std::memory_order_release);
}

} // namespace rung::io
