// Cells of EtherCAT drives (man. 13.18, 13.19).
#pragma once
#include <array>

#include "rtlib/run/instance.h"
#include "sim/technol/devices/ethercat_servo.h"

namespace rung::sim::technol {

class ServoPlaces {
public:
  ServoPlaces() = default; // a program that has nothing
  explicit ServoPlaces(const rung_program& program);

  void read(const core::Memory& memory, EthercatServos::Cells& servos) const;
  // Of drives that are simulated or connected.
  void write(const core::Memory& memory, const EthercatServos::Cells& servos) const;

private:
  using OfServos = std::array<core::Place, EthercatServos::kCount>;
  static constexpr uint32_t kFlags = 9, kWords = 6;
  std::array<std::array<core::Place, kFlags>, EthercatServos::kCount> flags_;
  std::array<std::array<core::Place, kWords>, EthercatServos::kCount> words_;
  OfServos position_, velocityScale_;
  // Micrometres, micrometres, micrometres, increments (l.10390-10396).
  OfServos followingError_, requested_, measured_, increments_;
};

} // namespace rung::sim::technol
