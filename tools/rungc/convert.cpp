// rungc convert: a GSK program in its other source form.
#include <fmt/format.h>
#include <memory>
#include <span>
#include <string_view>

#include "frontend/dialects/gsk/gsk.h"
#include "frontend/dialects/gsk/language.h"
#include "frontend/network/convert/convert.h"
#include "ir/support/diag/source.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/prompt.h"

namespace rung::rungc {
namespace {

struct ConvertOptions {
  SourceOptions source;
  std::string to;
  std::string out;
};

std::optional<std::string> convert(SourceManager& sources, std::span<const FileId> files, const ConvertOptions& options,
                                   const frontend::CompileOptions& compile, Diagnostics& diagnostics) {
  const frontend::Dialect* dialect = compiler::chooseDialect(sources, files, options.source.dialect, diagnostics);
  if (dialect == nullptr) return std::nullopt;
  if (dialect != &frontend::gsk::kGsk) {
    diagnostics.report(diag::NoConversion, sources.range(files[0], 0, 0)) << dialect->title;
    return std::nullopt;
  }
  if (dialect->compile(sources, files, compile, diagnostics) == nullptr) return std::nullopt;
  const auto form = options.to == "list" ? frontend::network::Form::List : frontend::network::Form::Ladder;
  std::optional<std::string> text =
      frontend::network::convertProgram(frontend::gsk::kLanguage, sources, files, form, diagnostics);
  const std::string_view encoding = sources.saidEncoding(files[0]); // the encoding of the result
  if (text && !encoding.empty()) text->insert(0, fmt::format("; encoding: {}\n", encoding));
  return text;
}

// The compiler distinguishes the two forms by their extensions: a list in a .lad file could not be read again.
bool checkExtension(const ConvertOptions& options) {
  const std::string_view wrong = options.to == "list" ? ".lad" : ".pmc";
  if (!options.out.ends_with(wrong)) return true;
  fmt::print(stderr, "rungc: '{}' cannot be a {}: its name must end in {}\n", options.out,
             options.to == "list" ? "command list" : "ladder text", options.to == "list" ? ".pmc" : ".lad");
  return false;
}

int run(const ConvertOptions& options) {
  if (!checkExtension(options)) return kUsage;
  SourceManager sources;
  frontend::CompileOptions compile;
  int status = kOk;
  const auto files = addSources(sources, options.source, compile, status);
  if (!files) return status;
  Diagnostics diagnostics;
  const auto text = [&] {
    const scenario::Working working("converting");
    return convert(sources, *files, options, compile, diagnostics);
  }();
  // With --json the diagnostics go to standard output, where they would corrupt a program that is printed.
  if (!options.source.json || !text || !options.out.empty()) printDiagnostics(diagnostics, sources, options.source);
  if (!text) return kWrong;
  const auto bytes = sources.bytesOf(files->front(), *text);
  if (!bytes) return environmentError("the encoding of the first file lacks characters of the others");
  status = writeOutput(*bytes, options.out);
  const bool toFile = !options.out.empty() && options.out != "-";
  return toFile ? sayWrote(status, options.out, options.source) : status;
}

} // namespace

void addConvert(CommandLine& app, int& status) {
  Command command = app.add("convert", "Convert a GSK program between command list and ladder text");
  auto options = std::make_shared<ConvertOptions>();
  addSourceOptions(command, options->source);
  command.option("--to", options->to, "list: command list (.pmc), ladder: ladder text (.lad)")
      .required()
      .oneOf({"list", "ladder"});
  command.option("-o,--output", options->out, "The file to write; default, or with -: standard output");
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
