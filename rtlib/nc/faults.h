// The faults that stop a program: the text that the compiler puts into the program and a host shows, and its
// explanation.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::nc {

inline constexpr std::string_view kPmcDeadLoop = "dead-loop";
inline constexpr std::string_view kNctTimeout = "PLC timeout";
inline constexpr std::string_view kTechnolDivision = "halt-status 2: integer division by zero or overflow";
inline constexpr std::string_view kTechnolReal = "halt-status 3: real arithmetic";
inline constexpr std::string_view kTechnolRequested = "halt-status 6: requested";
inline constexpr std::string_view kTechnolFastOverrun = "halt-status 10: fast raster overrun";
inline constexpr std::string_view kTechnolProtection = "halt-status 13: protection";
inline constexpr std::string_view kTechnolEdef = "EDEF: one instruction ties more than 64 bits";
inline constexpr std::string_view kTechnolWatchdog = "watchdog: endless loop in "; // followed by the module

struct Fault {
  std::string_view text;
  std::string_view explanation; // its cause, and where to look
};

// By rung_program::dialect; empty for an unknown dialect.
std::span<const Fault> faultsOf(std::string_view dialect);
// The fault with this text; null if it is not a fault of the dialect.
const Fault* findFault(std::string_view dialect, std::string_view text);
// The name by which `rungc explain` finds it: the text up to its colon.
std::string_view shortName(const Fault& fault);

} // namespace rung::nc
