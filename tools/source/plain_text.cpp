// See plain_text.h.
#include "tools/source/plain_text.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"

namespace rung::source {

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

} // namespace rung::source
