// rungc explain and rungc doc: the reference, by entry or page.
#include "tools/rungc/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <vector>

#include "compiler/reference.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/similar.h"
#include "tools/rungc/commands.h"
#include "tools/source/plain_text.h"

namespace rung::rungc {
namespace {

constexpr size_t kShown = 40; // most results of a search

// Matches in names come before those in titles.
std::vector<compiler::ReferenceEntry> search(const std::vector<compiler::ReferenceEntry>& entries,
                                             const std::string& word) {
  std::vector<compiler::ReferenceEntry> found;
  const auto contains = [&](const std::string& text) {
    return text::lower(text).find(text::lower(word)) != std::string::npos;
  };
  std::copy_if(entries.begin(), entries.end(), std::back_inserter(found),
               [&](const auto& entry) { return contains(entry.name); });
  std::copy_if(entries.begin(), entries.end(), std::back_inserter(found), [&](const auto& entry) {
    return !contains(entry.name) && (contains(entry.title) || contains(entry.group));
  });
  return found;
}

std::string listed(const std::vector<compiler::ReferenceEntry>& found) {
  std::string text = "| name | kind | |\n| --- | --- | --- |\n";
  for (size_t i = 0; i < std::min(found.size(), kShown); ++i) {
    std::string title = found[i].title;
    std::replace(title.begin(), title.end(), '|', '/');
    text += fmt::format("| {} | {} | {} |\n", found[i].name, found[i].kind, title);
  }
  if (found.size() > kShown) text += fmt::format("\nand {} more; use a longer word\n", found.size() - kShown);
  return text;
}

int reportUnknown(const std::vector<compiler::ReferenceEntry>& entries, const std::string& word,
                  const ProjectNames* names) {
  const std::string meant = text::didYouMean(text::mostSimilar(word, entries, &compiler::ReferenceEntry::name));
  if (names != nullptr && names->hasErrors)
    fmt::print(stderr, "rungc: the program of the project has errors, so its addresses are not known: `rungc check` "
                       "lists the errors\n");
  fmt::print(stderr, "rungc: '{}' is not known, and no name or title contains it{}{}{}\n", word, meant,
             meant.empty() ? "; `rungc explain` lists the topics" : "",
             names == nullptr ? "; for a name of a program, name its project with --project" : "");
  return kWrong;
}

// Of the project's dialect; of all dialects without a project, or where that one does not have the word.
std::optional<std::string> referenceOf(const std::string& word, const ProjectNames* names) {
  std::optional<std::string> text = compiler::explainTopic(word);
  if (!text && names != nullptr) text = compiler::explain(word, names->dialect);
  return text ? text : compiler::explain(word);
}

// Prints the reference entry of the word and the project's name; otherwise entries that contain the word.
int explainWord(const std::string& word, const std::string& projectFile) {
  const std::optional<ProjectNames> names = namesOfProject(word, projectFile);
  if (!names && !projectFile.empty()) return kWrong;
  const std::optional<std::string> text = referenceOf(word, names ? &*names : nullptr);
  if (text) std::cout << source::plainText(*text);
  if (names && !names->text.empty()) std::cout << (text ? "\n" : "") << names->text;
  if (text || (names && !names->text.empty())) return kOk;
  std::vector<compiler::ReferenceEntry> entries = compiler::referenceEntries();
  if (names) entries.insert(entries.begin(), names->entries.begin(), names->entries.end());
  const std::vector<compiler::ReferenceEntry> found = search(entries, word);
  if (found.empty()) return reportUnknown(entries, word, names ? &*names : nullptr);
  std::cout << source::plainText(listed(found));
  return kOk;
}

int explainAt(const SourcePlace& place) {
  int status = kOk;
  if (const std::optional<std::string> text = explainPlace(place, status)) std::cout << *text;
  return status;
}

} // namespace

void addExplain(CommandLine& app, int& status) {
  Command command = app.add("explain", "Explain a diagnostic, an instruction, a signal, a fault, a configuration key");
  auto word = std::make_shared<std::string>();
  auto projectFile = std::make_shared<std::string>();
  command.option("WORD", *word,
                 "A code such as unbalanced-stack, a mnemonic such as TOND, a signal such as MF or F7.0, a fault such "
                 "as dead-loop, a key such as slot_steps, a name of the project, part of a word, or FILE:LINE:COLUMN "
                 "for what is written there; without it, the topics are listed");
  command.option("--project", *projectFile,
                 "The project file, or its folder, whose names are explained, instead of the one found");
  command.onRun([word, projectFile, &status] {
    if (word->empty())
      std::cout << source::plainText(compiler::explainTopics());
    else if (const auto place = sourcePlace(*word))
      status = explainAt(*place);
    else
      status = explainWord(*word, *projectFile);
  });
}

void addDoc(CommandLine& app, int& status) {
  Command command = app.add("doc", "Print a page of the reference as Markdown");
  auto page = std::make_shared<std::string>();
  command.option("PAGE", *page, "fanuc, gsk, nct, technol, diagnostics or ir").required();
  command.onRun([page, &status] {
    if (*page == "diagnostics")
      std::cout << compiler::diagnosticReference();
    else if (*page == "ir")
      std::cout << compiler::operationReference();
    else if (const frontend::Dialect* dialect = frontend::findDialect(*page))
      std::cout << compiler::dialectReference(*dialect);
    else {
      fmt::print(stderr, "rungc: unknown page '{}'; the pages are fanuc, gsk, nct, technol, diagnostics and ir\n",
                 *page);
      status = kUsage;
    }
  });
}

} // namespace rung::rungc
