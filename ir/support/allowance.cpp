// See allowance.h.
#include "ir/support/allowance.h"

#include "ir/support/ascii.h"

namespace rung {
namespace {

constexpr std::string_view kBegin = "allow(";

// The length of an allowance that the text begins with; 0 where it begins with something else.
size_t lengthOf(std::string_view text) {
  if (!text.starts_with(kBegin)) return 0;
  size_t end = kBegin.size();
  while (end < text.size() && (isLetter(text[end]) || isDigit(text[end]) || text[end] == '-')) ++end;
  return end > kBegin.size() && end < text.size() && text[end] == ')' ? end + 1 : 0;
}

// Between a remark and an allowance.
bool isMark(char c) { return c == ',' || c == ';' || c == ' ' || c == '\t'; }

} // namespace

bool allows(std::string_view comment, std::string_view code) {
  return comment.find(std::string(kBegin).append(code).append(")")) != std::string_view::npos;
}

std::string withoutAllowances(std::string_view comment) {
  std::string shown(comment);
  for (size_t at = shown.find(kBegin); at != std::string::npos; at = shown.find(kBegin, at)) {
    const size_t length = lengthOf(std::string_view(shown).substr(at));
    size_t first = at;
    size_t end = at + length;
    while (length != 0 && first > 0 && isMark(shown[first - 1])) --first;
    while (length != 0 && first == 0 && end < shown.size() && isMark(shown[end])) ++end;
    shown.erase(first, end - first);
    at = length == 0 ? at + 1 : first;
  }
  return shown;
}

} // namespace rung
