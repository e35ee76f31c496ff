// See allowance.h.
#include "ir/support/allowance.h"

#include <algorithm>

#include "rtlib/text/letters.h"

namespace rung {
namespace {

constexpr std::string_view kBegin = "allow(";

bool isCodeCharacter(char c) { return text::isLetter(c) || text::isDigit(c) || c == '-'; }
bool isBlank(char c) { return c == ' ' || c == '\t'; }

// Removes and returns the next of several codes separated by commas; empty if something else follows.
std::string_view takeCode(std::string_view& list) {
  list.remove_prefix(std::min(list.find_first_not_of(" \t"), list.size()));
  const auto* const end = std::ranges::find_if_not(list, isCodeCharacter);
  const std::string_view code = list.substr(0, static_cast<size_t>(end - list.begin()));
  list.remove_prefix(code.size());
  list.remove_prefix(std::min(list.find_first_not_of(" \t"), list.size()));
  if (!list.empty() && list[0] != ',') return {};
  list.remove_prefix(std::min<size_t>(1, list.size()));
  return code;
}

// The text in the brackets of an allowance at the beginning of the text; nothing if there is none.
std::string_view codesOf(std::string_view text) {
  const size_t end = text.find(')');
  if (!text.starts_with(kBegin) || end == std::string_view::npos) return {};
  const std::string_view codes = text.substr(kBegin.size(), end - kBegin.size());
  for (std::string_view rest = codes; !rest.empty();)
    if (takeCode(rest).empty()) return {};
  return codes;
}

// Between a remark and an allowance.
bool isMark(char c) { return c == ',' || c == ';' || isBlank(c); }

} // namespace

bool allows(std::string_view comment, std::string_view code) {
  return std::ranges::count(allowedCodes(comment), code) != 0;
}

std::vector<std::string_view> allowedCodes(std::string_view comment) {
  std::vector<std::string_view> all;
  for (size_t at = comment.find(kBegin); at != std::string_view::npos; at = comment.find(kBegin, at + 1))
    for (std::string_view codes = codesOf(comment.substr(at)); !codes.empty();) all.push_back(takeCode(codes));
  return all;
}

std::string withoutAllowances(std::string_view comment) {
  std::string shown(comment);
  for (size_t at = shown.find(kBegin); at != std::string::npos; at = shown.find(kBegin, at)) {
    const std::string_view codes = codesOf(std::string_view(shown).substr(at));
    const size_t length = codes.empty() ? 0 : kBegin.size() + codes.size() + 1;
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
