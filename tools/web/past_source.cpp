// Plays the recording and makes pictures of it (see past_source.h).
#include "tools/web/past_source.h"

#include <algorithm>
#include <fmt/format.h>

#include "tools/scenario/names.h"
#include "tools/scenario/values.h"

namespace rung::web {
namespace {

constexpr uint64_t kMostRead = 200'000; // parts that are played at the start, to find messages
constexpr size_t kMostHits = 200;       // of a condition that is looked for

} // namespace

PastSource::PastSource(replay::Past& past, const ShownProgram& program)
    : past_(past), program_(program), nc_(sim::makeSimulatedNc(past.instance().program().dialect)),
      states_(past.flowEngine(), program), places_(program, past.instance(), *nc_, states_) {
  running_ = false;
  readEvents();
}

// The messages and landmarks of the whole recording are known from the beginning.
void PastSource::readEvents() {
  using Kind = replay::Landmark::Kind;
  const uint64_t here = past_.part();
  if (!past_.goTo(past_.firstPart()).empty()) return;
  auto landmark = past_.contents().landmarks.begin();
  const auto marks = [&](uint64_t upTo) {
    for (; landmark != past_.contents().landmarks.end() && landmark->part <= upTo; ++landmark) {
      const bool fault = landmark->kind == Kind::Fault;
      const char* kind = fault ? "fault" : landmark->kind == Kind::Note ? "statement" : "mark";
      log(kind, fault ? past_.instance().faultText() : landmark->text, landmark->part, nowUs());
    }
  };
  marks(past_.part());
  for (uint64_t i = 0; i < kMostRead && past_.next(); ++i) {
    for (const rung_message& message : past_.sent()) nc_->accept(past_.instance(), message);
    compareMessages(past_.instance(), nc_->control(), past_.part());
    marks(past_.part());
  }
  (void)past_.goTo(here);
}

// Where it begins to hold, from the beginning of the recording to its end.
void PastSource::searchPast(replay::Condition& condition, const std::string& text) {
  const uint64_t here = past_.part();
  const auto find = [this](std::string_view name) { return locate(name); };
  std::string problem;
  std::optional<uint64_t> found = past_.firstPart();
  for (size_t hits = 0; found && hits < kMostHits; ++hits) {
    found = replay::findNext(past_, condition, find, *found, lastScan(), problem);
    if (found) log("trigger", text, *found, nowUs());
  }
  (void)past_.goTo(here);
}

Result<std::string> PastSource::seek(uint64_t part) {
  part = std::clamp(part, firstScan(), past_.contents().parts);
  if (const std::string problem = past_.goTo(part); !problem.empty()) return failure(problem);
  return fmt::format("scan {}", part);
}

bool PastSource::nextScan() {
  return past_.part() < past_.contents().parts && past_.next() && past_.part() < past_.contents().parts;
}

Result<std::string> PastSource::carryOut(const Order& order) {
  running_ = false;
  switch (order.kind) {
  case Order::Kind::Run: running_ = true; return std::string("playing");
  case Order::Kind::Pause: return std::string("paused");
  case Order::Kind::Step: {
    const bool before = order.scans < 0 && past_.part() < static_cast<uint64_t>(-order.scans);
    return seek(before ? 0 : past_.part() + static_cast<uint64_t>(order.scans));
  }
  case Order::Kind::Seek: return seek(order.scans < 0 ? 0 : static_cast<uint64_t>(order.scans));
  case Order::Kind::Set:
  case Order::Kind::Force:
  case Order::Kind::Unforce:
  case Order::Kind::Statement: break;
  }
  return failure(mayWrite());
}

// Reasons that lead nowhere further are only causes of the step before.
void PastSource::addSteps(const replay::Reason& reason, uint32_t depth, std::vector<WhyStep>& steps) {
  using Kind = replay::Reason::Kind;
  const bool ends = reason.kind == Kind::Before || reason.kind == Kind::Clock || reason.kind == Kind::Answer ||
                    reason.kind == Kind::Kept;
  if (ends && depth > 0) return;
  WhyStep& step = steps.emplace_back();
  step.depth = depth;
  step.scan = reason.part;
  step.text = fmt::format("{} = {}", reason.name, reason.value);
  if (const std::string kind = replay::kindText(reason); !kind.empty()) step.text += ": " + kind;
  if (!reason.note.empty()) step.text += ": " + reason.note;
  if (reason.lowered != replay::kNone) {
    const replay::Elements& elements = past_.flowEngine().elements();
    if (const uint32_t rung = elements.rungOf(reason.lowered); rung != replay::kNone)
      step.row = program_.rowOf(elements.rungs()[rung].number);
  }
  for (const replay::Reason& because : reason.because)
    step.causes.push_back(because.name.substr(0, because.name.find(" (")));
  for (const replay::Reason& because : reason.because) addSteps(because, depth + 1, steps);
}

Result<Why> PastSource::explain(const std::string& name) {
  const auto place = nc_->readPlace(past_.instance().program(), name);
  if (!place) return failure(scenario::unknownName(past_.instance().program(), *nc_, name));
  const replay::Explanation explanation = replay::why(past_, *place);
  Why why{replay::textOf(explanation), {}};
  addSteps(explanation.reason, 0, why.steps);
  return why;
}

std::string PastSource::valueOf(const std::string& name) const {
  const auto place = nc_->readPlace(past_.instance().program(), name);
  if (!place) return {};
  return scenario::showShort(scenario::readValue(past_.instance(), nc_->control(), *place, false));
}

void PastSource::fill(Picture& picture, const std::set<std::string>& names) {
  picture.scan = past_.part();
  picture.us = nowUs();
  const bool faulted = past_.instance().faulted();
  picture.state = running_ ? RunState::Running : faulted ? RunState::Fault : RunState::Past;
  if (faulted) picture.fault = past_.instance().faultText();
  if (const replay::Flow* flow = past_.flow()) picture.elements = states_.of(*flow, past_.flowInstance().block());
  for (const std::string& name : names)
    if (std::string value = valueOf(name); !value.empty()) picture.values.emplace(name, std::move(value));
  picture.messages = messagesOf(past_.instance(), nc_->control());
  picture.forces = forcedCells(places_);
  picture.firstScan = firstScan();
  picture.lastScan = past_.contents().parts;
}

} // namespace rung::web
