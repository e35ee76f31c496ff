// Measures one engine on one program, beside the hand-written form of it, in this process.
#pragma once
#include <cstdint>
#include <string>

#include "ir/support/result.h"

namespace rung::bench {

struct Case {
  std::string engine;           // interp, cpp, llvm or jit
  std::string compiler;         // of engine cpp
  std::string program = "bits"; // "gsk", "technol", "idle", "waiting"
  uint32_t units = 0;           // rungs, steps, lines, mechanisms
  bool optimise = true;
  std::string handWritten; // a shared object with the hand-written form
};

struct Measured {
  double frontMs = 0;   // from source text to the layout
  double backMs = 0;    // from there to the end of the first scan
  double nsPerScan = 0; // median
  double handNsPerScan = 0;
  double ratio = 0;      // median of the ratios of neighbouring samples
  double residentMb = 0; // most that the process ever had
  double codeKb = 0;     // shared object, or object files of the JIT; 0: there is none
  double memoryKb = 0;   // memory block of an instance
};

std::string sourceOf(const Case& which); // of the program
Result<Measured> measure(const Case& which);

// The shared object with the hand-written form, at -O3.
Result<void> buildHandWritten(const Case& which, const std::string& compiler, const std::string& path);

} // namespace rung::bench
