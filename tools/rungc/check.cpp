// rungc check: reports every mistake of a program, and names that look like mistakes.
#include <memory>

#include "ir/layout/program_image.h"
#include "tools/rungc/commands.h"
#include "tools/xref/odd_names.h"

namespace rung::rungc {
namespace {

void checkNames(const compiler::Compiled& compiled, const SourceManager& sources, Diagnostics& diagnostics) {
  const ir::ProgramImage image(*compiled.layout, compiled.codeHash);
  const xref::CrossReference reference(image.program(), *compiled.uses, compiled.dialect->shownSpaces);
  xref::reportOddNames(sources, compiled.source->analysis(), reference, diagnostics);
}

} // namespace

void addCheck(CommandLine& app, int& status) {
  Command command = app.add("check", "Report all mistakes of a program");
  auto options = std::make_shared<SourceOptions>();
  addSourceOptions(command, *options);
  command.onRun([options, &status] {
    SourceManager sources;
    const auto compiled = compileSources(sources, *options, {.keepSource = true}, status, checkNames);
    if (compiled) printSummary(*compiled, *options, "");
  });
}

} // namespace rung::rungc
