// What a CNC says of itself again and again, for requests that are answered within the scan that asks. Written by the
// thread that serves, read by the scan; each value is one of a moment, all of them may be of different ones.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>

namespace rung::host {

inline constexpr uint32_t kMostAxes = 9;

struct Live {
  std::atomic<bool> served{false}; // somebody answers requests
  std::atomic<bool> known{false};  // and has said what is below
  std::atomic<uint32_t> line{0};   // of the part program that is carried out; 0: none
  std::atomic<uint32_t> axes{0};
  std::array<std::atomic<double>, kMostAxes> machine{}; // positions in machine coordinates
};

} // namespace rung::host
