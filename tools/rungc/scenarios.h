// What the commands that run scenarios share: which ones they run, their results, the trace of one, the start of one.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "machine/command-line/command_line.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/trace.h"

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

// "interp,jit", "all": fails with a text for the user.
Result<std::vector<compiler::EngineKind>> enginesOf(const std::string& names);
// Reads, parses and runs one file.
TestCase runOne(const std::string& path, const scenario::RunOptions& options);
// "ok" or "FAILED" with the path, then what it printed and what is wrong.
void printResult(const TestCase& test, bool color = false);
// "12 ms" or "1.25 s"
std::string shownSeconds(double seconds);

// `rungc run --scenario FILE`: which program a scenario runs, how it starts it, and its statements.

struct RunScenario {
  std::vector<scenario::Statement> statements; // for the running program
  std::vector<scenario::Statement> connects;
  int64_t periodUs = 0; // 0: the program's own
};

// Reads the file. Program, dialect and configuration go into the options, before those of the command line; where the
// options name files, those are the program. Gives the exit status; mistakes are printed.
int readRunScenario(const std::string& path, SourceOptions& options, RunScenario& scenario);

// `rungc test --trace FILE --watch NAME…`: the values of names while one scenario runs, in a file.

class ScenarioTrace {
public:
  void addTo(cli::Command command);

  bool wanted() const { return !path_.empty(); }
  // Why it cannot be for so many scenarios; "" when it can.
  std::string problem(size_t scenarios) const;
  // The run begins the trace when the program has started; this object outlives it.
  void attach(scenario::RunOptions& run);
  // After the run. An unknown name is a usage error.
  bool refused() const { return refused_; }
  // "" or why the file could not be written.
  std::string finish();

private:
  std::string begin(scenario::Session& session, const compiler::Compiled& program);

  std::string path_;
  std::vector<std::string> names_;
  std::unique_ptr<scenario::Trace> trace_;
  bool refused_ = false;
};

} // namespace rung::rungc
