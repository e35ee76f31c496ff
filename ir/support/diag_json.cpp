// Diagnostics as JSON. Separate from the text form because of nlohmann's headers.
#include <nlohmann/json.hpp>

#include "ir/support/diag_render.h"

namespace rung {
namespace {

using nlohmann::json;

json placeOf(SourceRange range, const SourceManager& sources) {
  LineCol begin;
  LineCol end;
  if (range.valid()) {
    begin = sources.lineCol(range.begin);
    end = sources.lineCol(range.end);
  }
  return json{{"file", std::string(begin.file)},
              {"line", begin.line},
              {"column", begin.column},
              {"endLine", end.line},
              {"endColumn", end.column}};
}

json notesOf(const std::vector<DiagNote>& notes, const SourceManager& sources) {
  json list = json::array();
  for (const DiagNote& note : notes) {
    json entry = placeOf(note.range, sources);
    entry["message"] = note.text;
    list.push_back(std::move(entry));
  }
  return list;
}

json fixesOf(const std::vector<DiagFix>& fixes, const SourceManager& sources) {
  json list = json::array();
  for (const DiagFix& fix : fixes) {
    json entry = placeOf(fix.range, sources);
    entry["replacement"] = fix.replacement;
    list.push_back(std::move(entry));
  }
  return list;
}

} // namespace

std::string renderJson(const Diagnostics& diagnostics, const SourceManager& sources) {
  json list = json::array();
  for (const Diagnostic* d : diagnostics.sorted()) {
    json entry = placeOf(d->range, sources);
    entry["code"] = std::string(diagInfo(d->id).code);
    entry["severity"] = d->severity == Severity::Error ? "error" : "warning";
    entry["message"] = messageOf(*d);
    entry["labels"] = notesOf(d->labels, sources);
    entry["notes"] = notesOf(d->notes, sources);
    entry["fixes"] = fixesOf(d->fixes, sources);
    list.push_back(std::move(entry));
  }
  // Messages may quote bytes of a file that is not UTF-8.
  return list.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

} // namespace rung
