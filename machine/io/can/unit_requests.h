// What the control asks of a unit by SDO: sets of requests, a bit each. Of those that wait the lowest comes first.
#pragma once
#include <cstdint>

namespace rung::io::requests {

inline constexpr uint32_t kShorts = 0b111;          // 2101h:1-3 (man. l.3674-3678)
inline constexpr uint32_t kRegister = 1 << 3;       // 1001h
inline constexpr uint32_t kWheelMode = 1 << 4;      // 2110h: the keys of a handwheel work (man. l.4647-4663)
inline constexpr uint32_t kMappingAt = 5;           // the first bit of
inline constexpr uint32_t kMapping = 0xFFFF << 5;   // 1600h:1-8, 1A00h:1-8
inline constexpr uint32_t kAnalogue = 1 << 21;      // 1801h:1: whether TPDO2 is sent
inline constexpr uint32_t kModes = 0b11 << 21;      // that, and 2109h, by which the matrix works
inline constexpr uint32_t kDisplay = 0b1111 << 23;  // of a handwheel
inline constexpr uint32_t kIdentity = 0b1111 << 27; // 1018h, 1008h, 1009h, 100Ah (man. l.4079-4082)

// What a unit needs before it takes part in the exchange of process data.
inline constexpr uint32_t kBeforeStart = kWheelMode | kMapping | kAnalogue;

} // namespace rung::io::requests
