// Comments to titles.
#include "frontend/network/read/title.h"

#include <algorithm>

#include "ir/support/ascii.h"
#include "rtlib/text/blanks.h"

namespace rung::network {
namespace {

bool isDecoration(std::string_view text) {
  return std::ranges::none_of(text,
                              [](char c) { return isDigit(c) || isLetter(c) || static_cast<signed char>(c) < 0; });
}

} // namespace

std::optional<std::string_view> sectionIn(std::string_view comment) {
  constexpr std::string_view kBegin = "section \"";
  if (!comment.starts_with(kBegin)) return std::nullopt;
  const std::string_view text = comment.substr(kBegin.size());
  if (text.find('"') + 1 != text.size()) return std::nullopt;
  return text.substr(0, text.size() - 1);
}

bool isTitle(std::string_view comment) { return !isDecoration(comment) && comment[0] != ';'; }

void TitleRule::comment(std::string_view text) {
  if (sectionIn(text)) return statement();
  if (!isTitle(text)) return;
  if (!inBlock_) title_ = text;
  inBlock_ = true;
}

std::string_view titleAbove(const SourceManager& sources, FileId file, uint32_t from, uint32_t line) {
  uint32_t first = line;
  while (first > from + 1) {
    const std::string_view above = text::trimmed(sources.lineText(file, first - 1));
    if (!above.empty() && above[0] != ';') break;
    --first;
  }
  TitleRule rule;
  for (; first < line; ++first) {
    const std::string_view text = text::trimmed(sources.lineText(file, first));
    if (text.empty())
      rule.blank();
    else
      rule.comment(text::trimmed(text.substr(1)));
  }
  return rule.title();
}

} // namespace rung::network
