// Options and steps that all compiling commands share.
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <unistd.h>

#include "ir/support/diag_render.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {

void addSourceOptions(CLI::App& command, SourceOptions& options) {
  command.add_option("FILE", options.files, "Source files in order (.lad, .pmc, .plc); - reads standard input")
      ->required();
  command.add_option("--dialect", options.dialect, "nct, gsk or technol; needed where the file does not tell");
  command.add_option("--config", options.config, "KEY=VALUE of the dialect's configuration; may be repeated")
      ->allow_extra_args(false);
  command.add_flag("--strict", options.strict, "Warnings that the control's own rules call errors are errors");
  command.add_flag("--json", options.json, "Diagnostics as JSON on standard output");
  addColorOption(command, options.color, "Colours in diagnostics");
}

void addColorOption(CLI::App& command, std::string& color, const std::string& what) {
  command.add_option("--color", color, what)->check(CLI::IsMember({"auto", "always", "never"}));
}

bool wantsColor(const std::string& color, int file) {
  return color == "always" || (color == "auto" && isatty(file) != 0);
}

void addLevelOption(CLI::App& command, std::string& level) {
  command.add_option("-O", level, "0: compile fast, 2: run fast")
      ->check(CLI::IsMember({"0", "2"}))
      ->capture_default_str();
}

int environmentError(const std::string& message) {
  fmt::print(stderr, "rungc: {}\n", message);
  return kEnvironment;
}

int writeFile(const std::string& text, const std::string& out) {
  std::ofstream file(out, std::ios::binary);
  file << text << std::flush;
  return file ? kOk : environmentError(fmt::format("cannot write '{}'", out));
}

void printDiagnostics(const Diagnostics& diagnostics, const SourceManager& sources, const SourceOptions& options) {
  if (options.json) {
    std::cout << renderJson(diagnostics, sources) << '\n';
    return;
  }
  RenderOptions render;
  render.color = wantsColor(options.color, STDERR_FILENO);
  std::cerr << renderText(diagnostics, sources, render);
}

std::optional<std::vector<FileId>> addSources(SourceManager& sources, const SourceOptions& options,
                                              frontend::CompileOptions& compile, int& status) {
  compile.strict = options.strict;
  for (const std::string& pair : options.config) {
    const size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      fmt::print(stderr, "rungc: --config takes KEY=VALUE, found '{}'\n", pair);
      status = kUsage;
      return std::nullopt;
    }
    compile.config[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
  Result<std::vector<FileId>> files = driver::addFiles(sources, options.files);
  if (files.ok()) return files.value();
  status = environmentError(files.error());
  return std::nullopt;
}

std::optional<driver::Compiled> compileSources(SourceManager& sources, const SourceOptions& options,
                                               driver::CompileRequest request, int& status) {
  request.dialect = options.dialect;
  const auto files = addSources(sources, options, request.options, status);
  if (!files) return std::nullopt;
  Diagnostics diagnostics;
  std::optional<driver::Compiled> compiled = driver::compile(sources, *files, request, diagnostics);
  printDiagnostics(diagnostics, sources, options);
  status = compiled ? kOk : kWrong;
  return compiled;
}

} // namespace rung::rungc
