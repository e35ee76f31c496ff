// Watched names and messages (see watch.h).
#include "tools/scenario/watch.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace rung::scenario {
namespace {

std::string atTime(const Session& session, const std::string& what) {
  return fmt::format("{:>12.3f} ms  {}", static_cast<double>(session.nowUs()) / 1000.0, what);
}

} // namespace

std::string Watch::add(const std::string& name, const Session& session) {
  const Result<Reading> reading = readName(session.instance(), session.nc(), name, false);
  if (!reading.ok()) return reading.error();
  if (std::ranges::find(watched_, name, [](const Watched& w) { return w.value.name(); }) == watched_.end())
    watched_.push_back({{name, session.instance(), session.nc()}, ""});
  return {};
}

bool Watch::remove(const std::string& name) {
  return std::erase_if(watched_, [&](const Watched& w) { return w.value.name() == name; }) > 0;
}

std::vector<std::string> Watch::names() const {
  std::vector<std::string> names;
  for (const Watched& watched : watched_) names.push_back(watched.value.name());
  return names;
}

void Watch::replaced(const Session& session, const NextProgram&) {
  for (Watched& watched : watched_) watched.value.locate(session.instance(), session.nc());
  otherTexts_ = true;
}

void Watch::look(const Session& session) {
  for (Watched& watched : watched_) {
    const std::optional<Reading> reading = watched.value.read(session.instance(), session.nc());
    std::string now = reading ? " = " + showShort(*reading) : " is gone";
    if (now == watched.last) continue;
    print_(atTime(session, watched.value.name() + now));
    watched.last = std::move(now);
  }
  printMessages(session);
}

void Watch::printMessages(const Session& session) {
  const nc::Control& control = session.nc().control();
  if (!std::exchange(otherTexts_, false) && control.shows(session.instance(), shown_)) return;
  std::vector<nc::ShownMessage> now = control.messages(session.instance());
  const auto has = [](const std::vector<nc::ShownMessage>& list, const nc::ShownMessage& message) {
    return std::ranges::find(list, message) != list.end();
  };
  for (const nc::ShownMessage& message : shown_)
    if (!has(now, message)) print_(atTime(session, control.text(message) + " is gone"));
  for (const nc::ShownMessage& message : now)
    if (!has(shown_, message)) print_(atTime(session, control.text(message)));
  shown_ = std::move(now);
}

} // namespace rung::scenario
