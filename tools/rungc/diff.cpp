// rungc diff: what has changed between two versions of a program.
#include <memory>

#include "tools/difference/difference.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

struct DiffOptions {
  std::string before;
  std::string after;
  SourceOptions common; // no files
  std::string format = "text";
};

// One of the two, with the project that it names or belongs to.
std::optional<compiler::Compiled> compileSide(SourceManager& sources, const std::string& name,
                                              const DiffOptions& options, int& status) {
  SourceOptions source = options.common;
  source.files = {name};
  source.quiet = true;
  status = takeProject(source);
  if (status != kOk) return std::nullopt;
  return compileSources(sources, source, {.keepBuilt = true}, status);
}

int run(const DiffOptions& options) {
  SourceManager sources[2];
  int status = kOk;
  const auto before = compileSide(sources[0], options.before, options, status);
  if (!before) return status;
  const auto after = compileSide(sources[1], options.after, options, status);
  if (!after) return status;
  if (before->dialect != after->dialect) return usageError("these are programs of two dialects");
  const difference::Difference found = difference::compare(*before->built, *after->built);
  const auto show = options.format == "json" ? difference::shownAsJson : difference::shownAsText;
  status = writeOutput(show(found, *before->built, *after->built));
  return status != kOk || found.none() ? status : kWrong;
}

} // namespace

void addDiff(CommandLine& app, int& status) {
  Command command = app.add("diff", "Say what rungs, names and messages of two versions of a program do otherwise");
  auto options = std::make_shared<DiffOptions>();
  command.option("OLD", options->before, "A source file, or the folder of a project").required();
  command.option("NEW", options->after, "The same, later; exit status 1: there is a difference").required();
  command.option("--dialect", options->common.dialect, "nct, gsk or technol; needed where the files do not name it");
  command.option("--config", options->common.config, "KEY=VALUE of the dialect's configuration; may be repeated")
      .oneValue();
  command.option("--format", options->format, "Of the difference").oneOf({"text", "json"}).showDefault();
  addColorOption(command, options->common.color, "Colours in diagnostics");
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
