// See can_service.h.
#include "machine/io/can/can_service.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace rung::io {

namespace {

constexpr int64_t kTickNs = 1'000'000;
constexpr int64_t kMostTicks = 20; // in one step; later ones are skipped

} // namespace

std::string CanService::open(uint32_t channel, const std::string& interface) {
  const std::string wrong = ports_[channel - 1].open(interface);
  isOpen_[channel - 1] = wrong.empty();
  if (wrong.empty()) control_.connect(channel, ports_[channel - 1]);
  return wrong;
}

void CanService::adopt(uint32_t channel, int descriptor) {
  ports_[channel - 1].adopt(descriptor);
  isOpen_[channel - 1] = true;
  control_.connect(channel, ports_[channel - 1]);
}

// Transmits the last outputs, and gives the threads of the ports, which take packets within a millisecond, time for
// them.
void CanService::close() {
  constexpr int kLastTicks = 16; // SyncPeriod is at most 15
  if (!exists()) return;
  unitOrders_ = {};
  driveOrders_ = {};
  for (int i = 0; i < kLastTicks; ++i) tick();
  std::this_thread::sleep_for(std::chrono::milliseconds(kLastTicks));
  for (SocketCan& port : ports_) port.close();
}

void CanService::tick() noexcept {
  control_.transmit(unitOrders_, units_, driveOrders_, drives_);
  control_.receive();
  for (DriveMessage message; control_.takeMessage(message);) ofDrives_.push(message);
  for (UnitMessage message; control_.takeMessage(message);) ofUnits_.push(message);
}

void CanService::step(int64_t ns) noexcept {
  if (!exists()) return;
  restNs_ += std::clamp<int64_t>(ns, 0, kMostTicks * kTickNs);
  for (; restNs_ >= kTickNs; restNs_ -= kTickNs) tick();
}

void CanService::powerOn() noexcept {
  control_.power();
  calls_.clear();
  unitOrders_ = {};
  driveOrders_ = {};
  units_ = {};
  shownErrors_ = {};
  drives_ = {};
}

// The program resets bits of ERRLI_PnOUT, while units set them (man. l.3526-3531): only bits that the program has reset
// are cleared.
void CanService::take(const core::Memory& memory, const CanPlaces& places) noexcept {
  if (!exists()) return;
  std::array<uint8_t, kOutputPorts> seen{};
  places.read(memory, unitOrders_, driveOrders_, seen);
  for (uint32_t i = 0; i < seen.size(); ++i) units_.errors[i] &= static_cast<uint8_t>(~(shownErrors_[i] & ~seen[i]));
  shownErrors_ = seen;
}

void CanService::show(runtime::Instance& instance, const CanPlaces& places) noexcept {
  if (!exists()) return;
  const core::Memory memory = instance.memory();
  places.write(memory, units_, drives_, control_);
  shownErrors_ = units_.errors;
  calls_.showDrive(memory, places);
  calls_.deliver(instance, places);
}

void CanService::dropPackets(runtime::Instance& instance, const CanPlaces& places) noexcept {
  calls_.deliver(instance, places);
}

} // namespace rung::io
