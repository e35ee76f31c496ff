// Names and operands at a place of the source (see explain_place.h).
#include "tools/rungc/explain_place.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "frontend/syntax/word_lexer.h"
#include "ir/support/put.h"
#include "rtlib/host/program_info.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "tools/compiler/manual_lines.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/plain_text.h"
#include "tools/xref/module_reference.h"
#include "tools/xref/odd_names.h"
#include "tools/xref/place_names.h"

namespace rung::rungc {
namespace {

using frontend::Analysis;
using frontend::Definition;

std::string typeText(const rung_symbol& symbol) {
  const host::Ref place = host::refOf(symbol);
  const bool isText = place.kind == host::RefKind::Text;
  const std::string cell = isText                              ? fmt::format("text of {} bytes", place.count)
                           : place.kind == host::RefKind::Real ? "real number"
                           : place.kind == host::RefKind::Bit  ? "bit"
                                                               : fmt::format("integer of {} bits", place.width);
  return isText || place.count <= 1 ? cell : fmt::format("{} times {}", place.count, cell);
}

class Explainer {
public:
  // `reference`: of a program without errors; it has the names of places and the rungs that use them. Else null.
  Explainer(const SourceManager& sources, const Analysis& analysis, const xref::CrossReference* reference)
      : sources_(sources), analysis_(analysis), reference_(reference) {}

  std::string at(SourcePos at) {
    at_ = at;
    if (const auto* operand = found(analysis_.operands())) {
      put(out_, "{}: {} here{}\n", sources_.text(operand->range), nameOf(operand->access),
          operand->computed.empty() ? "" : fmt::format(", with '{}' added at run time", operand->computed));
      if (operand->base != frontend::kNoDefinition) define(analysis_.definitions()[operand->base]);
      uses(operand->place);
    } else if (const auto* target = found(analysis_.targets())) {
      targets(*target);
    } else if (const auto* name = found(analysis_.names())) {
      explain(analysis_.definitions()[name->definition]);
    } else if (const auto* declared = found(analysis_.definitions())) {
      explain(*declared);
    }
    return std::move(out_);
  }

  // Of a name that the program declares or uses.
  std::string named(const Definition& definition) {
    explain(definition);
    return std::move(out_);
  }

private:
  template <class Use>
  const Use* found(std::span<const Use> uses) const {
    const auto here = [&](const Use& use) {
      return use.range.valid() && use.range.begin <= at_ && at_ < use.range.end;
    };
    const auto use = std::ranges::find_if(uses, here);
    return use == uses.end() ? nullptr : &*use;
  }
  std::string placeOf(SourceRange range) const {
    const LineCol at = sources_.lineCol(range.begin);
    return fmt::format("{}:{}:{}", at.file, at.line, at.column);
  }

  void explain(const Definition& definition) {
    put(out_, "{}: {}\n", definition.name, definition.isConstant() ? definition.value : typeOf(definition));
    define(definition);
    if (!definition.isConstant()) uses(definition.place);
  }
  std::string typeOf(const Definition& definition) const {
    if (reference_ != nullptr)
      if (const rung_symbol* symbol = host::findSymbol(reference_->program(), definition.name))
        return typeText(*symbol);
    if (definition.place.bits == 0) return "a name";
    return definition.place.bits == 1 ? "bit" : fmt::format("{} bits", definition.place.bits);
  }
  void define(const Definition& definition) {
    if (!definition.comment.empty()) put(out_, "  {}\n", compiler::withoutManualLines(definition.comment));
    if (definition.range.valid()) put(out_, "  declared at {}\n", placeOf(definition.range));
  }
  void uses(const frontend::NamedPlace& place) {
    if (reference_ == nullptr) return;
    const auto bits = xref::rangeOf(reference_->program(), place);
    if (!bits) return;
    std::vector<xref::Entry> entries{reference_->of(xref::refAt(*bits))};
    xref::markOdd(sources_, analysis_, *reference_, entries);
    put(out_, "\n{}", xref::shownAsText(*reference_, entries, true));
  }
  void targets(const frontend::TargetUse& here) {
    put(out_, "{}: {}\n", sources_.text(here.range), here.defines ? "a label or subprogram" : "control goes there");
    for (const frontend::TargetUse& use : analysis_.targets())
      if (use.scope == here.scope && use.number == here.number)
        put(out_, "  {} {}\n", use.defines ? "is at  " : "asked at", placeOf(use.range));
  }

  const SourceManager& sources_;
  const Analysis& analysis_;
  const xref::CrossReference* reference_;
  SourcePos at_;
  std::string out_;
};

// The file as the program names it.
std::optional<FileId> fileOf(const SourceManager& sources, const std::string& path) {
  for (uint32_t i = 0; i < sources.fileCount(); ++i) {
    std::error_code none;
    if (std::filesystem::equivalent(std::string(sources.name(FileId{i})), path, none)) return FileId{i};
  }
  return std::nullopt;
}

// Columns are characters, offsets bytes.
std::optional<SourcePos> positionOf(const SourceManager& sources, FileId file, const SourcePlace& place) {
  if (place.line == 0 || place.line > sources.lineCount(file)) return std::nullopt;
  const std::string_view line = sources.lineText(file, place.line);
  const auto begin = static_cast<size_t>(line.data() - sources.text(file).data());
  for (size_t at = 0; at < line.size(); ++at) {
    const SourcePos position = sources.position(file, begin + at);
    if (sources.lineCol(position).column == place.column) return position;
  }
  return std::nullopt;
}

bool endsWord(char c) { return std::string_view(" \t[](){}|;,\"'").find(c) != std::string_view::npos; }

// Of a line, at one of its characters.
std::string_view wordAt(std::string_view line, size_t at) {
  size_t begin = at;
  size_t end = at;
  while (begin > 0 && !endsWord(line[begin - 1])) --begin;
  while (end < line.size() && !endsWord(line[end])) ++end;
  return line.substr(begin, end - begin);
}

// A title, a text, a comment; "" for anything else.
std::string_view proseAt(const SourceManager& sources, SourcePos at) {
  const SourceLine line{sources.lineCol(at).line,
                        sources.lineText(at),
                        {at.value - static_cast<uint32_t>(sources.offsetOf(at) - sources.lineStart(at).offset)}};
  LineWords words;
  splitWords(line, {.comment = ';', .quotes = "\"'", .separators = {}}, words);
  const auto isIn = [&](SourceRange range) { return range.begin <= at && at < range.end; };
  if (words.hasComment && isIn(words.commentRange)) return "a comment";
  for (const Word& word : words.words) {
    if (!word.quoted || !isIn(word.range)) continue;
    const std::string_view first = words.words.front().text;
    if (first == "rung") return "the title of a rung";
    return first == "section" ? "the title of a section" : "a text";
  }
  return {};
}

std::string explainWordAt(const SourceManager& sources, const frontend::Dialect& dialect, SourcePos at) {
  if (const std::string_view prose = proseAt(sources, at); !prose.empty()) return fmt::format("{}\n", prose);
  const std::string_view line = sources.lineText(at);
  const size_t offset = sources.offsetOf(at) - sources.lineStart(at).offset;
  const char c = line[offset];
  if (c == ' ' || c == '\t') return "a blank\n";
  if (c != '|' && endsWord(c)) return fmt::format("'{}': nothing by itself; name the place of what is beside it\n", c);
  const std::string word(wordAt(line, offset));
  if (c == '|' || word.find_first_not_of("+-") == std::string::npos) return "a wire\n";
  if (const auto text = compiler::explain(word, &dialect)) return plainText(*text);
  return fmt::format("'{}': neither a name of the program nor an instruction or a signal of {}\n", word, dialect.name);
}

} // namespace

std::optional<SourcePlace> sourcePlace(const std::string& word) {
  const size_t last = word.rfind(':');
  const size_t first = last == std::string::npos ? last : word.rfind(':', last - 1);
  if (first == std::string::npos || first == 0) return std::nullopt;
  const auto line = text::numberIn<uint32_t>(std::string_view(word).substr(first + 1, last - first - 1));
  const auto column = text::numberIn<uint32_t>(std::string_view(word).substr(last + 1));
  std::error_code none;
  if (!line || !column || !std::filesystem::is_regular_file(word.substr(0, first), none)) return std::nullopt;
  return SourcePlace{word.substr(0, first), *line, *column};
}

namespace {

// A program as far as it can be understood.
class OpenProgram {
public:
  // `options` have what takeProject puts there. False, and `status` says why, where it cannot be had.
  bool open(const SourceOptions& options, int& status) {
    const auto files = addSources(sources_, options, compile_, status);
    if (!files) return false;
    dialect_ = compiler::chooseDialect(sources_, *files, options.dialect, diagnostics_);
    if (dialect_ == nullptr) {
      printDiagnostics(diagnostics_, sources_, options);
      status = kWrong;
      return false;
    }
    program_ = dialect_->check(sources_, *files, compile_, diagnostics_);
    if (!diagnostics_.hasErrors()) module_ = program_->build();
    if (module_ != nullptr) reference_.emplace(*module_, dialect_->shownSpaces);
    return true;
  }
  const SourceManager& sources() const { return sources_; }
  const frontend::Dialect& dialect() const { return *dialect_; }
  const Analysis& analysis() const { return program_->analysis(); }
  Explainer explainer() const { return Explainer(sources_, analysis(), reference_ ? &reference_->get() : nullptr); }

private:
  SourceManager sources_;
  Diagnostics diagnostics_;
  frontend::CompileOptions compile_;
  const frontend::Dialect* dialect_ = nullptr;
  std::unique_ptr<frontend::CheckedProgram> program_;
  std::unique_ptr<ir::Module> module_;
  std::optional<xref::ModuleReference> reference_;
};

} // namespace

std::optional<std::string> explainPlace(const SourcePlace& place, int& status) {
  SourceOptions options;
  options.files = {place.file};
  status = takeProject(options);
  OpenProgram program;
  if (status != kOk || !program.open(options, status)) return std::nullopt;
  const SourceManager& sources = program.sources();
  const auto file = fileOf(sources, place.file);
  const auto at = file ? positionOf(sources, *file, place) : std::nullopt;
  if (!at) {
    status = usageError(fmt::format("{} has nothing in line {}, column {}", place.file, place.line, place.column));
    return std::nullopt;
  }
  const std::string text = program.explainer().at(*at);
  return text.empty() ? explainWordAt(sources, program.dialect(), *at) : text;
}

std::optional<ProjectNames> namesOfProject(const std::string& word, const std::string& projectFile) {
  if (projectFile.empty() && !project::findUpwards("")) return std::nullopt;
  SourceOptions options;
  options.projectFile = projectFile;
  int status = takeProject(options);
  OpenProgram program;
  if (status != kOk || !program.open(options, status)) return std::nullopt;
  ProjectNames names;
  const Definition* found = nullptr;
  for (const Definition& definition : program.analysis().definitions()) {
    if (definition.range.valid())
      names.entries.push_back({std::string(definition.name), fmt::format("name in {}", options.project->file),
                               compiler::withoutManualLines(definition.comment), ""});
    const bool exact = definition.name == word;
    if (exact || (found == nullptr && text::equalsIgnoringCase(definition.name, word))) found = &definition;
    if (exact) break;
  }
  if (found != nullptr) names.text = program.explainer().named(*found);
  return names;
}

} // namespace rung::rungc
