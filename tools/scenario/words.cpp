// Words of a scenario's line (see words.h).
#include "tools/scenario/words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "rtlib/text/bit_word.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::scenario {
namespace {

struct TimeUnit {
  std::string_view name;
  double us;
};
constexpr TimeUnit kTimeUnits[] = {{"us", 1.0}, {"ms", 1e3}, {"s", 1e6}, {"min", 60e6}};
constexpr double kMostSeconds = 50; // a larger number without a unit was probably meant in milliseconds
constexpr double kLongestUs = 9e15; // far below the limit of 64 bits

// The length of the number before the unit.
size_t numberLength(std::string_view text) {
  size_t length = text.size();
  while (length > 0 && !text::isDigit(text[length - 1]) && text[length - 1] != '.') --length;
  return length;
}

} // namespace

std::string splitLine(std::string_view line, std::vector<ScenarioWord>& words) {
  size_t i = 0;
  const auto blank = [&] { return i < line.size() && (line[i] == ' ' || line[i] == '\t' || line[i] == '\r'); };
  while (true) {
    while (blank()) ++i;
    if (i >= line.size() || line[i] == '#') return {};
    ScenarioWord word;
    word.quoted = line[i] == '"';
    while (i < line.size() && !blank()) {
      if (line[i] != '"') {
        word.text += line[i++];
        continue;
      }
      const size_t close = line.find('"', i + 1);
      if (close == std::string_view::npos) return "a text is not closed: expected \"";
      const size_t skip = word.quoted ? 1 : 0;
      word.text += line.substr(i + skip, close + 1 - i - 2 * skip);
      i = close + 1;
    }
    words.push_back(std::move(word));
  }
}

std::string asWord(const std::string& text) {
  const bool plain = !text.starts_with('#') && text.find_first_of(" \t") == std::string::npos;
  return plain ? text : '"' + text + '"';
}

Value valueOf(const ScenarioWord& word) {
  Value value;
  value.text = word.text;
  value.kind = ValueKind::Text;
  if (word.quoted) return value;
  const std::optional<bool> bit = text::bitWord(word.text);
  value.isBit = bit.has_value();
  value.number = text::writtenNumber(bit ? (*bit ? "1" : "0") : word.text);
  switch (value.number.form) {
  case text::NumberForm::Whole:
  case text::NumberForm::TooLong: value.kind = ValueKind::Int; break;
  case text::NumberForm::Real: value.kind = ValueKind::Real; break;
  case text::NumberForm::None:
  case text::NumberForm::OutOfRange: break;
  }
  value.integer = static_cast<int64_t>(value.number.bits());
  value.real = value.number.real;
  return value;
}

Value valueOfKey(const std::string& text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return valueOf({quoted ? text.substr(1, text.size() - 2) : text, quoted});
}

bool isTimeUnit(std::string_view text) {
  return std::any_of(std::begin(kTimeUnits), std::end(kTimeUnits), [&](const TimeUnit& u) { return u.name == text; });
}

Result<int64_t> parseDuration(std::string_view text) {
  const size_t length = numberLength(text);
  std::string_view unit = text.substr(length);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  const std::optional<double> number = text::realIn(text.substr(0, length));
  if (!number) return failure(fmt::format("'{}' is not a time: expected one such as 250ms, 2s or 1.5min", text));
  if (!(*number >= 0)) return failure(fmt::format("'{}' is negative: a time begins at 0s", text));
  if (unit.empty()) {
    const bool isShort = *number < kMostSeconds;
    return failure(fmt::format("'{0}' has no unit (us, ms, s, min): did you mean {0}{1} or {0}{2}?", text,
                               isShort ? "s" : "ms", isShort ? "ms" : "s"));
  }
  for (const TimeUnit& known : kTimeUnits) {
    if (unit != known.name) continue;
    if (!(*number * known.us <= kLongestUs)) return failure(fmt::format("'{}' is longer than a program can run", text));
    return std::llround(*number * known.us);
  }
  return failure(fmt::format("'{}' is not a unit of time: expected us, ms, s or min", unit));
}

} // namespace rung::scenario
