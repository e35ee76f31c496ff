// Finding and checking configuration keys (see config_key.h).
#include "rtlib/nc/config_key.h"

#include "rtlib/text/number.h"

namespace rung::nc {
namespace {

bool matches(std::string_view pattern, std::string_view key) {
  const size_t open = pattern.find('<');
  if (open == std::string_view::npos) return pattern == key;
  const std::string_view before = pattern.substr(0, open);
  const size_t close = pattern.rfind('>');
  const std::string_view after = pattern.substr(close + 1);
  if (key.size() <= before.size() + after.size() || !key.starts_with(before) || !key.ends_with(after)) return false;
  const std::string_view part = key.substr(before.size(), key.size() - before.size() - after.size());
  return pattern.substr(open + 1, close - open - 1) != "n" || text::numberIn<uint64_t>(part);
}

bool isOneOf(std::string_view words, std::string_view value) {
  while (!words.empty()) {
    const size_t end = words.find(' ') == std::string_view::npos ? words.size() : words.find(' ');
    if (words.substr(0, end) == value) return true;
    words.remove_prefix(end == words.size() ? end : end + 1);
  }
  return false;
}

// "a b c" as "a, b or c".
std::string listOf(std::string_view words) {
  std::string out;
  for (size_t at = 0; at < words.size();) {
    size_t end = words.find(' ', at);
    const bool last = end == std::string_view::npos;
    if (last) end = words.size();
    if (!out.empty()) out += last ? " or " : ", ";
    out += words.substr(at, end - at);
    at = end + 1;
  }
  return out;
}

std::string durationText(int64_t us) {
  if (us % 1'000'000 == 0) return std::to_string(us / 1'000'000) + "s";
  return us % 1000 == 0 ? std::to_string(us / 1000) + "ms" : std::to_string(us) + "us";
}

bool isRight(const ConfigKey& row, std::string_view value) {
  switch (row.form) {
  case ConfigForm::Choice: return isOneOf(row.takes, value);
  case ConfigForm::Whole: return wholeNumber(value) >= row.least && wholeNumber(value) <= row.most;
  case ConfigForm::Number: return text::realIn(value).has_value();
  case ConfigForm::Duration: return durationUs(value) >= row.least && durationUs(value) <= row.most;
  case ConfigForm::File: return !value.empty();
  case ConfigForm::Text: return true;
  }
  return true;
}

} // namespace

int64_t wholeNumber(std::string_view text) {
  const auto value = text::wholeIn<int64_t>(text);
  return value && *value >= 0 ? *value : -1;
}

int64_t durationUs(std::string_view text) {
  struct Unit {
    std::string_view name;
    int64_t us;
  };
  constexpr int64_t kMost = 1'000'000'000'000; // maximum number, so that no product overflows
  for (const Unit unit : {Unit{"us", 1}, Unit{"ms", 1000}, Unit{"s", 1'000'000}}) {
    if (!text.ends_with(unit.name)) continue;
    const int64_t number = wholeNumber(text.substr(0, text.size() - unit.name.size()));
    if (number >= 0) return number <= kMost ? number * unit.us : -1;
  }
  return -1;
}

const ConfigKey* findConfigKey(std::span<const ConfigKey> keys, std::string_view key) {
  for (const ConfigKey& row : keys)
    if (matches(row.key, key)) return &row;
  return nullptr;
}

std::string shownKey(const ConfigKey& key) {
  std::string shown;
  for (const char c : key.key)
    if (c != '<' && c != '>') shown += c;
  return shown;
}

std::string takesOf(const ConfigKey& key) {
  switch (key.form) {
  case ConfigForm::Choice: return listOf(key.takes);
  case ConfigForm::Whole: return std::to_string(key.least) + " to " + std::to_string(key.most);
  case ConfigForm::Number: return key.takes.empty() ? "a number" : std::string(key.takes);
  case ConfigForm::Duration:
    return "a duration with its unit such as 2ms, " + durationText(key.least) + " to " + durationText(key.most);
  case ConfigForm::File: return key.takes.empty() ? "a file" : std::string(key.takes);
  case ConfigForm::Text: return std::string(key.takes);
  }
  return {};
}

std::string wrongValue(const ConfigKey& row, std::string_view key, std::string_view value) {
  if (isRight(row, value)) return {};
  return std::string(key) + ": expected " + takesOf(row) + ", found '" + std::string(value) + "'";
}

} // namespace rung::nc
