// The checksum of the control's non-volatile arrays (execution code 4, man. 6.19, 6.20). It is cheap, because every
// change recomputes it. Files on disk have their own CRC (rtlib/retain/retain.h).
#pragma once
#include <cstdint>
#include <cstring>
#include <span>

namespace rung::sim::nct {

template <class T>
uint32_t checksum(std::span<const T> values) {
  uint64_t sum = 0xCBF29CE484222325u;
  for (const T& value : values) {
    uint64_t bits = 0;
    static_assert(sizeof value <= sizeof bits);
    std::memcpy(&bits, &value, sizeof value);
    sum = (sum ^ bits) * 0x100000001B3u;
    sum ^= sum >> 29;
  }
  return static_cast<uint32_t>(sum ^ (sum >> 32));
}

} // namespace rung::sim::nct
