// Measures one engine on one generated program, beside the straight-line form of it, in this process.
#pragma once
#include <cstdint>
#include <string>

#include "ir/support/result.h"

namespace rung::bench {

struct Case {
  std::string engine{};   // interp, cpp, llvm or jit
  std::string compiler{}; // of engine cpp
  std::string dialect{};
  std::string kind{}; // of program, as generated/work.h names it
  uint32_t size = 0;
  bool optimise = true;
  std::string straight{}; // a shared object with the straight-line form
};

struct Measured {
  double frontMs = 0;   // from source text to the layout
  double backMs = 0;    // from there to the end of the first scan
  double nsPerScan = 0; // median
  double straightNsPerScan = 0;
  double ratio = 0;      // median of the ratios of neighbouring samples
  double residentMb = 0; // most that the process ever had
  double codeKb = 0;     // shared object, or object files of the JIT; 0: there is none
  double memoryKb = 0;   // memory block of an instance
};

Result<Measured> measure(const Case& which);

// The shared object with the straight-line form, a byte a bit, at -O3.
Result<void> buildStraight(const Case& which, const std::string& compiler, const std::string& path);

} // namespace rung::bench
