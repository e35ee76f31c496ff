// rungc xref: which rungs read and write which places.
#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "ir/image/program_image.h"
#include "rtlib/nc/names/names.h"
#include "tools/report/odd_names.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

struct XrefOptions {
  SourceOptions source;
  std::vector<std::string> places;
  bool odd = false;
  std::string format = "text";
};

std::optional<std::vector<report::Entry>> placesOf(const report::CrossReference& reference,
                                                   const XrefOptions& options) {
  std::vector<report::Entry> entries;
  for (const std::string& name : options.places) {
    const auto place = nc::resolve(reference.program(), name);
    if (!place || place->kind == runtime::RefKind::Constant) {
      fmt::print(stderr, "rungc: '{}' is not a variable of the program; write a symbol or an address of the dialect\n",
                 name);
      return std::nullopt;
    }
    entries.push_back(reference.of(*place));
  }
  return entries;
}

// Whether the sources declare it or one of their rungs uses it; other entries belong to the control and the compiler.
bool isOfProgram(const rung_program& program, const report::Entry& entry) {
  return entry.declared || std::ranges::any_of(entry.accesses, [&](const report::RungAccess& access) {
           return program.rungs[access.rung].number != 0;
         });
}

int run(const XrefOptions& options) {
  SourceManager sources;
  int status = kOk;
  std::unique_ptr<const frontend::CheckedProgram> text;
  const auto compiled = compileSources(sources, options.source, {.source = &text}, status);
  if (!compiled) return status;
  const ir::ProgramImage image(*compiled->layout, compiled->codeHash);
  const report::CrossReference reference(image.program(), *compiled->uses, compiled->dialect->shownSpaces);
  const bool listed = !options.places.empty();
  auto entries = listed ? placesOf(reference, options) : reference.all();
  if (!entries) return kWrong;
  report::markOdd(sources, text->analysis(), reference, *entries);
  if (options.odd)
    std::erase_if(*entries, [](const report::Entry& entry) { return entry.odd.empty(); });
  else if (!listed)
    std::erase_if(*entries, [&](const report::Entry& entry) { return !isOfProgram(image.program(), entry); });
  const auto show = options.format == "json" ? report::shownAsJson : report::shownAsText;
  return writeOutput(show(reference, *entries, listed));
}

} // namespace

void addXref(CommandLine& app, int& status) {
  Command command = app.add("xref", "List the rungs that read and write each variable");
  auto options = std::make_shared<XrefOptions>();
  addSourceOptions(command, options->source);
  command.option("--place", options->places,
                 "List only this symbol or address, including rungs whose index may reach it; may be repeated");
  command.flag("--odd", options->odd,
               "List only variables that are unused, read but not written, written but not read, or set but not reset");
  command.option("--format", options->format, "Format of the list").oneOf({"text", "json"}).showDefault();
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
