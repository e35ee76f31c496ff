// How many mutations of each seed or example are tried.
#pragma once
#include <algorithm>
#include <cstdlib>

namespace rung::fuzz {

// `usual`, what a normal run of the tests has time for; RUNG_MUTATIONS=N tries N where that is more.
inline long mutationsOfEach(long usual) {
  const char* asked = std::getenv("RUNG_MUTATIONS");
  return asked != nullptr ? std::max(std::atol(asked), usual) : usual;
}

} // namespace rung::fuzz
