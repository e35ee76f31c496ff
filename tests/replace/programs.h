// Four NCT programs of 12,000 steps that replace each other. They share what they keep and count, by name; what else
// they do is drawn at random. A step is a contact, a coil or a box.
#pragma once
#include <cstdint>
#include <string>

namespace rung::test {

enum class Variant : uint8_t {
  First,
  OtherLogic, // other rungs, the same cells at the same addresses
  Moved,      // retained, counting and timing cells have other addresses
  Array,      // further timers, and an array with a computed index, by which the memory is laid out otherwise
};
inline constexpr const char* kNames[] = {"first", "other-logic", "moved", "array"}; // by Variant
inline constexpr uint32_t kPrograms = 4;

inline constexpr uint32_t kSteps = 12'000;
inline constexpr uint32_t kPeriodUs = 5'000; // of MAIN, in five time slices

// What all programs have. The cells: SCANS, KEEP0…, LATCH0…, COUNT0…, RING0…, TIME0…, TICKS0….
inline constexpr uint32_t kKept = 128;    // words that the program never writes
inline constexpr uint32_t kLatches = 100; // bits of the same kind
inline constexpr uint32_t kCounters = 64; // COUNT: of every second scan
inline constexpr uint32_t kRings = 64;    // RING i: the same, from 0 to ringEnd(i)
inline constexpr uint32_t kTimers = 64; // TIME i: an on-delay that starts itself again; TICKS i: how often it was over
constexpr uint32_t ringEnd(uint32_t i) { return 3 + 5 * i; }
constexpr uint32_t timerMs(uint32_t i) { return 7 + 13 * i; }

std::string ladderOf(Variant variant);

} // namespace rung::test
