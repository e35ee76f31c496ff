// Words and numbers of other languages (see foreign_word.h).
#include "frontend/sema/foreign_word.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::frontend {
namespace {

struct TimeUnit {
  std::string_view text; // in capitals; a unit that is a prefix of another comes after it
  ForeignTime::Unit unit;
};
constexpr TimeUnit kTimeUnits[] = {{"MS", ForeignTime::Unit::Milliseconds}, {"MIN", ForeignTime::Unit::Minutes},
                                   {"M", ForeignTime::Unit::Minutes},       {"SEC", ForeignTime::Unit::Seconds},
                                   {"S", ForeignTime::Unit::Seconds},       {"H", ForeignTime::Unit::Hours}};
constexpr uint64_t kMilliseconds[] = {1, 1000, 60'000, 3'600'000}; // by ForeignTime::Unit

constexpr uint64_t kMostTime = uint64_t{1} << 52; // bound for the sum of the parts, which a double holds exactly

// Takes a number, with or without a decimal point, and its unit off the front of `text`.
struct TimePart {
  double amount = 0;
  ForeignTime::Unit unit = ForeignTime::Unit::Milliseconds;
};
std::optional<TimePart> takeTimePart(std::string_view& text) {
  const std::string_view digits = text.substr(0, text.find_first_not_of("0123456789."));
  const std::optional<double> amount = text::realIn(digits);
  if (!amount || !text::isDigit(digits[0])) return std::nullopt;
  text.remove_prefix(digits.size());
  for (const TimeUnit& unit : kTimeUnits)
    if (text::takePrefixIgnoringCase(text, unit.text)) return TimePart{*amount, unit.unit};
  return std::nullopt;
}

struct ComparisonSign {
  std::string_view sign; // a sign that is a prefix of another comes after it
  std::string_view word;
};
constexpr ComparisonSign kComparisonSigns[] = {{">=", "GE"}, {"<=", "LE"}, {"<>", "NE"}, {"!=", "NE"},
                                               {"==", "EQ"}, {">", "GT"},  {"<", "LT"},  {"=", "EQ"}};

} // namespace

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
         kModifiers.find(last) != std::string_view::npos; // a doubled last letter is a typing error
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
    if (text.empty() || !text::isDigit(text[0]) || text::upper(text.back()) != 'H') return std::nullopt;
    number = {text.substr(0, text.size() - 1), 16};
  }
  const auto isOne = [&](char c) {
    return text::hexDigit(c) >= 0 && static_cast<uint32_t>(text::hexDigit(c)) < number.base;
  };
  if (number.digits.empty() || !std::ranges::all_of(number.digits, isOne)) return std::nullopt;
  return number;
}

uint64_t ForeignTime::milliseconds() const { return amount * kMilliseconds[static_cast<size_t>(unit)]; }

std::optional<ForeignTime> foreignTime(std::string_view text) {
  for (const std::string_view prefix : {"TIME#", "S5T#", "T#"})
    if (text::takePrefixIgnoringCase(text, prefix)) break;
  const std::optional<TimePart> first = takeTimePart(text);
  if (!first) return std::nullopt;
  if (text.empty() && first->amount == std::floor(first->amount) && first->amount <= UINT32_MAX)
    return ForeignTime{static_cast<uint64_t>(first->amount), first->unit};
  double sum = 0;
  for (std::optional<TimePart> part = first; part; part = takeTimePart(text)) {
    sum += part->amount * static_cast<double>(kMilliseconds[static_cast<size_t>(part->unit)]);
    if (text.empty() && sum <= static_cast<double>(kMostTime))
      return ForeignTime{static_cast<uint64_t>(std::lround(sum)), ForeignTime::Unit::Milliseconds};
  }
  return std::nullopt;
}

std::optional<ForeignComparison> foreignComparison(std::string_view text) {
  const size_t at = text.find_first_of("<>=");
  if (at == std::string_view::npos || at == 0) return std::nullopt;
  const size_t begin = text[at - 1] == '!' ? at - 1 : at;
  const auto* const sign = std::ranges::find_if(
      kComparisonSigns, [&](const ComparisonSign& one) { return text.substr(begin).starts_with(one.sign); });
  if (sign == std::end(kComparisonSigns)) return std::nullopt;
  const ForeignComparison found{text::trimmed(text.substr(0, begin)), sign->word,
                                text::trimmed(text.substr(begin + sign->sign.size()))};
  if (found.left.empty() || found.right.empty() || found.right.find_first_of("<>= ") != std::string_view::npos ||
      found.left.find(' ') != std::string_view::npos)
    return std::nullopt;
  return found;
}

} // namespace rung::frontend
