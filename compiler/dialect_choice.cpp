// See dialect_choice.h.
#include "compiler/dialect_choice.h"

#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <string_view>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/ladder/text/list_word.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/source.h"
#include "ir/support/foreign_file.h"
#include "ir/support/meant.h"
#include "ir/support/pmc_address.h"
#include "rtlib/text/letters.h"

namespace rung::compiler {
namespace {

constexpr std::string_view kElfMagic = "\177ELF";

// `word` must be part of the file's text.
SourceRange rangeIn(const SourceManager& sources, FileId file, std::string_view word) {
  const auto begin = static_cast<size_t>(word.data() - sources.text(file).data());
  return sources.range(file, begin, begin + word.size());
}

void reportUnknownDialect(const SourceManager& sources, FileId file, std::string_view word, Diagnostics& diagnostics) {
  const SourceRange range = rangeIn(sources, file, word);
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

constexpr std::string_view kMnemonicFile = "a mnemonic file of a FANUC control: name it .mne, or say --dialect fanuc";

// Of a mnemonic file that names another dialect by a line, or by its extension.
void reportMnemonicFile(const SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  const std::string_view named = frontend::ladder::peekDialect(sources, file);
  if (named.empty())
    diagnostics.report(diag::ForeignFile, SourceRange{}) << sources.name(file) << kMnemonicFile;
  else
    diagnostics.report(diag::ForeignFile, rangeIn(sources, file, named))
        << sources.name(file)
        << fmt::format("a mnemonic file of a FANUC control, but its line `dialect {}` names another dialect: remove "
                       "the line, or say --dialect fanuc",
                       named);
}

void reportNoDialect(const SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  DiagBuilder report = diagnostics.report(diag::MissingDialect, sources.range(file, 0, 0));
  frontend::LineReader lines(sources, file);
  frontend::LineWords words;
  for (frontend::SourceLine line; words.words.empty() && lines.next(line);) splitWords(line, {}, words);
  if (isMnemonicFile(sources.text(file)))
    report.note(fmt::format("it is {}", kMnemonicFile));
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
  if (found != nullptr && found != frontend::findDialect("fanuc") && isMnemonicFile(sources.text(files[0]))) {
    reportMnemonicFile(sources, files[0], diagnostics);
    return nullptr;
  }
  if (found != nullptr) return found;
  if (const std::string_view unknown = frontend::ladder::peekDialect(sources, files[0]); !unknown.empty())
    reportUnknownDialect(sources, files[0], unknown, diagnostics);
  else if (const std::optional<std::string> foreign = foreignFile(sources.text(files[0])))
    diagnostics.report(diag::ForeignFile, SourceRange{}) << sources.name(files[0]) << *foreign;
  else if (frontend::checkEncoding(sources, files[0], diagnostics))
    reportNoDialect(sources, files[0], diagnostics);
  return nullptr;
}

} // namespace rung::compiler
