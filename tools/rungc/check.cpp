// rungc check: reports every mistake of a program, and what looks like one.
#include <memory>

#include "tools/rungc/commands.h"

namespace rung::rungc {

void addCheck(CommandLine& app, int& status) {
  Command command = app.add("check", "Report all mistakes in a program");
  auto options = std::make_shared<SourceOptions>();
  addSourceOptions(command, *options);
  command.onRun([options, &status] {
    SourceManager sources;
    const auto compiled = compileChecked(sources, *options, {}, status);
    if (compiled) printSummary(*compiled, *options, "");
  });
}

} // namespace rung::rungc
