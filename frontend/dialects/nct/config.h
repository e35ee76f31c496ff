// The areas of the memory (man. l.281-307) and the program's configuration of them and of time.
#pragma once
#include <cstdint>

#include "frontend/dialects/dialect.h"

namespace rung::frontend::nct {

inline constexpr uint32_t kWords = 10000;   // addresses 0000 to 9999, l.283
inline constexpr uint32_t kFlagsWord = 0;   // FLAGS, l.723
inline constexpr uint32_t kReserved = 1;    // reads 0, cannot be written
inline constexpr uint32_t kFirstNcWord = 2; // the time-slice memory begins here, l.544

// The limits depend on the control and the manual does not print them (l.293); these are the project's defaults.
struct Config {
  uint32_t plcNvram = 4000;     // first word of the non-volatile user memory
  uint32_t plcRam = 5024;       // first word of the volatile user memory: 1024 words further, l.290
  uint32_t periodUs = 10'000;   // T_PLC, l.536
  uint32_t timesliceUs = 2'000; // l.540
  uint32_t firstOutput = 0;     // first word of the NC's outputs; they follow its inputs
  uint32_t slices() const { return timesliceUs < periodUs ? periodUs / timesliceUs : 1; }
  bool runsAtWholeMs() const { return periodUs % 1000 == 0 && timesliceUs % 1000 == 0; }
};

// Reports invalid values.
Config readConfig(const frontend::CompileOptions& options, Diagnostics& diagnostics);

} // namespace rung::frontend::nct
