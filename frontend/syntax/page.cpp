// Layout of lines in columns (see page.h).
#include "frontend/syntax/page.h"

#include <algorithm>
#include <array>

#include "frontend/syntax/word_lexer.h"
#include "ir/support/utf8.h"

namespace rung::frontend {
namespace {

constexpr size_t kCommentGap = 2; // columns between a line and its comment

// Whether the file uses CRLF; its first line end decides.
bool endsLinesAsDos(std::string_view source) {
  const size_t end = source.find('\n');
  return end != std::string_view::npos && end > 0 && source[end - 1] == '\r';
}

} // namespace

std::string_view withoutTrailingSpace(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

Page::Page(std::string_view source, size_t commentColumn)
    : lineEnd_(endsLinesAsDos(source) ? "\r\n" : "\n"), mark_(source.starts_with(kByteOrderMark) ? kByteOrderMark : ""),
      countsBytes_(findInvalidUtf8(source) != std::string_view::npos), commentColumn_(commentColumn) {}

size_t Page::width(std::string_view text) const { return countsBytes_ ? text.size() : countCodePoints(text); }

void Page::line(std::string text, std::string_view comment) {
  const bool continues = text.empty();
  lines_.push_back(
      {.cells = {std::move(text)}, .comment = std::string(withoutTrailingSpace(comment)), .aside = continues});
}

void Page::row(const Table& table, std::vector<std::string> cells, std::string_view comment) {
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  lines_.push_back({.table = &table, .cells = std::move(cells), .comment = std::string(withoutTrailingSpace(comment))});
}

void Page::aside(std::string text, std::string_view comment) {
  line(std::move(text), comment);
  lines_.back().aside = true;
}

void Page::comment(std::string_view text) {
  lines_.push_back({.cells = {std::string(withoutTrailingSpace(text))}, .aside = true});
}

void Page::blank() {
  if (!lines_.empty() && !lines_.back().isBlank()) lines_.push_back({.cells = {""}, .aside = true});
}

// Index after the last line of the table that begins here.
size_t Page::endOfTable(size_t first) const {
  const Table* table = lines_[first].table;
  size_t end = first + 1;
  for (size_t i = end; i < lines_.size() && (lines_[i].aside || lines_[i].table == table); ++i) {
    if (table->endsAtBlank && lines_[i].isBlank()) break;
    if (!lines_[i].aside) end = i + 1;
  }
  return end;
}

size_t Page::secondColumn(size_t first, size_t end) const {
  size_t column = lines_[first].table->second;
  for (size_t i = first; i < end; ++i)
    if (lines_[i].cells.size() > 1) column = std::max(column, width(lines_[i].cells[0]) + 1);
  return column;
}

size_t Page::thirdColumn(size_t first, size_t end, size_t second) const {
  const Table& table = *lines_[first].table;
  size_t column = table.third;
  for (size_t i = first; i < end && table.alignsThird; ++i)
    if (lines_[i].cells.size() > 2) column = std::max(column, second + width(lines_[i].cells[1]) + 1);
  return column;
}

void Page::layOutTable(size_t first, size_t end) {
  const size_t second = secondColumn(first, end);
  const std::array<size_t, 3> columns = {0, second, thirdColumn(first, end, second)};
  for (size_t i = first; i < end; ++i) {
    std::string text;
    for (size_t cell = 0; cell < lines_[i].cells.size(); ++cell) {
      const size_t least = cell == 0 ? 0 : width(text) + 1;
      text.append(std::max(columns[cell], least) - width(text), ' ').append(lines_[i].cells[cell]);
    }
    lines_[i].cells = {std::move(text)};
  }
  alignComments(first, end);
}

void Page::alignComments(size_t first, size_t end) {
  size_t column = commentColumn_;
  for (size_t i = first; i < end; ++i)
    if (!lines_[i].comment.empty() && !lines_[i].text().empty())
      column = std::max(column, width(lines_[i].text()) + kCommentGap);
  for (size_t i = first; i < end; ++i) lines_[i].commentColumn = column;
}

void Page::layOut() {
  for (size_t i = 0; i < lines_.size();) {
    size_t end = i + 1;
    if (lines_[i].isTable()) {
      end = endOfTable(i);
      layOutTable(i, end);
    } else if (!lines_[i].comment.empty()) {
      while (end < lines_.size() && !lines_[end].isTable() && !lines_[end].comment.empty()) ++end;
      alignComments(i, end);
      for (size_t next = i; next < end && lines_[next].text().empty(); ++next)
        lines_[next].commentColumn = lines_[next - 1].commentColumn; // the column of the line above
    }
    i = end;
  }
}

std::string Page::take() {
  while (!lines_.empty() && lines_.back().isBlank()) lines_.pop_back();
  layOut();
  std::string out(mark_);
  for (const Line& line : lines_) {
    out += line.text();
    if (!line.comment.empty()) out.append(line.commentColumn - width(line.text()), ' ').append(line.comment);
    out += lineEnd_;
  }
  return out;
}

} // namespace rung::frontend
