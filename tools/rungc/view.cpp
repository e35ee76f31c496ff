// rungc view: draws a program as a page or a picture.
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <span>

#include "compiler/dialect_choice.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/prompt.h"
#include "tools/view/drawn_program.h"
#include "tools/view/html.h"
#include "tools/view/names.h"
#include "tools/view/program.h"
#include "tools/view/svg.h"

namespace rung::rungc {
namespace {

struct ViewOptions {
  SourceOptions source;
  std::string out;
  std::string title;
  std::string date;
  std::string revision;
  std::string link = std::string(view::kSourceLink);
};

// Completes the options from the project.
void fillIn(ViewOptions& options) {
  if (!options.source.project) return;
  if (options.title.empty()) options.title = options.source.project->name;
  if (options.out.empty()) options.out = compiler::productOf(*options.source.project, ".html");
}

bool isPage(const ViewOptions& options) { return options.out.ends_with(".html"); }

view::PageOptions pageOf(const ViewOptions& options) {
  const view::LinkTo links = options.link.empty() ? view::LinkTo() : view::sourceLinks(options.out, options.link);
  return {options.date, options.revision, links};
}

std::string drawn(view::Program program, const ViewOptions& options) {
  if (!options.title.empty()) program.title = options.title;
  return isPage(options) ? view::renderHtml(program, pageOf(options)) : view::renderSvg(program);
}

// The page or picture; nothing if the program has errors.
std::optional<std::string> render(SourceManager& sources, std::span<const FileId> files, const ViewOptions& options,
                                  const frontend::CompileOptions& compile, Diagnostics& diagnostics) {
  const frontend::Dialect* dialect = compiler::chooseDialect(sources, files, options.source.dialect, diagnostics);
  if (dialect == nullptr) return std::nullopt;
  auto program = view::drawnProgram(sources, files, *dialect, compile, diagnostics);
  return program ? std::optional(drawn(std::move(*program), options)) : std::nullopt;
}

int run(ViewOptions options) {
  fillIn(options);
  if (options.out.empty()) return usageError("view needs -o FILE (.html or .svg); only a project has a default name");
  if (!isPage(options) && !options.out.ends_with(".svg")) {
    fmt::print(stderr, "rungc: '{}' cannot be a drawing: its name must end in .html (page) or .svg (picture)\n",
               options.out);
    return kUsage;
  }
  SourceManager sources;
  frontend::CompileOptions compile;
  int status = kOk;
  const auto files = addSources(sources, options.source, compile, status);
  if (!files) return status;
  Diagnostics diagnostics;
  const auto text = [&] {
    const scenario::Working working("drawing");
    return render(sources, *files, options, compile, diagnostics);
  }();
  printDiagnostics(diagnostics, sources, options.source);
  return text ? sayWrote(writeFile(*text, options.out), options.out, options.source) : kWrong;
}

} // namespace

void addView(CommandLine& app, int& status) {
  Command command = app.add("view", "Draw a program, as a page or a picture");
  auto options = std::make_shared<ViewOptions>();
  addSourceOptions(command, options->source);
  command.option("-o,--output", options->out,
                 "The file to write: .html (a page for screen and paper) or .svg (a picture); default in a project: "
                 "NAME.html beside rung.toml");
  command.option("--title", options->title,
                 "Title of the page and of every printed sheet; default: the name of the project");
  command.option("--date", options->date, "Date printed on every sheet");
  command.option("--revision", options->revision, "Revision printed on every sheet");
  command
      .option(
          "--link", options->link,
          "Link for a source line: {file} is relative to the page, {path} absolute, {line} the line; empty: no links")
      .showDefault();
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
