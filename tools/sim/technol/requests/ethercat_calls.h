// ECAT_*: requests of a program to an EtherCAT master, and the cells of the interface that belong to it (man. ch. 26,
// 13.18).
#pragma once
#include <array>
#include <optional>
#include <string_view>

#include "tools/sim/technol/devices/ethercat.h"
#include "tools/sim/technol/devices/ethercat_servo.h"
#include "tools/sim/technol/requests/device_call.h"

namespace rung::sim::technol {

// Requests that the master has not answered yet.
class EthercatCalls {
public:
  explicit EthercatCalls(devices::ethercat::Master& master) : master_(master) {}

  void clear();
  // `order` is a number that `orderOf` has given.
  void begin(uint32_t order, DeviceCall& call);
  // Nothing: no such service.
  static std::optional<uint32_t> orderOf(std::string_view service);
  // After a tick: answers what is done. True: something was.
  bool finish(host::Instance& instance, AnswerBytes& bytes);

private:
  struct Pending {
    uint32_t ticket = 0; // the program's; 0: none
    devices::ethercat::Master::Ticket asked = 0;
    bool writes = false; // its answer has no data
  };
  Pending pending_[rt::ServiceQueue::kMaxPending];
  devices::ethercat::Master& master_;
};

// Cells of master and drives.
class EthercatPlaces {
public:
  EthercatPlaces() = default; // a program that has nothing
  explicit EthercatPlaces(const rung_program& program);

  void read(const rt::Memory& memory, devices::ethercat::StateBits& bits, EthercatServos::Cells& servos) const;
  void write(const rt::Memory& memory, const devices::ethercat::StateBits& bits,
             const EthercatServos::Cells& servos) const;

private:
  static constexpr uint32_t kBits = 7, kServoFlags = 9, kServoWords = 4;
  std::array<rt::Place, kBits> bits_;
  std::array<std::array<rt::Place, kServoFlags>, EthercatServos::kCount> flags_;
  std::array<std::array<rt::Place, kServoWords>, EthercatServos::kCount> words_;
};

} // namespace rung::sim::technol
