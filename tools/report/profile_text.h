// A profile as text for a terminal, and as JSON (docs/profile-format.md).
#pragma once
#include <string>

#include "tools/report/profile_baseline.h"
#include "tools/report/profiler.h"

namespace rung::report {

struct ProfileTextOptions {
  uint32_t top = 20;  // lines a table; 0: all
  bool never = false; // list the rungs that never ran
};

// Rungs as drawn; one that calls has several rows in the report.
struct DrawnRungs {
  size_t ran = 0;
  size_t all = 0;
};
DrawnRungs drawnRungs(const ProfileReport& report);

std::string profileText(const Profile& profile, const ProfileTextOptions& options);
std::string comparisonText(const Profile& profile, const Comparison& comparison, uint32_t top);
// `comparison` may be null.
std::string profileJson(const Profile& profile, const Comparison* comparison);

// 950 ns, 13.1 us, 8 ms.
std::string durationText(double ns);

} // namespace rung::report
