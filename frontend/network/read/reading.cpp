// Reads files into the networks of a program.
#include "frontend/network/read/reading.h"

#include "frontend/network/read/ladder_reader.h"
#include "frontend/network/read/list_reader.h"

namespace rung::frontend::network {

// Decided by the file's name; if that is not conclusive, text with modules or rungs is ladder text.
bool isLadder(const Language& language, const SourceManager& sources, FileId file) {
  const std::string_view name = sources.name(file);
  if (name.ends_with(".lad")) return true;
  if (language.isList(name)) return false;
  LineReader lines(sources, file);
  LineWords words;
  for (SourceLine line; lines.next(line);) {
    splitWords(line, {}, words);
    if (!words.words.empty() && (words.words[0].text == "module" || words.words[0].text == "rung")) return true;
  }
  return false;
}

void Reading::add(FileId file, std::shared_ptr<const ListFile> list) {
  if (isLadder(context_.language, context_.sources, file))
    ladders_.push_back(parseLadderFile(context_, file)); // checks the encoding as well
  else if (checkEncoding(context_.sources, file, context_.diagnostics))
    lists_.push_back(list != nullptr ? std::move(list) : context_.language.list.open(context_.sources, file));
  else
    units_.setIncomplete();
  last_ = file;
}

bool Reading::read() {
  for (const auto& list : lists_) list->readDeclarations(context_);
  for (const auto& file : ladders_) readLadderDeclarations(context_, file);
  for (const auto& list : lists_) list->read(context_, units_);
  // Lists beside ladders may have declarations only.
  const bool hasLevels = ladders_.empty() || units_.sawList();
  if (!lists_.empty() && hasLevels) units_.endOfList(lastLineOf(context_.sources, lists_.back()->file()));
  for (const auto& file : ladders_) readLadder(context_, file, units_);
  reportUndeclared(context_);
  units_.finish(lastLineOf(context_.sources, last_));
  context_.names.addTo(context_.analysis, context_.language);
  return !units_.incomplete();
}

} // namespace rung::frontend::network
