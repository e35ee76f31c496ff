// Coverage of programs by scenarios: the options of `rungc test`, and what becomes of the counts.
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
  std::vector<std::string> former; // JSON of former runs
  double least = 0;                // percent
  // Whether any of them was given.
  bool wanted() const { return text || all || !json.empty() || !html.empty() || !former.empty() || least > 0; }
};

void addCoverageOptions(cli::Command command, CoverageOptions& options);

// How a program was compiled: it is drawn from its sources.
struct Origin {
  std::string dialect;
  std::string project; // its name; empty: none
  frontend::CompileOptions options;
};

// Counts what scenarios run, on the interpreter alone.
class CoverageRun {
public:
  // Scenarios that run with these options are counted; they may do so on several threads. They end before this does.
  void observe(scenario::RunOptions& run);
  // Writes what was asked for. Gives the exit status.
  int finish(const CoverageOptions& options) const;

private:
  int writePages(const report::CoverageReport& report, const std::string& path) const;

  report::Collection collection_;
  std::mutex mutex_;                                   // of the origins
  std::map<std::vector<std::string>, Origin> origins_; // by files
};

} // namespace rung::rungc
