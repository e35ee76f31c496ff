// Names and operands at a place of the source (see explain_place.h).
#include "tools/rungc/explain_place.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "ir/support/put.h"
#include "rtlib/text/number.h"
#include "tools/rungc/commands.h"
#include "tools/xref/module_reference.h"
#include "tools/xref/place_names.h"

namespace rung::rungc {
namespace {

using frontend::Analysis;
using frontend::Definition;

class Explainer {
public:
  Explainer(const SourceManager& sources, const Analysis& analysis, SourcePos at)
      : sources_(sources), analysis_(analysis), at_(at) {}

  // With a program without errors the names of places and the rungs that use them.
  std::string run(const xref::CrossReference* reference) {
    reference_ = reference;
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
    put(out_, "{}{}\n", definition.name, definition.isConstant() ? fmt::format(": {}", definition.value) : "");
    define(definition);
    if (!definition.isConstant()) uses(definition.place);
  }
  void define(const Definition& definition) {
    if (!definition.comment.empty()) put(out_, "  {}\n", definition.comment);
    if (definition.range.valid()) put(out_, "  declared at {}\n", placeOf(definition.range));
  }
  void uses(const frontend::NamedPlace& place) {
    if (reference_ == nullptr) return;
    const auto bits = xref::rangeOf(reference_->program(), place);
    if (bits) put(out_, "\n{}", xref::shownAsText(*reference_, {reference_->of(xref::refAt(*bits))}, true));
  }
  void targets(const frontend::TargetUse& here) {
    put(out_, "{}: {}\n", sources_.text(here.range), here.defines ? "a place in the program" : "control goes there");
    for (const frontend::TargetUse& use : analysis_.targets())
      if (use.scope == here.scope && use.number == here.number)
        put(out_, "  {} {}\n", use.defines ? "is at  " : "asked at", placeOf(use.range));
  }

  const SourceManager& sources_;
  const Analysis& analysis_;
  const SourcePos at_;
  const xref::CrossReference* reference_ = nullptr;
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

std::string wordAt(const SourceManager& sources, SourcePos at) {
  const std::string_view line = sources.lineText(at);
  size_t begin = sources.offsetOf(at) - sources.lineStart(at).offset;
  size_t end = begin;
  while (begin > 0 && !endsWord(line[begin - 1])) --begin;
  while (end < line.size() && !endsWord(line[end])) ++end;
  return std::string(line.substr(begin, end - begin));
}

std::string explainIn(const SourceManager& sources, const frontend::Dialect& dialect, frontend::CheckedProgram& program,
                      const Diagnostics& diagnostics, SourcePos at) {
  Explainer explainer(sources, program.analysis(), at);
  const auto module = diagnostics.hasErrors() ? nullptr : program.build();
  if (module == nullptr) return explainer.run(nullptr);
  const xref::ModuleReference reference(*module, dialect.shownSpaces);
  return explainer.run(&reference.get());
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

std::optional<Explained> explainPlace(const SourcePlace& place, int& status) {
  SourceOptions options;
  options.files = {place.file};
  status = takeProject(options);
  if (status != kOk) return std::nullopt;
  SourceManager sources;
  frontend::CompileOptions compile;
  const auto files = addSources(sources, options, compile, status);
  if (!files) return std::nullopt;
  Diagnostics diagnostics;
  const frontend::Dialect* dialect = compiler::chooseDialect(sources, *files, "", diagnostics);
  if (dialect == nullptr) {
    printDiagnostics(diagnostics, sources, options);
    status = kWrong;
    return std::nullopt;
  }
  const auto program = dialect->check(sources, *files, compile, diagnostics);
  const auto file = fileOf(sources, place.file);
  const auto at = file ? positionOf(sources, *file, place) : std::nullopt;
  if (!at) {
    status = usageError(fmt::format("{} has nothing in line {}, column {}", place.file, place.line, place.column));
    return std::nullopt;
  }
  return Explained{explainIn(sources, *dialect, *program, diagnostics, *at), wordAt(sources, *at)};
}

} // namespace rung::rungc
