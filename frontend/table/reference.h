// A page of the reference. Dialects and tools supply titles, texts and rows; only this class knows headings, tables and
// escaped characters in Markdown.
#pragma once
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "frontend/table/instruction.h"
#include "ir/support/diagnostics.h"
#include "ir/support/put.h"

namespace rung::frontend {

// Markdown text in lines of at most 100 characters; code spans and blocks of code are not divided.
inline std::string wrapped(std::string_view text) {
  constexpr ptrdiff_t kColumns = 100;
  if (text.starts_with("```")) return std::string(text);
  std::string lines;
  ptrdiff_t column = 0;
  size_t begin = 0; // of the word
  bool code = false;
  for (size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ' ';
    if (c == '`') code = !code;
    if (i < text.size() && c != '\n' && (c != ' ' || code)) continue;
    const std::string_view word = text.substr(begin, i - begin);
    const ptrdiff_t width = std::ranges::count_if(word, [](char letter) { return (letter & 0xC0) != 0x80; });
    const bool full = column > 0 && column + 1 + width > kColumns;
    if (column > 0) lines += full ? '\n' : ' ';
    (lines += word) += c == '\n' ? "\n" : "";
    column = c == '\n' ? 0 : width + (column == 0 || full ? 0 : column + 1);
    begin = i + 1;
  }
  return lines;
}

class ReferencePage {
public:
  struct Heading {
    int level;
    std::string title;
  };
  // A heading, its text and the head of a table, whose rows follow: columns are "code | meaning", or "|" for two
  // without names. Without a title it continues the section before. Level 1 is the page itself, 3 a part of a section.
  void section(std::string_view title, std::string_view text, std::string_view columns = {}, int level = 2) {
    if (!text_.empty() && !text_.ends_with("\n\n")) text_ += '\n';
    if (!title.empty()) {
      put(text_, "{:#>{}} {}\n\n", "", level, title);
      headings_.push_back({level, std::string(title)});
    }
    if (!text.empty()) put(text_, "{}\n{}", wrapped(text), columns.empty() ? "" : "\n");
    if (columns.empty()) return;
    put(text_, "| {} |\n|", columns);
    for (auto n = std::ranges::count(columns, '|'); n >= 0; --n) text_ += " --- |";
    text_ += '\n';
  }
  void part(std::string_view title, std::string_view text, std::string_view columns = {}) {
    section(title, text, columns, 3);
  }
  template <class... Cells>
  void row(const Cells&... cells) {
    text_ += '|';
    (cell(cells), ...);
    text_ += '\n';
  }
  std::string take() { return std::move(text_); }
  const std::vector<Heading>& headings() const { return headings_; }

private:
  // nullopt: an empty cell.
  template <class Value>
  void cell(const Value& value) {
    if constexpr (!std::is_same_v<Value, std::nullopt_t>) {
      text_ += ' ';
      for (const char c : fmt::format("{}", value)) {
        if (c == '|') text_ += '\\';
        text_ += c == '\n' ? ' ' : c;
      }
    }
    text_ += " |";
  }

  std::string text_;
  std::vector<Heading> headings_;
};

inline std::string pinNames(const InstructionInfo& row) {
  std::string names;
  for (const PinInfo& pin : row.pins.all()) (names += names.empty() ? "" : " ") += pin.name;
  return names;
}

// Warnings of a dialect about programs that may be right.
inline void addWarnings(ReferencePage& page, std::initializer_list<Diag> warnings) {
  page.section("Warnings", "All diagnostics: [diagnostics.md](diagnostics.md).", "code | meaning");
  for (const Diag id : warnings) page.row(diagInfo(id).code, diagInfo(id).explanation);
}

} // namespace rung::frontend
