// Renames a name everywhere, if the program stays what it is.
#include <map>

#include <fmt/format.h>

#include "frontend/ladder/text/rewrite.h"
#include "tools/lsp/features.h"
#include "tools/lsp/subject.h"
#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

const frontend::Definition& renamed(const Place& place) {
  const frontend::Analysis* analysis = place.program.analysis();
  const auto subject = analysis == nullptr ? std::nullopt : subjectAt(*analysis, place.at);
  if (!subject || subject->definition == nullptr)
    throw RequestError(ErrorCode::RequestFailed,
                       "this is not a name: addresses, instructions and labels cannot be renamed");
  if (!subject->definition->range.valid())
    throw RequestError(ErrorCode::RequestFailed, fmt::format("{} is a name of the control", subject->definition->name));
  return *subject->definition;
}

using frontend::ladder::Change;

// Of one file, in the order of its text.
std::vector<Change> changesOf(const Program& program, FileId file, const std::vector<Occurrence>& places,
                              const std::string& name) {
  const SourceManager& sources = program.sources();
  std::vector<Change> words;
  for (const Occurrence& one : places)
    if (sources.fileOf(one.range.begin) == file) words.push_back({one.range, name});
  if (words.empty() || !isLadderText(program, file)) return words;
  return frontend::ladder::withDrawings(sources, file, program.dialect()->findBox, std::move(words));
}

std::string applied(const SourceManager& sources, FileId file, const std::vector<Change>& changes) {
  std::string text;
  size_t from = 0;
  for (const Change& change : changes) {
    const size_t begin = sources.offsetOf(change.range.begin);
    text += sources.text(file).substr(from, begin - from);
    text += change.text;
    from = sources.offsetOf(change.range.end);
  }
  return text += sources.text(file).substr(from);
}

std::string firstError(const Program& program) {
  for (const Diagnostic* one : program.diagnostics().sorted())
    if (one->severity == Severity::Error) return messageOf(*one);
  return program.failure();
}

// Refuses a name that collides with another one, or that the dialect does not allow: then the program has other errors,
// or other words are about the name.
void checkRenamed(const Program& before, const OpenTexts& texts, const std::vector<Occurrence>& places,
                  const std::string& name) {
  Program after(before.path(), before.isProject());
  after.check(texts);
  if (after.diagnostics().errorCount() > before.diagnostics().errorCount() || after.analysis() == nullptr)
    throw RequestError(ErrorCode::RequestFailed, fmt::format("'{}' cannot be the name: {}", name, firstError(after)));
  const frontend::Definition* found = source::definitionOf(*after.analysis(), name);
  if (found == nullptr || occurrencesOf(*after.analysis(), *found).size() != places.size())
    throw RequestError(ErrorCode::RequestFailed,
                       fmt::format("'{}' cannot be the name: other words of the program mean it, too", name));
}

} // namespace

json prepareRename(const Place& place) {
  const frontend::Definition& definition = renamed(place);
  const auto subject = subjectAt(*place.program.analysis(), place.at);
  return {{"range", toJson(rangeOf(place.program.sources(), subject->range, place.unit))},
          {"placeholder", definition.name}};
}

json rename(const Place& place, const std::string& name) {
  const frontend::Definition& definition = renamed(place);
  const SourceManager& sources = place.program.sources();
  const std::vector<Occurrence> places = occurrencesOf(*place.program.analysis(), definition);
  OpenTexts texts;
  json changes = json::object();
  for (uint32_t i = 0; i < sources.fileCount(); ++i) {
    const FileId file{i};
    const std::vector<Change> ofFile = changesOf(place.program, file, places, name);
    const std::string path = pathOf(sources, file);
    texts.emplace(path, applied(sources, file, ofFile));
    for (const Change& change : ofFile)
      changes[uriOf(path)].push_back(
          {{"range", toJson(rangeOf(sources, change.range, place.unit))}, {"newText", change.text}});
  }
  checkRenamed(place.program, texts, places, name);
  return {{"changes", std::move(changes)}};
}

} // namespace rung::lsp
