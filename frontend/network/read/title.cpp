// Comments to titles.
#include "frontend/network/read/title.h"

#include <algorithm>

#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

bool isDecoration(std::string_view text) {
  return std::ranges::none_of(
      text, [](char c) { return text::isDigit(c) || text::isLetter(c) || static_cast<signed char>(c) < 0; });
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

} // namespace rung::frontend::network
