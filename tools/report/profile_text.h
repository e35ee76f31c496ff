// Compares a profile with one that `rungc profile --json` wrote before.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"
#include "tools/report/profile_rungs.h"

namespace rung::report {

// A profile as read back; a row has what a comparison needs.
struct Baseline {
  std::string program;
  std::vector<std::string> scenarios;
  uint64_t scans = 0;
  uint64_t operations = 0;
  double time = 0;
  Spread scanOperations;
  double scanMedianNs = 0;
  std::vector<Row> rows; // those that never ran too
};

// Fails with what is wrong with the text.
Result<Baseline> readBaseline(std::string_view text);

struct Change {
  Row row; // of the new profile; of the old one when the rung is gone
  uint64_t oldOperations = 0;
  double oldMeanNs = 0;
};

// Every rung in one list at most, what changed most first.
struct Comparison {
  Baseline old;
  std::vector<Change> more;   // operations
  std::vector<Change> fewer;  // operations
  std::vector<Change> slower; // the same operations in clearly more time
  std::vector<Change> faster;
  std::vector<Change> added; // rungs that the old program did not have
  std::vector<Change> gone;
};

// A rung is found again by its key, which holds while its text is unchanged, then by its title in its routine.
Comparison compare(const ProfileReport& now, Baseline old);

// A profile as text for a terminal, and as JSON (docs/profile-format.md).

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
