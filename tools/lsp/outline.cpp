// The parts of a text: what is declared in it, the sections of ladder text, and what can be folded.
#include <algorithm>
#include <array>

#include "frontend/syntax/word_lexer.h"
#include "rtlib/text/letters.h"
#include "tools/lsp/features.h"

namespace rung::lsp {
namespace {

// Kinds of symbols of the protocol.
enum class SymbolKind : int { Module = 2, Namespace = 3, Method = 6, Variable = 13, Constant = 14, Event = 24 };

json symbolOf(const std::string& name, const std::string& detail, SymbolKind kind, const Range& whole,
              const Range& word) {
  json symbol{{"name", name.empty() ? "(without a title)" : name},
              {"kind", static_cast<int>(kind)},
              {"range", toJson(whole)},
              {"selectionRange", toJson(word)}};
  if (!detail.empty()) symbol["detail"] = detail;
  return symbol;
}

// A part of ladder text that reaches to the next one of its level or above.
struct Part {
  int level = 0; // 0: module, 1: section, 2: rung
  std::string title;
  uint32_t line = 0; // from 0
  uint32_t end = 0;  // the last line
};

constexpr std::array<std::string_view, 3> kParts{"module", "section", "rung"};

std::string titleOf(const frontend::LineWords& words) {
  return words.words.size() < 2 ? std::string() : std::string(words.words[1].text);
}

std::vector<Part> partsOf(const SourceManager& sources, FileId file) {
  std::vector<Part> parts;
  frontend::LineReader lines(sources, file);
  frontend::SourceLine line;
  frontend::LineWords words;
  uint32_t last = 0;
  for (; lines.next(line); last = line.number - 1) {
    frontend::splitWords(line, {}, words);
    if (words.words.empty()) continue;
    const auto level = std::ranges::find(kParts, words.words[0].text);
    if (level != kParts.end())
      parts.push_back({static_cast<int>(level - kParts.begin()), titleOf(words), line.number - 1, 0});
  }
  for (size_t i = 0; i < parts.size(); ++i) {
    const auto next = std::find_if(parts.begin() + static_cast<std::ptrdiff_t>(i) + 1, parts.end(),
                                   [&](const Part& other) { return other.level <= parts[i].level; });
    parts[i].end = next == parts.end() ? last : std::max(parts[i].line, next->line - 1);
  }
  return parts;
}

} // namespace

bool isLadderText(const Program& program, FileId file) { return program.sources().name(file).ends_with(".lad"); }

namespace {

// The parts from `next` on that are inside the line `end`, with those inside them.
json nested(const std::vector<Part>& parts, size_t& next, uint32_t end, const SourceManager& sources, FileId file,
            Unit unit) {
  constexpr std::array kKinds{SymbolKind::Module, SymbolKind::Namespace, SymbolKind::Event};
  json list = json::array();
  while (next < parts.size() && parts[next].line <= end) {
    const Part& part = parts[next++];
    const uint32_t width = unitsOf(sources.lineText(file, part.line + 1), unit);
    const Range word{{part.line, 0}, {part.line, width}};
    const Range whole{{part.line, 0}, {part.end, unitsOf(sources.lineText(file, part.end + 1), unit)}};
    const auto level = static_cast<size_t>(part.level);
    json symbol = symbolOf(part.title, std::string(kParts[level]), kKinds[level], whole, word);
    if (part.end > part.line)
      if (json children = nested(parts, next, part.end, sources, file, unit); !children.empty())
        symbol["children"] = std::move(children);
    list.push_back(std::move(symbol));
  }
  return list;
}

SymbolKind kindOf(const frontend::Definition& definition) {
  return definition.isConstant() ? SymbolKind::Constant : SymbolKind::Variable;
}

bool contains(std::string_view text, const std::string& lower) {
  return text::lower(text).find(lower) != std::string::npos;
}

} // namespace

json documentSymbols(Program& program, FileId file, Unit unit) {
  const SourceManager& sources = program.sources();
  json list = json::array();
  if (isLadderText(program, file)) {
    const std::vector<Part> parts = partsOf(sources, file);
    size_t next = 0;
    list = nested(parts, next, UINT32_MAX, sources, file, unit);
  }
  const frontend::Analysis* analysis = program.analysis();
  if (analysis == nullptr) return list;
  for (const frontend::Definition& definition : analysis->definitions()) {
    if (!definition.range.valid() || sources.fileOf(definition.range.begin) != file) continue;
    const Range range = rangeOf(sources, definition.range, unit);
    list.push_back(
        symbolOf(std::string(definition.name), std::string(definition.comment), kindOf(definition), range, range));
  }
  for (const frontend::TargetUse& target : analysis->targets()) {
    if (!target.defines || sources.fileOf(target.range.begin) != file) continue;
    const Range range = rangeOf(sources, target.range, unit);
    list.push_back(symbolOf(std::string(sources.text(target.range)), std::string(), SymbolKind::Method, range, range));
  }
  return list;
}

json workspaceSymbols(Program& program, const std::string& query, Unit unit) {
  const std::string lower = text::lower(query);
  const SourceManager& sources = program.sources();
  json list = json::array();
  if (program.analysis() == nullptr) return list;
  for (const frontend::Definition& definition : program.analysis()->definitions()) {
    if (!definition.range.valid() || !(contains(definition.name, lower) || contains(definition.comment, lower)))
      continue;
    list.push_back({{"name", definition.name},
                    {"kind", static_cast<int>(kindOf(definition))},
                    {"containerName", definition.comment},
                    {"location", locationOf(sources, definition.range, unit)}});
  }
  return list;
}

json foldingRanges(Program& program, FileId file, Unit /*unit*/) {
  json list = json::array();
  if (!isLadderText(program, file)) return list;
  for (const Part& part : partsOf(program.sources(), file))
    if (part.end > part.line) list.push_back({{"startLine", part.line}, {"endLine", part.end}});
  return list;
}

} // namespace rung::lsp
