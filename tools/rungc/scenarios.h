// Shared by the commands that run scenarios: selecting and running them, their results, tracing and starting one.
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

// Expands names: files stay in their order; a folder means the scenarios of its project, or every *.scn below it,
// sorted; no name means those of the project of the working directory. Nothing, and `status` says why, if a folder has
// no scenario or a name is that of a program.
std::optional<std::vector<std::string>> scenarioFiles(const std::vector<std::string>& names, int& status);

// The files whose path contains one of the texts; a text with *, ? or [ is a pattern for the whole path or the file's
// name.
std::vector<std::string> filtered(const std::vector<std::string>& files, const std::vector<std::string>& filters);

// Results of scenarios as JUnit XML, which CI servers read.

struct TestCase {
  std::string path;
  double seconds = 0;
  scenario::RunResult result;
};

std::string junitXml(const std::vector<TestCase>& tests);

// Parses "interp,jit" or "all". The error is a text for the user.
Result<std::vector<compiler::EngineKind>> enginesOf(const std::string& names);
// Reads, parses and runs one file.
TestCase runOne(const std::string& path, const scenario::RunOptions& options);
// Prints "ok" or "FAILED" with the path, then the scenario's output and its problems.
void printResult(const TestCase& test, bool color = false);
// "12 ms" or "1.25 s"
std::string shownSeconds(double seconds);

// `rungc run --scenario FILE`: the program that a scenario runs, how it starts it, and its statements.

struct RunScenario {
  std::vector<scenario::Statement> statements; // to execute while the program runs
  std::vector<scenario::Statement> connects;
  int64_t periodUs = 0; // 0: the period of the program
};

// Reads the file. Program, dialect and configuration go into the options, before those of the command line; if the
// options name files, those are the program. Returns the exit status; mistakes are printed.
int readRunScenario(const std::string& path, SourceOptions& options, RunScenario& scenario);

// `rungc test --trace FILE --watch NAME…`: writes the values of names while one scenario runs to a file.

class ScenarioTrace {
public:
  void addTo(cli::Command command);

  bool wanted() const { return !path_.empty(); }
  // Why this number of scenarios cannot be traced; "" if it can.
  std::string problem(size_t scenarios) const;
  // Makes the run begin the trace when the program has started; this object must outlive the run.
  void attach(scenario::RunOptions& run);
  // Whether the trace was refused, known after the run. An unknown name is a usage error.
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
