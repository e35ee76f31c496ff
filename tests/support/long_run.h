// How much a test does: what every change is held to, or all that `./dev check long` asks for (RUNG_LONG).
#pragma once
#include <cstdint>
#include <cstdlib>

namespace rung::testing {

inline bool longRun() { return std::getenv("RUNG_LONG") != nullptr; }

// Of random programs and the like.
inline uint64_t howMany(uint64_t usually, uint64_t inLongRuns) { return longRun() ? inLongRuns : usually; }

} // namespace rung::testing
