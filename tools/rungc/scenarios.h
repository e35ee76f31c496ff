// What the commands that run scenarios share: names of engines, one scenario from file to result, the lines about it.
#pragma once
#include <string>
#include <vector>

#include "tools/rungc/junit.h"
#include "tools/scenario/runner.h"

namespace rung::rungc {

// "interp,jit", "all": fails with a text for the user.
Result<std::vector<compiler::EngineKind>> enginesOf(const std::string& names);
// Reads, parses and runs one file.
TestCase runOne(const std::string& path, const scenario::RunOptions& options);
// "ok" or "FAILED" with the path, then what it printed and what is wrong.
void printResult(const TestCase& test, bool color = false);
// "12 ms" or "1.25 s"
std::string shownSeconds(double seconds);

} // namespace rung::rungc
