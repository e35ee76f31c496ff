// Writing a page of the reference: lines, headings, tables.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "ir/support/put.h"

namespace rung::frontend {

class Page {
public:
  template <class... Args>
  void line(fmt::format_string<Args...> text, Args&&... args) {
    put(text_, text, std::forward<Args>(args)...);
    text_ += '\n';
  }
  void heading(std::string_view title) { line("\n{}\n", title); }
  // Begins a table: "| column | column |".
  void table(std::string_view columns) {
    text_ += columns;
    text_ += "\n|";
    for (auto n = std::count(columns.begin(), columns.end(), '|'); n > 1; --n) text_ += " --- |";
    text_ += '\n';
  }
  std::string take() { return std::move(text_); }

private:
  std::string text_;
};

// A text as it stands in a table.
inline std::string cell(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

} // namespace rung::frontend
