// The result of a compilation, for the host.
#pragma once
#include <exception>
#include <fmt/format.h>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "ir/support/check.h"
#include "machine/compile/sources.h"

namespace rung::rung_compile {

struct Outcome {
  std::string_view verdict; // constants of machine/compile/sources.h
  std::string report;
  std::string image; // the sealed program file, if compiled
};

inline Outcome failed(std::string why) {
  return {.verdict = compile::kVerdictFailed, .report = std::move(why), .image = {}};
}

// Calls `compile`, which returns an outcome and may throw.
template <class Compile>
Outcome outcomeOf(Compile compile) try {
  const ThrowingChecks throwing;
  return compile();
} catch (const std::bad_alloc&) {
  return failed(fmt::format("the program needs more than {} MB to be compiled", compile::kMostMemory >> 20));
} catch (const std::exception& error) { // a failure of the compiler itself
  return failed(error.what());
}

} // namespace rung::rung_compile
