// Keys of events (see event_keys.h).
#include "sim/technol/requests/event_keys.h"

#include <algorithm>

namespace rung::sim::technol {
namespace {

std::string namesOf(std::span<const EventKey> known) {
  std::string names;
  for (const EventKey& key : known) names.append(names.empty() ? "" : " ").append(key.name);
  return names;
}

// As a scenario would write it: identifiers and error codes in hexadecimal.
std::string shown(int64_t number) {
  constexpr int64_t kLastDecimal = 0xFF;
  if (number <= kLastDecimal) return std::to_string(number);
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (int64_t left = number; left != 0; left /= 16) text.insert(text.begin(), kDigits[left % 16]);
  return "0x" + text;
}

std::string wrongValue(const NcArgument& given, const EventKey& known) {
  const std::string name = "'" + std::string(known.name) + "' takes ";
  if (known.isText) return given.isText ? "" : name + "a text in quotes";
  const bool fits = !given.isText && !given.isReal && given.integer >= known.least && given.integer <= known.most;
  return fits ? "" : name + shown(known.least) + " to " + shown(known.most);
}

} // namespace

std::string wrongKeys(std::string_view event, std::span<const NcArgument> keys, std::span<const EventKey> known) {
  const std::string before = std::string(event) + ": ";
  for (const NcArgument& given : keys) {
    const auto found =
        std::ranges::find_if(known, [&](const EventKey& key) { return text::equalsIgnoringCase(key.name, given.key); });
    if (found == known.end()) return std::string(event) + " has no '" + given.key + "': it has " + namesOf(known);
    if (std::string wrong = wrongValue(given, *found); !wrong.empty()) return before + wrong;
    if (std::ranges::count_if(keys,
                              [&](const NcArgument& key) { return text::equalsIgnoringCase(key.key, given.key); }) > 1)
      return before + "'" + std::string(found->name) + "' is given twice";
  }
  for (const EventKey& key : known)
    if (key.isRequired && !EventKeys(keys).has(key.name)) return before + "'" + std::string(key.name) + "' is missing";
  return {};
}

} // namespace rung::sim::technol
