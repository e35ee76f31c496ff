// Files to a laid-out program (see compile.h).
#include "compiler/compile.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <iterator>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/ladder/text/list_word.h"
#include "ir/support/check.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/source.h"
#include "ir/support/encoding.h"
#include "ir/support/foreign_file.h"
#include "ir/support/meant.h"
#include "ir/support/pmc_address.h"
#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/verify/verify.h"
#include "rtlib/text/letters.h"

namespace rung::compiler {
namespace {

constexpr std::string_view kElfMagic = "\177ELF";

// An invalid module is an error of the compiler, never of the user's program.
void checkModule(const ir::Module& module, ir::Mode mode) {
  const std::vector<ir::VerifyError> errors = ir::verify(module, mode);
  RUNG_CHECK(errors.empty(), ir::render(module, errors).c_str());
}

void addClaim(ir::Module& module, const LayoutClaim& claim) {
  module.symbols.push_back({.name = claim.symbol,
                            .comment = claim.text,
                            .type = RUNG_TYPE_I64,
                            .flags = RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_READONLY,
                            .value = claim.hash});
}

// `word` must be part of the file's text.
void reportUnknownDialect(const SourceManager& sources, FileId file, std::string_view word, Diagnostics& diagnostics) {
  const auto begin = static_cast<size_t>(word.data() - sources.text(file).data());
  const SourceRange range = sources.range(file, begin, begin + word.size());
  DiagBuilder report = diagnostics.report(diag::UnknownDialect, range);
  report << word;
  // such as nct2xx, GSK25iMc
  for (const frontend::Dialect* dialect : frontend::allDialects())
    if (text::startsWithIgnoringCase(word, dialect->name)) return static_cast<void>(report.meant(range, dialect->name));
  suggest(report, range, text::likeliest(word, frontend::allDialects(), &frontend::Dialect::name));
}

constexpr std::string_view kFanucList = "it is a command list of a FANUC control: name it .mne, or say --dialect fanuc";
constexpr std::string_view kGskList = "it is a command list of a GSK control: name it .pmc, or say --dialect gsk";

// What a line of a command list says about the control; "" for any other line. Addresses of other controls do not begin
// with the letter of an area.
std::string_view listOf(std::span<const frontend::Word> words) {
  if (words.size() < 2 || words[0].quoted) return {};
  if (text::equalsIgnoringCase(words[0].text, "RD") || text::equalsIgnoringCase(words[0].text, "RD.NOT"))
    return kFanucList;
  const bool loads = text::equalsIgnoringCase(words[0].text, "LD") || text::equalsIgnoringCase(words[0].text, "LDI");
  return loads && pmcAddress(words[1].text) ? kGskList : std::string_view();
}

// Of the first line that says it; most begin with comments, or with the number of a network.
std::string_view listOf(const SourceManager& sources, FileId file) {
  frontend::LineReader lines(sources, file);
  frontend::LineWords words;
  for (frontend::SourceLine line; lines.next(line);) {
    splitWords(line, {}, words);
    if (const std::string_view list = listOf(words.words); !list.empty()) return list;
  }
  return {};
}

void reportNoDialect(const SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  DiagBuilder report = diagnostics.report(diag::MissingDialect, sources.range(file, 0, 0));
  frontend::LineReader lines(sources, file);
  frontend::LineWords words;
  for (frontend::SourceLine line; words.words.empty() && lines.next(line);) splitWords(line, {}, words);
  if (isMnemonicFile(sources.text(file)))
    report.note("it is a mnemonic file of a FANUC control: name it .mne, or say --dialect fanuc");
  else if (const std::string_view list = listOf(sources, file); !list.empty())
    report.note(list);
  else if (frontend::ladder::isListLine(words.words))
    report.note(frontend::ladder::kListNote);
  const std::string extension = std::filesystem::path(sources.name(file)).extension().string();
  const std::vector<std::string_view> programs = frontend::programExtensions();
  if (extension.empty() || std::ranges::find(programs, extension) != programs.end()) return;
  report.note(fmt::format("the file is not one of a program by its name; those have the extensions {}",
                          fmt::join(programs, ", ")));
}

bool checkEncodingKey(const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const std::string key(nc::kEncodingKey.key);
  const auto encoding = options.config.find(key);
  if (encoding == options.config.end() || knowsEncoding(encoding->second)) return true;
  diagnostics.report(diag::UnknownEncoding, options.placeOf(key)) << encoding->second;
  return false;
}

} // namespace

const frontend::Dialect* chooseDialect(const SourceManager& sources, std::span<const FileId> files,
                                       const std::string& name, Diagnostics& diagnostics) {
  for (const FileId file : files)
    if (sources.text(file).starts_with(kElfMagic)) {
      diagnostics.report(diag::CompiledProgram, SourceRange{}) << sources.name(file);
      return nullptr;
    }
  const SourceRange start = sources.range(files[0], 0, 0);
  if (!name.empty()) {
    const frontend::Dialect* named = frontend::findDialect(name);
    if (named == nullptr) diagnostics.report(diag::UnknownDialect, start) << name;
    return named;
  }
  const frontend::Dialect* found = frontend::dialectOf(sources, files[0]);
  if (found != nullptr) return found;
  if (const std::string_view unknown = frontend::ladder::peekDialect(sources, files[0]); !unknown.empty())
    reportUnknownDialect(sources, files[0], unknown, diagnostics);
  else if (const std::optional<std::string> foreign = foreignFile(sources.text(files[0])))
    diagnostics.report(diag::ForeignFile, SourceRange{}) << sources.name(files[0]) << *foreign;
  else if (frontend::checkEncoding(sources, files[0], diagnostics))
    reportNoDialect(sources, files[0], diagnostics);
  return nullptr;
}

Result<std::vector<FileId>> addFiles(SourceManager& sources, const std::vector<std::string>& names,
                                     const std::map<std::string, std::string>& config) {
  if (const auto encoding = config.find(std::string(nc::kEncodingKey.key)); encoding != config.end())
    sources.setEncoding(encoding->second);
  std::vector<FileId> files;
  for (const std::string& name : names) {
    if (name == "-") {
      files.push_back(sources.addBytes("<stdin>", std::string(std::istreambuf_iterator<char>(std::cin), {})));
      continue;
    }
    Result<FileId> file = sources.addFile(name);
    if (!file.ok()) return failure(fmt::format("cannot read '{}': {}", name, file.error()));
    files.push_back(file.value());
  }
  return files;
}

std::optional<Compiled> compile(SourceManager& sources, std::span<const FileId> files, const CompileRequest& request,
                                Diagnostics& diagnostics) {
  Compiled out;
  out.files.assign(files.begin(), files.end());
  out.dialect = chooseDialect(sources, files, request.dialect, diagnostics);
  if (out.dialect == nullptr || !checkEncodingKey(request.options, diagnostics)) return std::nullopt;
  out.project = request.name;
  out.options = request.options;
  frontend::CompileOptions options = request.options;
  if (request.marks) options.marks = &out.marks;
  if (request.compare) options.given = &out.given;
  const auto ended = [&](std::string_view stage) {
    if (request.ended) request.ended(stage);
  };
  auto program = out.dialect->check(sources, files, options, diagnostics);
  ended("check");
  if (!diagnostics.hasErrors()) out.module = program->build();
  if (out.module == nullptr || diagnostics.hasErrors()) return std::nullopt;
  if (request.keepSource) out.source = std::move(program);
  for (const LayoutClaim& claim : request.layouts) addClaim(*out.module, claim);
  ir::orderOperations(*out.module, options.marks, options.given);
  ir::readSourcesOfLatches(*out.module);
  out.module->name =
      request.name.empty() ? std::filesystem::path(sources.name(files[0])).stem().string() : request.name;
  ended("lowering");
  checkModule(*out.module, ir::Mode::Built);
  ended("verifier");
  out.uses = std::make_unique<ir::Uses>(*out.module);
  if (request.branches != nullptr) out.branchWeights = ir::setBranchWeights(*out.module, *request.branches);
  if (request.keepBuilt || request.compare) out.built = std::make_unique<ir::Module>(*out.module);
  out.passes.optimise = request.optimise && !request.marks && !request.compare;
  out.passes.instrument = request.instrument;
  ended("uses");
  out.shape = std::make_unique<ir::Module>();
  ir::runPasses(*out.module, out.passes, out.shape.get());
  ended("passes");
  checkModule(*out.module, ir::Mode::Final);
  ended("verifier");
  out.layout = std::make_unique<ir::Layout>(ir::Layout(*out.shape, request.layout).over(*out.module));
  ended("layout");
  out.codeHash = ir::hashOf(*out.module);
  ended("hash");
  out.warnings = diagnostics.warningCount();
  return out;
}

} // namespace rung::compiler
