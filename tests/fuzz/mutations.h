// How many mutations of each seed or example are tried.
#pragma once
#include <cstdlib>

namespace rung::fuzz {

// `usual`, what a normal run of the tests has time for; RUNG_MUTATIONS=N tries N.
inline long mutationsOfEach(long usual) {
  const char* asked = std::getenv("RUNG_MUTATIONS");
  return asked != nullptr ? std::atol(asked) : usual;
}

} // namespace rung::fuzz
