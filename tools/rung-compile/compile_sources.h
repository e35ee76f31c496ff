// From packed sources to a program file, in memory.
#pragma once
#include <string>
#include <string_view>

namespace rung::rung_compile {

struct Outcome {
  std::string_view verdict; // tools/sources/limits.h
  std::string report;
  std::string image; // sealed, of a program that is compiled
};

// Opens no file; the linker writes to standard output (see buildLlvmSharedObjectByOutput).
Outcome compileSources(std::string_view packed);

} // namespace rung::rung_compile
