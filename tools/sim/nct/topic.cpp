// Keys of events and of the configuration (see topic.h).
#include "tools/sim/nct/topic.h"

#include <algorithm>
#include <charconv>

namespace rung::sim::nct {

const NcArgument* findKey(const std::vector<NcArgument>& keys, std::string_view key) {
  const auto found = std::ranges::find(keys, key, &NcArgument::key);
  return found == keys.end() ? nullptr : &*found;
}

int64_t integerKey(const std::vector<NcArgument>& keys, std::string_view key, int64_t otherwise) {
  const NcArgument* found = findKey(keys, key);
  return found == nullptr ? otherwise : found->integer;
}

std::string unknownKey(std::string_view event, const std::vector<NcArgument>& keys,
                       std::initializer_list<std::string_view> known) {
  for (const NcArgument& key : keys)
    if (std::ranges::find(known, key.key) == known.end())
      return "event " + std::string(event) + " does not know '" + key.key + "'";
  return {};
}

std::optional<double> numberOf(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::vector<uint32_t>> numbersBehind(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  const char* at = text.data() + prefix.size();
  const char* last = text.data() + text.size();
  std::vector<uint32_t> numbers;
  while (true) {
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(at, last, number);
    if (error != std::errc()) return std::nullopt;
    numbers.push_back(number);
    if (end == last) return numbers;
    if (*end != '.') return std::nullopt;
    at = end + 1;
  }
}

} // namespace rung::sim::nct
