// The order in which pots and pallet places are searched: numbers in a ring, in one direction or both (MR 101, man.
// l.4690; MR 308, man. l.5779).
#pragma once
#include <cstdint>
#include <optional>
#include <utility>

namespace rung::sim::nct {

enum class SearchDirection : uint8_t { Both, Positive, Negative };

constexpr SearchDirection searchDirection(int32_t word) {
  return word == 1 ? SearchDirection::Positive : word == 2 ? SearchDirection::Negative : SearchDirection::Both;
}
// Of a magazine that turns there: 1 or 2.
constexpr int32_t rotationWord(SearchDirection direction) { return direction == SearchDirection::Negative ? 2 : 1; }

// The nearest to `start` of `count` places (from 0, a ring) that `fits`, the start itself first; of two at the same
// distance the one in positive direction. With it the direction to turn to: Positive or Negative.
template <class Fits>
std::optional<std::pair<uint32_t, SearchDirection>> nearestPlace(uint32_t start, uint32_t count,
                                                                 SearchDirection direction, Fits fits) {
  for (uint32_t step = 0; step < count; ++step) {
    const uint32_t up = (start + step) % count;
    const uint32_t down = (start + count - step) % count;
    if (direction != SearchDirection::Negative && fits(up)) return std::pair{up, SearchDirection::Positive};
    if (direction != SearchDirection::Positive && fits(down)) return std::pair{down, SearchDirection::Negative};
  }
  return std::nullopt;
}

} // namespace rung::sim::nct
