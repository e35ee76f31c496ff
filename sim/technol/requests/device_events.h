// Keys of events and of expect_sent as a scenario gives them, and the keys that an event accepts.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rtlib/text/letters.h"
#include "sim/simulated_nc.h"

namespace rung::sim::technol {

struct EventKey {
  std::string_view name;
  int64_t least = 0, most = 1; // limits of a number
  bool isText = false;
  bool isRequired = false;
};
constexpr EventKey required(EventKey key) { return key.isRequired = true, key; }
constexpr EventKey textKey(std::string_view name) { return {.name = name, .isText = true}; }

// Returns "", or the error of the first key that does not match `known`.
std::string wrongKeys(std::string_view event, std::span<const NcArgument> keys, std::span<const EventKey> known);

class EventKeys {
public:
  explicit EventKeys(std::span<const NcArgument> keys) : keys_(keys) {}

  bool has(std::string_view name) const { return find(name) != nullptr; }
  template <class Number>
  std::optional<Number> number(std::string_view name) const {
    const NcArgument* const key = find(name);
    return key == nullptr || key->isText ? std::nullopt : std::optional(static_cast<Number>(key->integer));
  }
  std::string_view text(std::string_view name) const {
    const NcArgument* const key = find(name);
    return key == nullptr || !key->isText ? std::string_view() : std::string_view(key->text);
  }

private:
  const NcArgument* find(std::string_view name) const {
    for (const NcArgument& key : keys_)
      if (text::equalsIgnoringCase(key.key, name)) return &key;
    return nullptr;
  }

  std::span<const NcArgument> keys_;
};

} // namespace rung::sim::technol
