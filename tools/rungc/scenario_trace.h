// `rungc test --trace FILE --watch NAME…`: the values of names while one scenario runs, in a file.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "machine/command-line/command_line.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/trace.h"

namespace rung::rungc {

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
