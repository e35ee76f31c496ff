// Which scenarios a command runs: files, folders with all that lies below, and a filter.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/scenario/runner.h"

namespace rung::rungc {

// Files stay in their order; a folder gives the scenarios of the project in it, or every *.scn below it, sorted; no
// name at all those of the project of the working directory. Nothing, and `status` says why, when a folder has none, or
// when a name is that of a program.
std::optional<std::vector<std::string>> scenarioFiles(const std::vector<std::string>& names, int& status);

// Those whose path contains one of the texts; a text with *, ? or [ is a pattern for the whole path or the file's name.
std::vector<std::string> filtered(const std::vector<std::string>& files, const std::vector<std::string>& filters);

// Results of scenarios as JUnit XML, the form that CI servers read.

struct TestCase {
  std::string path;
  double seconds = 0;
  scenario::RunResult result;
};

std::string junitXml(const std::vector<TestCase>& tests);

// What the commands that run scenarios share: names of engines, one scenario from file to result, the lines about it.

// "interp,jit", "all": fails with a text for the user.
Result<std::vector<compiler::EngineKind>> enginesOf(const std::string& names);
// Reads, parses and runs one file.
TestCase runOne(const std::string& path, const scenario::RunOptions& options);
// "ok" or "FAILED" with the path, then what it printed and what is wrong.
void printResult(const TestCase& test, bool color = false);
// "12 ms" or "1.25 s"
std::string shownSeconds(double seconds);

} // namespace rung::rungc
