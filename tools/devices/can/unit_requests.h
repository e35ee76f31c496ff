// What the control asks of a unit by SDO: sets of rows of the table in unit_requests.cpp, a bit a row.
#pragma once
#include <cstdint>

namespace rung::devices::requests {

inline constexpr uint32_t kShorts = 0b111;         // 2101h:1-3 (man. l.3674-3678)
inline constexpr uint32_t kRegister = 1 << 3;      // 1001h
inline constexpr uint32_t kModes = 0b11 << 4;      // what makes analogue inputs and the matrix work
inline constexpr uint32_t kIdentity = 0b1111 << 6; // 1018h, 1008h, 1009h, 100Ah (man. l.4079-4082)
inline constexpr uint32_t kAtStart = kRegister | kIdentity;

} // namespace rung::devices::requests
