// See look.h.
#include "machine/rungctl/look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

#include "machine/rungctl/words.h"

namespace rung::rungctl {

using nlohmann::json;

namespace {

std::string usesOf(const json& pin) {
  std::vector<std::string> uses;
  for (const json& use : pin["uses"]) uses.push_back(shown(use));
  return fmt::format("{}", fmt::join(uses, ", "));
}

} // namespace

std::vector<Look::Pin> Observer::pinsOf(const json& map, Clock::time_point now) {
  std::vector<Look::Pin> pins;
  for (const json& pin : map["pins"]) {
    const std::string name = shown(pin["name"]);
    const std::string value = pin.contains("value") ? shown(pin["value"]) : "?";
    const auto [known, isFirst] = pins_.try_emplace(name, Seen{.value = value, .former = "", .changed = now});
    Seen& seen = known->second;
    if (seen.value != value) {
      seen.former = std::exchange(seen.value, value);
      seen.changed = now;
      ++seen.changes;
    }
    const std::chrono::duration<double> since = now - seen.changed;
    pins.push_back({.name = name,
                    .value = value,
                    .former = seen.former,
                    .uses = usesOf(pin),
                    .changedS = seen.changes == 0 ? -1 : since.count(),
                    .changes = seen.changes});
  }
  return pins;
}

void Observer::look(Client& client, const Wanted& wanted, Look& look) {
  look.status = asked(client, {{"do", "status"}}, kPatience);
  const json profile = client.ask({{"do", "profile"}, {"top", kMostRungs}, {"by", wanted.rungsBy}}, kPatience);
  const bool isCounted = profile.value("ok", false) && profile.value("time_ns", 0.0) > 0;
  look.profile = isCounted ? profile : json();
  look.timers = asked(client, {{"do", "timers"}}, kPatience)["timers"].get<std::vector<json>>();
  const json messages = asked(client, {{"do", "messages"}}, kPatience);
  look.messages.clear();
  for (const json& entry : messages["entries"])
    if (entry.value("on", false)) look.messages.push_back(entry);
  if (wanted.log) look.log = asked(client, {{"do", "log"}}, kPatience)["entries"].get<std::vector<json>>();
  look.pins = pinsOf(asked(client, {{"do", "map"}}, kPatience), Clock::now());
}

} // namespace rung::rungctl
