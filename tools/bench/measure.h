// Measures one engine on one generated program, and its straight-line form, in this process.
#pragma once
#include <cstdint>
#include <string>

#include "ir/support/result.h"

namespace rung::bench {

struct Case {
  std::string engine{};   // interp, cpp, llvm or jit
  std::string compiler{}; // for engine cpp
  std::string dialect{};
  std::string kind{}; // kind of the program, as generated/work.h names it
  uint32_t size = 0;
  bool optimise = true;
  std::string straight{}; // path of a shared object with the straight-line form
};

struct Measured {
  double frontMs = 0;   // from source text to the layout
  double backMs = 0;    // from there to the end of the first scan
  double nsPerScan = 0; // median of the samples
  double straightNsPerScan = 0;
  double ratio = 0;      // median of the ratios of neighbouring samples
  double residentMb = 0; // peak of the process
  double codeKb = 0;     // of the shared object, or of the object files of the JIT; 0: no code
  double memoryKb = 0;   // memory block of an instance
};

Result<Measured> measure(const Case& which);

// Builds the shared object with the straight-line form, a byte per bit, at -O3.
Result<void> buildStraight(const Case& which, const std::string& compiler, const std::string& path);

} // namespace rung::bench
