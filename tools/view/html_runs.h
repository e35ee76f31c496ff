// What runs say of a program, as parts of a page: the summary on top, a label at a rung. Internal to the pages.
#pragma once
#include <string>
#include <vector>

#include "tools/view/program.h"

namespace rung::view {

// A rung as the summary lists it.
struct RunRow {
  uint32_t number = 0;
  std::string_view title;
  const Run* run = nullptr;
};

struct RunsOnPage {
  const RunSummary* summary = nullptr;
  std::vector<RunRow> rungs;
  bool elements = false; // some of them say what was seen of them
};

// The most that a rung has: colours and bars are relative to it.
double hottest(const std::vector<RunRow>& rungs);
// Classes of a rung, " H3" or " N"; nothing where nothing is known.
std::string classesOf(const Run& run, double hottest);
// What a rung took, with a bar.
void appendRun(std::string& out, const Run& run, double hottest);
// Lines, legend, the rungs that take most and those that never ran. Nothing without a summary.
void appendRuns(std::string& out, const RunsOnPage& runs);

} // namespace rung::view
