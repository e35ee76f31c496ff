// Two sequences side by side.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rung::difference {

// Pairs of equal items, ascending on both sides. What begins and ends both sequences is paired, then what is once on
// each side and keeps its order (patience sorting), and so on between these; items are paired wherever a reader would
// see that they are the same, though not always as many as could be. Takes n log n.
std::vector<std::pair<uint32_t, uint32_t>> align(std::span<const uint64_t> before, std::span<const uint64_t> after);

} // namespace rung::difference
