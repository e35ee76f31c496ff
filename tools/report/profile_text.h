// Compares a profile with an earlier one that `rungc profile --json` wrote.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"
#include "tools/report/profile_rungs.h"

namespace rung::report {

// A profile that was read back; its rows have only the fields that a comparison needs.
struct Baseline {
  std::string program;
  std::vector<std::string> scenarios;
  uint64_t scans = 0;
  uint64_t operations = 0;
  double time = 0;
  Spread scanOperations;
  double scanMedianNs = 0;
  std::vector<Row> rows; // including those that never ran
};

// The error says what is wrong with the text.
Result<Baseline> readBaseline(std::string_view text);

struct Change {
  Row row; // row of the new profile; of the old one if the rung was removed
  uint64_t oldOperations = 0;
  double oldMeanNs = 0;
};

// Differences of two profiles. Every rung is in at most one list; the largest changes come first.
struct Comparison {
  Baseline old;
  std::vector<Change> more;   // by operations
  std::vector<Change> fewer;  // by operations
  std::vector<Change> slower; // the same operations in considerably more time
  std::vector<Change> faster;
  std::vector<Change> added; // rungs that the old program did not have
  std::vector<Change> gone;
};

// A rung is matched by its key, which holds while its text is unchanged, then by its title in its routine.
Comparison compare(const ProfileReport& now, Baseline old);

// A profile as text for a terminal, and as JSON (docs/profile-format.md).

struct ProfileTextOptions {
  uint32_t top = 20;  // lines per table; 0: all
  bool never = false; // whether rungs that never ran are listed
};

// Numbers of rungs as drawn; a rung that calls has several rows in the report.
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
