// Measures one engine on one program, beside the hand-written form of it, in this process.
#pragma once
#include <cstdint>
#include <string>

#include "ir/support/result.h"

namespace rung::bench {

struct Case {
  std::string engine;   // interp, cpp, llvm or jit
  std::string compiler; // of engine cpp
  uint32_t rungs = 0;
  bool optimise = true;
  std::string handWritten; // a shared object with the hand-written form
};

struct Measured {
  double firstScanMs = 0; // from source text to the end of the first scan
  double nsPerScan = 0;   // median
  double handNsPerScan = 0;
  double ratio = 0;      // median of the ratios of neighbouring samples
  double residentMb = 0; // most that the process ever had
};

Result<Measured> measure(const Case& which);

// The shared object with the hand-written form, at -O3.
Result<void> buildHandWritten(uint32_t rungs, const std::string& compiler, const std::string& path);

} // namespace rung::bench
