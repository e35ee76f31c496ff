// Words and numbers of other languages (see foreign_word.h).
#include "frontend/sema/foreign_word.h"

#include <algorithm>
#include <string>

#include "ir/support/ascii.h"
#include "rtlib/text/letters.h"

namespace rung::frontend {

const ForeignWord* findForeign(std::span<const ForeignWord> words, std::string_view word) {
  const auto found =
      std::ranges::find_if(words, [&](const ForeignWord& one) { return text::equalsIgnoringCase(one.word, word); });
  return found == words.end() ? nullptr : &*found;
}

void explainForeign(DiagBuilder& report, SourceRange range, const ForeignWord& word, bool fits) {
  if (word.same)
    report.meant(fits ? range : SourceRange{}, word.here);
  else
    report.note("in this language: " + std::string(word.here));
}

bool isModified(std::string_view word, std::string_view known) {
  constexpr std::string_view kModifiers = "NIPF";
  if (known.empty() || word.size() != known.size() + 1 || !text::startsWithIgnoringCase(word, known)) return false;
  const char last = text::upper(word.back());
  return last != text::upper(known.back()) &&
         kModifiers.find(last) != std::string_view::npos; // a doubled one is a slip
}

std::optional<ForeignNumber> foreignNumber(std::string_view text) {
  struct Prefix {
    std::string_view text;
    uint32_t base;
  };
  constexpr Prefix kPrefixes[] = {{"0x", 16}, {"16#", 16}, {"#$", 16}, {"$", 16}, {"&H", 16}, {"0b", 2}, {"2#", 2}};
  ForeignNumber number{text, 0};
  for (const Prefix& prefix : kPrefixes)
    if (text::takePrefixIgnoringCase(number.digits, prefix.text)) {
      number.base = prefix.base;
      break;
    }
  if (number.base == 0) {
    if (text.empty() || !isDigit(text[0]) || text::upper(text.back()) != 'H') return std::nullopt;
    number = {text.substr(0, text.size() - 1), 16};
  }
  const auto isOne = [&](char c) { return hexDigit(c) >= 0 && static_cast<uint32_t>(hexDigit(c)) < number.base; };
  if (number.digits.empty() || !std::ranges::all_of(number.digits, isOne)) return std::nullopt;
  return number;
}

} // namespace rung::frontend
