// Diagnostics and their fixes.
#include <utility>

#include <fmt/format.h>

#include "ir/support/diag/structure.h"
#include "tools/lsp/features.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

constexpr Range kBeginning{};

// Where something without a place is shown: at the beginning of the program's own file.
Range shownRange(const SourceManager& sources, SourceRange range, Unit unit) {
  return range.valid() ? rangeOf(sources, range, unit) : kBeginning;
}

// Remarks without a place become part of the message.
json shown(const Diagnostic& diagnostic, const SourceManager& sources, Unit unit) {
  std::string message = messageOf(diagnostic);
  json related = json::array();
  for (const auto* notes : {&diagnostic.labels, &diagnostic.notes})
    for (const DiagNote& note : *notes) {
      if (note.range.valid())
        related.push_back({{"location", locationOf(sources, note.range, unit)}, {"message", note.text}});
      else
        message += "\n" + note.text;
    }
  json value{{"range", toJson(shownRange(sources, diagnostic.range, unit))},
             {"severity", diagnostic.severity == Severity::Error ? 1 : 2},
             {"code", diagInfo(diagnostic.id).code},
             {"source", "rung"},
             {"message", std::move(message)}};
  if (!related.empty()) value["relatedInformation"] = std::move(related);
  if (diagnostic.id == diag::UnusedName) value["tags"] = {1}; // shown pale
  return value;
}

void addAll(std::map<std::string, json>& all, const Diagnostics& diagnostics, const SourceManager& sources,
            const std::string& own, Unit unit) {
  for (uint32_t i = 0; i < sources.fileCount(); ++i) all.emplace(pathOf(sources, FileId{i}), json::array());
  for (const Diagnostic* one : diagnostics.sorted()) {
    const std::string path = one->range.valid() ? pathOf(sources, sources.fileOf(one->range.begin)) : own;
    all.emplace(path, json::array()).first->second.push_back(shown(*one, sources, unit));
  }
}

json actionOf(const Diagnostic& diagnostic, const SourceManager& sources, Unit unit) {
  json changes = json::object();
  std::string written;
  for (const DiagFix& fix : diagnostic.fixes) {
    changes[uriOf(pathOf(sources, sources.fileOf(fix.range.begin)))].push_back(
        {{"range", toJson(rangeOf(sources, fix.range, unit))}, {"newText", fix.replacement}});
    written = fix.replacement;
  }
  const SourceRange first = diagnostic.fixes[0].range;
  const std::string title = written.empty()            ? fmt::format("Remove '{}'", sources.text(first))
                            : first.begin == first.end ? fmt::format("Insert '{}'", written)
                                                       : fmt::format("Write '{}'", written);
  return {{"title", title},
          {"kind", "quickfix"},
          {"isPreferred", true},
          {"diagnostics", {shown(diagnostic, sources, unit)}},
          {"edit", {{"changes", std::move(changes)}}}};
}

} // namespace

std::map<std::string, json> diagnosticsOf(Program& program, Unit unit) {
  std::map<std::string, json> all;
  all.emplace(program.path(), json::array());
  addAll(all, program.projectDiagnostics(), program.projectSources(), program.path(), unit);
  addAll(all, program.diagnostics(), program.sources(), program.path(), unit);
  if (!program.failure().empty())
    all[program.path()].push_back(
        {{"range", toJson(kBeginning)}, {"severity", 1}, {"source", "rung"}, {"message", program.failure()}});
  return all;
}

json codeActions(const Place& begin, SourcePos end) {
  json actions = json::array();
  for (const Diagnostic& one : begin.program.diagnostics().reported())
    if (!one.fixes.empty() && one.range.valid() && one.range.begin <= end && begin.at <= one.range.end)
      actions.push_back(actionOf(one, begin.program.sources(), begin.unit));
  return actions;
}

} // namespace rung::lsp
