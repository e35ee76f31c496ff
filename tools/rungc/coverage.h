// Coverage of programs by scenarios: the options of `rungc test`, and the evaluation of the counts.
#pragma once
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "machine/command-line/command_line.h"
#include "tools/report/coverage_collector.h"
#include "tools/scenario/runner.h"

namespace rung::rungc {

struct CoverageOptions {
  bool text = false; // --coverage
  bool all = false;
  std::string json;
  std::string html;
  std::vector<std::string> former; // JSON files of former runs
  double least = 0;                // in percent
  // Whether any of these options was given.
  bool wanted() const { return text || all || !json.empty() || !html.empty() || !former.empty() || least > 0; }
};

void addCoverageOptions(cli::Command command, CoverageOptions& options);

// How a program was compiled, so that it can be drawn from its sources.
struct Origin {
  std::string dialect;
  std::string project; // name of the project; "": none
  frontend::CompileOptions options;
};

// Counts the coverage of scenarios, on the interpreter only.
class CoverageRun {
public:
  // Makes scenarios that run with these options count, on any number of threads. They must end before this object is
  // destroyed.
  void observe(scenario::RunOptions& run);
  // Writes the requested output. Returns the exit status.
  int finish(const CoverageOptions& options) const;

private:
  int writePages(const report::CoverageReport& report, const std::string& path) const;

  report::Collection collection_;
  std::mutex mutex_;                                   // protects origins_
  std::map<std::vector<std::string>, Origin> origins_; // by the program's files
};

} // namespace rung::rungc
