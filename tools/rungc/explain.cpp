// rungc explain and rungc doc: the reference, by entry or page.
#include "tools/rungc/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <vector>

#include "compiler/reference.h"
#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/similar.h"
#include "tools/rungc/commands.h"

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
  if (text) std::cout << plainText(*text);
  if (names && !names->text.empty()) std::cout << (text ? "\n" : "") << names->text;
  if (text || (names && !names->text.empty())) return kOk;
  std::vector<compiler::ReferenceEntry> entries = compiler::referenceEntries();
  if (names) entries.insert(entries.begin(), names->entries.begin(), names->entries.end());
  const std::vector<compiler::ReferenceEntry> found = search(entries, word);
  if (found.empty()) return reportUnknown(entries, word, names ? &*names : nullptr);
  std::cout << plainText(listed(found));
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
      std::cout << plainText(compiler::explainTopics());
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

// Markdown to plain text.

namespace {

constexpr size_t kWidth = 100; // of a line, if words allow it
constexpr size_t kGap = 2;     // before each column

using Row = std::vector<std::string>;

size_t widthOf(std::string_view text) {
  size_t width = 0;
  for (size_t at = 0; at < text.size();) {
    const CodePoint character = decodeUtf8(text, at);
    width += displayWidth(character.value);
    at += character.length;
  }
  return width;
}

// Cells between the bars; \| is a bar within a cell.
Row cellsOf(std::string_view line) {
  Row cells;
  std::string cell;
  for (size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|')
      cell += line[++i];
    else if (line[i] != '|')
      cell += line[i];
    else {
      cells.emplace_back(text::trimmed(cell));
      cell.clear();
    }
  }
  return cells;
}

bool isRuler(std::string_view line) { return line.find_first_not_of("|- ") == std::string_view::npos; }

// In lines of at most `width`, broken at blanks.
std::vector<std::string> broken(std::string_view text, size_t width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    if (!lines.back().empty() && widthOf(lines.back()) + 1 + widthOf(word) > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + std::string(word);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

struct Column {
  size_t width = 0;
  size_t least = 0; // width of its longest word
};

std::vector<Column> columnsOf(const std::vector<Row>& rows) {
  std::vector<Column> columns;
  for (const Row& row : rows) {
    columns.resize(std::max(columns.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) {
      columns[i].width = std::max(columns[i].width, widthOf(row[i]));
      for (const std::string& word : broken(row[i], 1)) columns[i].least = std::max(columns[i].least, widthOf(word));
    }
  }
  return columns;
}

// Reduces the widest column first.
void fit(std::vector<Column>& columns) {
  size_t total = kGap * columns.size();
  for (const Column& column : columns) total += column.width;
  while (total > kWidth) {
    Column* widest = nullptr;
    for (Column& column : columns)
      if (column.width > column.least && (widest == nullptr || column.width > widest->width)) widest = &column;
    if (widest == nullptr) return;
    --widest->width;
    --total;
  }
}

void appendRow(const Row& row, const std::vector<Column>& columns, std::string& out) {
  std::vector<std::vector<std::string>> cells;
  size_t height = 1;
  for (size_t i = 0; i < columns.size(); ++i) {
    cells.push_back(broken(i < row.size() ? row[i] : "", columns[i].width));
    height = std::max(height, cells.back().size());
  }
  for (size_t n = 0; n < height; ++n) {
    std::string line;
    for (size_t i = 0; i < columns.size(); ++i) {
      const std::string text = n < cells[i].size() ? cells[i][n] : "";
      line += std::string(kGap, ' ') + text +
              std::string(columns[i].width - std::min(columns[i].width, widthOf(text)), ' ');
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
}

void appendTable(const std::vector<Row>& rows, std::string& out) {
  std::vector<Column> columns = columnsOf(rows);
  fit(columns);
  for (const Row& row : rows) appendRow(row, columns, out);
}

std::string withoutMarks(std::string_view line) {
  const size_t mark = line.find("### "); // "### TMR: …", "[gsk] ### TMR: …"
  if (line.starts_with('[') && mark != std::string_view::npos)
    return std::string(line.substr(0, mark)) + std::string(line.substr(mark + 4));
  if (line.starts_with('#')) line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
  return std::string(line);
}

} // namespace

std::string plainText(std::string_view markdown) {
  std::string out;
  std::vector<Row> table;
  bool fenced = false;
  while (!markdown.empty()) {
    const size_t end = std::min(markdown.find('\n'), markdown.size());
    const std::string_view line = markdown.substr(0, end);
    markdown.remove_prefix(std::min(end + 1, markdown.size()));
    if (!fenced && line.starts_with('|')) {
      if (!isRuler(line)) table.push_back(cellsOf(line));
      continue;
    }
    appendTable(table, out);
    table.clear();
    if (line.starts_with("```"))
      fenced = !fenced;
    else if (fenced)
      out += "    " + std::string(line) + "\n";
    else if (line.find(' ') == std::string_view::npos || line.starts_with(' '))
      out += withoutMarks(line) + "\n";
    else
      for (const std::string& part : broken(withoutMarks(line), kWidth)) out += part + "\n";
  }
  appendTable(table, out);
  return out;
}

} // namespace rung::rungc
