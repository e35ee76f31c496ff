// See past_messages.h.
#include "tools/replay/past_messages.h"

#include <algorithm>
#include <utility>

namespace rung::replay {
namespace {

bool isIn(const nc::ShownMessage& message, const std::vector<nc::ShownMessage>& all) {
  return std::ranges::any_of(all, [&](const nc::ShownMessage& other) { return other.isSameButText(message); });
}

// Whether the program was started, or its state replaced, before the part that has led to the position.
bool startedBefore(const Past& past) {
  return past.part() != 0 &&
         std::ranges::any_of(past.contents().landmarksAt(past.part() - 1),
                             [](const Landmark& landmark) { return landmark.kind == Landmark::Kind::Start; });
}

} // namespace

const nc::Control& PastMessages::control() {
  if (const nc::Control* plays = past_.control()) return *plays;
  const bool anew = program_ != past_.programNumber();
  if (!own_ || startedBefore(past_)) own_ = nc::makeControl(past_.instance().program().dialect), program_ = kNone;
  if (anew || program_ == kNone) past_.attach(*own_);
  program_ = past_.programNumber();
  for (const rung_message& message : past_.sent()) own_->accept(message);
  return *own_;
}

std::vector<PastMessage> PastMessages::changes() {
  const nc::Control& control = this->control();
  if (control.shows(past_.instance(), shown_)) return {};
  std::vector<nc::ShownMessage> now = control.messages(past_.instance());
  std::vector<PastMessage> changes;
  for (const nc::ShownMessage& message : shown_)
    if (!isIn(message, now)) changes.push_back({true, message, control.text(message)});
  for (const nc::ShownMessage& message : now)
    if (!isIn(message, shown_)) changes.push_back({false, message, control.text(message)});
  shown_ = std::move(now);
  return changes;
}

std::string forEachMessage(Past& past, const std::function<void(const PastMessage& change)>& see) {
  if (std::string problem = past.goTo(past.firstPart()); !problem.empty()) return problem;
  const NotCompared notCompared(past);
  PastMessages messages(past);
  do
    for (const PastMessage& change : messages.changes()) see(change);
  while (past.next());
  return past.problem();
}

} // namespace rung::replay
