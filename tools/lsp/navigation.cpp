// From a place to others that are about the same.
#include "tools/lsp/features.h"
#include "tools/lsp/subject.h"

namespace rung::lsp {
namespace {

std::optional<Subject> at(const Place& place) {
  const frontend::Analysis* analysis = place.program.analysis();
  return analysis == nullptr ? std::nullopt : subjectAt(*analysis, place.at);
}

} // namespace

json definition(const Place& place) {
  const auto subject = at(place);
  json found = json::array();
  if (!subject) return found;
  for (const Occurrence& one : occurrencesOf(*place.program.analysis(), *subject))
    if (one.declares) found.push_back(locationOf(place.program.sources(), one.range, place.unit));
  return found;
}

json references(const Place& place, bool withDeclaration) {
  const auto subject = at(place);
  json found = json::array();
  if (!subject) return found;
  for (const Occurrence& one : occurrencesOf(*place.program.analysis(), *subject))
    if (withDeclaration || !one.declares) found.push_back(locationOf(place.program.sources(), one.range, place.unit));
  return found;
}

json highlights(const Place& place) {
  constexpr int kText = 1;
  constexpr int kRead = 2;
  constexpr int kWrite = 3;
  const auto subject = at(place);
  json found = json::array();
  if (!subject) return found;
  const SourceManager& sources = place.program.sources();
  for (const Occurrence& one : occurrencesOf(*place.program.analysis(), *subject))
    if (sources.fileOf(one.range.begin) == place.file)
      found.push_back({{"range", toJson(rangeOf(sources, one.range, place.unit))},
                       {"kind", one.declares ? kText
                                : one.writes ? kWrite
                                             : kRead}});
  return found;
}

} // namespace rung::lsp
