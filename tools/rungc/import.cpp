// rungc import: files of a FANUC control, LADDER-III and the PMC simulator become files of a project.
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "ir/support/encoding.h"
#include "ir/support/foreign_file.h"
#include "ir/support/utf8.h"
#include "rtlib/text/regular_file.h"
#include "tools/imported/imported.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/scenario.h"

namespace rung::rungc {
namespace {

constexpr size_t kMostRemarks = 200;
constexpr int64_t kLongestSamplingUs = 60'000'000;
constexpr int64_t kLongestSettlingUs = 3'600'000'000;
constexpr unsigned kMostTolerance = 1000;

struct ImportOptions {
  std::string file;
  std::string kind; // "": by the contents
  std::string encoding;
  std::string sampling;
  std::string settle;
  unsigned tolerance = 1;
  std::string out;
};

// In the order of ControlFile.
constexpr std::string_view kKinds[] = {"parameters", "symbols", "trace", "signals"};

std::optional<ControlFile> kindNamed(std::string_view name) {
  for (size_t i = 0; i < std::size(kKinds); ++i)
    if (kKinds[i] == name) return static_cast<ControlFile>(i);
  return std::nullopt;
}

int wrong(const std::string& message) {
  fmt::print(stderr, "rungc: {}\n", message);
  return kWrong;
}

// The text in UTF-8; nothing, and a message, if the bytes are not of its encoding.
std::optional<std::string> textOf(const std::string& bytes, const ImportOptions& options, int& status) {
  if (!options.encoding.empty() && !knowsEncoding(options.encoding)) {
    status = usageError(fmt::format("import: unknown encoding '{}'; `iconv --list` lists them", options.encoding));
    return std::nullopt;
  }
  const std::string encoding = options.encoding.empty() ? guessedEncoding(bytes) : options.encoding;
  Decoded text = decoded(bytes, encoding);
  if (text.wrong) {
    status = wrong(fmt::format("'{}' is not {} (byte {})", options.file, encoding, *text.wrong));
    return std::nullopt;
  }
  if (text.text.starts_with(kByteOrderMark)) text.text.erase(0, kByteOrderMark.size());
  return std::move(text.text);
}

// What the file is; nothing, and a message, if it is none that can be imported.
std::optional<ControlFile> kindOf(const std::string& bytes, const std::string& text, const ImportOptions& options,
                                  int& status) {
  const std::optional<ControlFile> found = controlFileOf(text);
  if (!options.kind.empty() && (found || !foreignFile(bytes))) return kindNamed(options.kind);
  if (found) return found;
  const std::optional<std::string> foreign = foreignFile(bytes);
  if (foreign)
    status = wrong(fmt::format("'{}' is {}", options.file, *foreign));
  else if (text.find("%@") != std::string::npos)
    status = wrong(
        fmt::format("'{}' is a file of a program, as it has sections: name it in `files` of rung.toml", options.file));
  else
    status = wrong(fmt::format("'{}' is not recognised; --as says what it is, and docs/importing.md how it must look",
                               options.file));
  return std::nullopt;
}

// The duration of an option, within its limits.
std::optional<int64_t> timeOf(std::string_view option, const std::string& text, int64_t least, int64_t most,
                              int& status) {
  const Result<int64_t> us = scenario::parseDuration(text);
  if (us.ok() && us.value() >= least && us.value() <= most) return us.value();
  status =
      usageError(fmt::format("import: {} '{}': {}", option, text,
                             us.ok() ? fmt::format("expected {} us to {} s", least, most / 1'000'000) : us.error()));
  return std::nullopt;
}

std::optional<imported::Sampling> samplingOf(const ImportOptions& options, int& status) {
  if (options.sampling.empty()) {
    status =
        usageError("import: a trace needs --sampling TIME: the time from one frame to the next, which the file does "
                   "not say. A trace of signal transitions has none, and cannot be imported");
    return std::nullopt;
  }
  const auto us = timeOf("--sampling", options.sampling, 1, kLongestSamplingUs, status);
  const auto settle = options.settle.empty() ? std::optional<int64_t>(0)
                                             : timeOf("--settle", options.settle, 0, kLongestSettlingUs, status);
  if (!us || !settle) return std::nullopt;
  return imported::Sampling{.us = *us, .tolerance = options.tolerance, .settleUs = *settle};
}

std::optional<imported::Imported> madeOf(ControlFile kind, const imported::Source& source, const ImportOptions& options,
                                         int& status) {
  if (kind == ControlFile::Trace) {
    const std::optional<imported::Sampling> sampling = samplingOf(options, status);
    return sampling ? std::optional(imported::scenarioOfTrace(source, *sampling)) : std::nullopt;
  }
  if (!options.sampling.empty() || !options.settle.empty()) {
    status = usageError(fmt::format("import: --sampling and --settle are for a trace; '{}' is none", options.file));
    return std::nullopt;
  }
  switch (kind) {
  case ControlFile::Parameters: return imported::initialValues(source);
  case ControlFile::Symbols: return imported::symbolSection(source);
  default: return imported::scenarioOfSignals(source);
  }
}

void printRemarks(const imported::Imported& made, const imported::Source& source) {
  const size_t shown = std::min(made.remarks.size(), kMostRemarks);
  for (size_t i = 0; i < shown; ++i) fmt::print(stderr, "{}\n", imported::textOf(source, made.remarks[i]));
  if (shown < made.remarks.size()) fmt::print(stderr, "rungc: {} more are not shown\n", made.remarks.size() - shown);
}

int run(const ImportOptions& options) {
  std::string bytes;
  if (const std::string problem = text::readRegular(options.file, text::kMostSource, bytes); !problem.empty())
    return environmentError(fmt::format("cannot read '{}': {}", options.file, problem));
  int status = kOk;
  const std::optional<std::string> text = textOf(bytes, options, status);
  if (!text) return status;
  const std::optional<ControlFile> kind = kindOf(bytes, *text, options, status);
  if (!kind) return status;
  const imported::Source source{.name = options.file, .text = *text};
  const std::optional<imported::Imported> made = madeOf(*kind, source, options, status);
  if (!made) return status;
  printRemarks(*made, source);
  if (!made->isUsable()) return kWrong;
  status = writeOutput(made->text, options.out);
  if (status == kOk && !options.out.empty() && options.out != "-")
    fmt::print("wrote {}{}\n", options.out, *kind == ControlFile::Symbols ? "; name it in `files` of rung.toml" : "");
  return status;
}

} // namespace

void addImport(CommandLine& app, int& status) {
  Command command =
      app.add("import", "Turn a file of a FANUC control (parameters, symbols, a trace) into a file of a project");
  auto options = std::make_shared<ImportOptions>();
  command.option("FILE", options->file, "The file of the control, of LADDER-III or of the PMC simulator").required();
  command.option("--as", options->kind, "What the file is; default: recognised by its contents")
      .oneOf({kKinds, std::end(kKinds)});
  command.option("--encoding", options->encoding,
                 "Encoding of the file, such as shift_jis; default: UTF-16, UTF-8 or Latin-1 by its contents");
  command.option("--sampling", options->sampling, "Trace: the time from one frame to the next, such as 8ms");
  command
      .option("--tolerance", options->tolerance,
              "Trace: an output is expected where so many frames before and after have the same value")
      .between(0U, kMostTolerance)
      .showDefault();
  command.option("--settle", options->settle,
                 "Trace: the time to run with the signals of the first frame before the trace begins; default: none");
  command.option("-o,--output", options->out, "The file to write; default, or with -: standard output");
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
