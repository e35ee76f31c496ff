// rungc check: reports every mistake of a program.
#include "tools/rungc/commands.h"

namespace rung::rungc {

void addCheck(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("check", "Report all mistakes of a program");
  auto options = std::make_shared<SourceOptions>();
  addSourceOptions(*command, *options);
  command->callback([options, &status] {
    SourceManager sources;
    if (const auto compiled = compileSources(sources, *options, {}, status)) printSummary(*compiled, *options, "");
  });
}

} // namespace rung::rungc
