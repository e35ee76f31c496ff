// rungc new: a small complete project.
#include <fmt/format.h>
#include <memory>

#include "rtlib/text/similar.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/new_project.h"

namespace rung::rungc {
namespace {

int makeNew(const std::string& dialect, const std::string& folder) {
  if (frontend::findDialect(dialect) == nullptr)
    return usageError(
        fmt::format("unknown dialect '{}'{}; the dialects are gsk, nct and technol", dialect,
                    text::didYouMean(text::mostSimilar(dialect, frontend::allDialects(), &frontend::Dialect::name))));
  const Result<std::vector<std::string>> written = makeProject(dialect, folder);
  if (!written.ok()) return environmentError(written.error());
  for (const std::string& file : written.value()) fmt::print("{}\n", file);
  fmt::print("try: cd '{}' && rungc test\n", folder);
  return kOk;
}

} // namespace

void addNew(CommandLine& app, int& status) {
  struct Options {
    std::string dialect;
    std::string folder;
  };
  Command command = app.add("new", "Create a small complete project: program, scenario, project file");
  auto options = std::make_shared<Options>();
  command.option("DIALECT", options->dialect, "nct, gsk or technol").required();
  command.option("DIR", options->folder, "The folder to create; its name is the name of the project").required();
  command.onRun([options, &status] { status = makeNew(options->dialect, options->folder); });
}

} // namespace rung::rungc
