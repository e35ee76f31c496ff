// Cells of EtherCAT drives (man. 13.18).
#pragma once
#include <array>

#include "rtlib/host/instance.h"
#include "tools/sim/technol/devices/ethercat_servo.h"

namespace rung::sim::technol {

class ServoPlaces {
public:
  ServoPlaces() = default; // a program that has nothing
  explicit ServoPlaces(const rung_program& program);

  void read(const rt::Memory& memory, EthercatServos::Cells& servos) const;
  // Of drives that are simulated or connected.
  void write(const rt::Memory& memory, const EthercatServos::Cells& servos) const;

private:
  static constexpr uint32_t kFlags = 9, kWords = 4;
  std::array<std::array<rt::Place, kFlags>, EthercatServos::kCount> flags_;
  std::array<std::array<rt::Place, kWords>, EthercatServos::kCount> words_;
};

} // namespace rung::sim::technol
