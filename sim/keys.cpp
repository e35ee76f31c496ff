// Keys of events, of the configuration and of quantities (see keys.h).
#include "sim/keys.h"

#include <algorithm>

namespace rung::sim {

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

std::optional<std::vector<uint32_t>> numbersAfter(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  text.remove_prefix(prefix.size());
  std::vector<uint32_t> numbers;
  while (const auto number = takeNumberAndDot(text)) numbers.push_back(*number);
  const auto last = text::numberIn<uint32_t>(text);
  if (!last) return std::nullopt;
  numbers.push_back(*last);
  return numbers;
}

std::optional<uint32_t> takeNumberAndDot(std::string_view& text) {
  std::string_view rest = text;
  const auto number = text::takeNumber<uint32_t>(rest);
  if (!number || !rest.starts_with('.')) return std::nullopt;
  text = rest.substr(1);
  return number;
}

} // namespace rung::sim
