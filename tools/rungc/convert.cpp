// rungc convert: a program of networks in its other source form.
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <span>
#include <string_view>

#include "compiler/dialect_choice.h"
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
                                   const frontend::Dialect& dialect, const frontend::CompileOptions& compile,
                                   Diagnostics& diagnostics) {
  const size_t before = diagnostics.errorCount();
  const auto program = dialect.check(sources, files, compile, diagnostics);
  const auto networks = program->networks();
  if (!networks) {
    diagnostics.report(diag::NoConversion, sources.range(files[0], 0, 0)) << dialect.title;
    return std::nullopt;
  }
  if (diagnostics.errorCount() != before || program->build() == nullptr) return std::nullopt;
  const auto form = options.to == "list" ? frontend::network::Form::List : frontend::network::Form::Ladder;
  std::optional<std::string> text =
      frontend::network::convertProgram(networks->language, sources, networks->files, form, diagnostics);
  const std::string_view encoding = sources.saidEncoding(files[0]); // the encoding of the result
  if (text && !encoding.empty()) text->insert(0, fmt::format("; encoding: {}\n", encoding));
  return text;
}

// The compiler distinguishes the two forms by their extensions: a list in a .lad file could not be read again.
bool checkExtension(const ConvertOptions& options, const frontend::Dialect& dialect) {
  const bool toList = options.to == "list";
  const auto ends = [&](std::string_view extension) { return options.out.ends_with(extension); };
  if (toList ? !ends(".lad") : std::ranges::none_of(dialect.extensions, ends)) return true;
  fmt::print(stderr, "rungc: '{}' cannot be {}: its name must end in {}\n", options.out,
             toList ? "a command list" : "ladder text",
             toList ? fmt::format("{}", fmt::join(dialect.extensions, " or ")) : ".lad");
  return false;
}

int run(const ConvertOptions& options) {
  SourceManager sources;
  frontend::CompileOptions compile;
  int status = kOk;
  const auto files = addSources(sources, options.source, compile, status);
  if (!files) return status;
  Diagnostics diagnostics;
  const frontend::Dialect* dialect = compiler::chooseDialect(sources, *files, options.source.dialect, diagnostics);
  if (dialect != nullptr && !checkExtension(options, *dialect)) return kUsage;
  const auto text = [&]() -> std::optional<std::string> {
    if (dialect == nullptr) return std::nullopt;
    const scenario::Working working("converting");
    return convert(sources, *files, options, *dialect, compile, diagnostics);
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
  Command command = app.add("convert", "Convert a program between command list and ladder text (GSK, FANUC)");
  auto options = std::make_shared<ConvertOptions>();
  addSourceOptions(command, options->source);
  command.option("--to", options->to, "list: command list (.pmc) or mnemonic file (.mne), ladder: ladder text (.lad)")
      .required()
      .oneOf({"list", "ladder"});
  command.option("-o,--output", options->out, "The file to write; default, or with -: standard output");
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
