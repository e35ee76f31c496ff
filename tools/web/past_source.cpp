// Plays the recording and makes pictures of it (see past_source.h).
#include "tools/web/past_source.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <utility>

#include "rtlib/change/forcing.h"
#include "tools/report/place_names.h"
#include "tools/scenario/names.h"
#include "tools/scenario/values.h"

namespace rung::web {
namespace {

using namespace std::chrono_literals;

constexpr auto kListen = 20ms;      // at a time, so that pictures and orders do not wait
constexpr size_t kMostHeard = 4096; // changes of messages
constexpr size_t kMostHits = 200;   // of a condition that is looked for

// A page that says why there is none.
std::shared_ptr<const ShownProgram> undrawn(const std::string& title, const std::string& why) {
  view::Program program;
  program.title = title;
  program.blocks.push_back(
      {.kind = view::Block::Kind::Comment, .text = why, .comment = {}, .title = {}, .callers = {}, .place = {}});
  return std::make_shared<const ShownProgram>(std::move(program));
}

} // namespace

PastSource::PastSource(replay::Past& past, std::shared_ptr<const ShownProgram> program, Draw draw)
    : PacedSource({1, program}), past_(&past), draw_(std::move(draw)),
      nc_(sim::makeSimulatedNc(past.instance().program().dialect)) {
  running_ = false;
  views_[past.programNumber()] = std::make_unique<View>(1, std::move(program), past, *nc_);
  show(past);
}

void PastSource::show(replay::Past& past) {
  if (past_ != &past) views_.clear();
  past_ = &past;
  hears_.emplace(past);
  heard_ = past.firstPart();
  nextLandmark_ = 0;
  messages_.clear();
  stops_.clear();
  wasStopped_ = false;
  heldNumber_ = 0;
  later_.clear();
}

// Of the program at the present position.
PastSource::View& PastSource::view() {
  std::unique_ptr<View>& view = views_[past_->programNumber()];
  if (view) return *view;
  Result<ShownProgram> drawn = draw_(past_->compiled());
  view = std::make_unique<View>(++lastNumber_,
                                drawn.ok() ? std::make_shared<const ShownProgram>(std::move(drawn).value())
                                           : undrawn(past_->instance().program().name, drawn.error()),
                                *past_, *nc_);
  return *view;
}

// ---- what has happened -------------------------------------------------------------------------------------------

void PastSource::logLater(uint64_t scan, std::string kind, std::string text) {
  later_.push_back({later_.empty() ? scan : std::max(scan, later_.back().scan), std::move(kind), std::move(text)});
}

void PastSource::logLandmarks() {
  using Kind = replay::Landmark::Kind;
  const replay::Contents& contents = past_->contents();
  nextLandmark_ = std::max(nextLandmark_, contents.droppedLandmarks);
  for (; nextLandmark_ - contents.droppedLandmarks < contents.landmarks.size(); ++nextLandmark_) {
    const replay::Landmark& landmark = contents.landmarks[nextLandmark_ - contents.droppedLandmarks];
    if (landmark.part > past_->part()) return;
    const char* kind = landmark.kind == Kind::Fault   ? "fault"
                       : landmark.kind == Kind::Note  ? (isMachine() ? "mark" : "statement")
                       : landmark.kind == Kind::Start ? "begin"
                                                      : "lost";
    const bool isHere = landmark.kind == Kind::Fault && past_->instance().faulted();
    log(kind, isHere ? past_->instance().faultText() : landmark.text, landmark.part, nowUs());
  }
}

void PastSource::hear() {
  const bool stopped = past_->instance().stopped();
  if (stopped && !wasStopped_ && past_->part() > 0) stops_.push_back(past_->part() - 1);
  wasStopped_ = stopped;
  const nc::Control& control = hears_->control();
  if (compareMessages(past_->instance(), control, past_->part())) {
    if (messages_.size() == kMostHeard) messages_.pop_front();
    messages_.push_back({past_->part(), messagesOf(past_->instance(), control)});
  }
  if (isMachine()) checkTrigger(); // a recording that has ended was searched as a whole
  logLandmarks();
  for (; !later_.empty() && later_.front().scan <= past_->part(); later_.pop_front())
    log(std::move(later_.front().kind), std::move(later_.front().text), past_->part(), nowUs());
}

// What cannot be played has nothing to listen to.
void PastSource::skipDamage() {
  const std::vector<replay::StatePoint>& states = past_->contents().states;
  const auto after = std::ranges::upper_bound(states, heard_, {}, &replay::StatePoint::part);
  heard_ = after == states.end() ? past_->contents().parts : after->part;
}

bool PastSource::listen() {
  const replay::Contents& contents = past_->contents();
  heard_ = std::max(heard_, past_->firstPart());
  const bool hasNews = nextLandmark_ < contents.droppedLandmarks + contents.landmarks.size() || !later_.empty();
  if (heard_ >= contents.parts && !hasNews) return false;
  if (past_->part() != heard_ && !past_->goTo(heard_).empty()) {
    skipDamage();
    return true;
  }
  const auto until = std::chrono::steady_clock::now() + kListen;
  hear();
  bool goesOn = true;
  while (past_->part() < contents.parts && std::chrono::steady_clock::now() < until && (goesOn = past_->next())) hear();
  heard_ = past_->part();
  if (!goesOn) skipDamage();
  return true;
}

bool PastSource::look() {
  const uint64_t here = past_->part();
  if (!listen()) return false;
  past_->keep();
  (void)past_->goTo(here);
  return true;
}

// Where it begins to hold, from the beginning of the recording to its end.
void PastSource::searchPast(replay::Condition& condition, const std::string& text) {
  const uint64_t here = past_->part();
  const auto find = [this](std::string_view name) { return locate(name); };
  std::string problem;
  std::optional<uint64_t> found = past_->firstPart();
  for (size_t hits = 0; found && hits < kMostHits; ++hits) {
    found = replay::findNext(*past_, condition, find, *found, lastScan(), problem);
    if (found) log("trigger", text, *found, nowUs());
  }
  (void)past_->goTo(here);
}

// ---- moving ------------------------------------------------------------------------------------------------------

Result<std::string> PastSource::seek(uint64_t part) {
  part = std::clamp(part, firstScan(), past_->contents().parts);
  if (const std::string problem = past_->goTo(part); !problem.empty()) return failure(problem);
  return fmt::format("scan {}", part);
}

bool PastSource::nextScan() {
  return past_->part() < past_->contents().parts && past_->next() && past_->part() < past_->contents().parts;
}

Result<std::string> PastSource::carryOut(const Order& order) {
  running_ = false;
  switch (order.kind) {
  case Order::Kind::Run: running_ = true; return std::string("playing");
  case Order::Kind::Pause: return std::string("paused");
  case Order::Kind::Step: return seek(scanFrom(past_->part(), order.scans));
  case Order::Kind::Seek: return seek(scanFrom(0, order.scans));
  case Order::Kind::Set:
  case Order::Kind::Force:
  case Order::Kind::Unforce:
  case Order::Kind::Mark:
  case Order::Kind::Reload:
  case Order::Kind::Statement: break;
  }
  return failure(mayWrite());
}

// ---- why ---------------------------------------------------------------------------------------------------------

// A place that has a name is drawn by it, or by its address: the page knows either by the rows of the place.
WhyCause PastSource::causeOf(const replay::Reason& reason) {
  WhyCause cause{reason.name.substr(0, reason.name.find(" (")), reason.value, {}, reason.alone};
  if (const auto place = nc_->readPlace(past_->instance().program(), cause.name))
    cause.ids = view().places.at(report::bitsOf(*place));
  return cause;
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
    const replay::Elements& elements = past_->flowEngine().elements();
    if (const uint32_t rung = elements.rungOf(reason.lowered); rung != replay::kNone)
      step.row = view().drawn.program->rowOf(elements.rungs()[rung].number);
  }
  for (const replay::Reason& because : reason.because) step.causes.push_back(causeOf(because));
  for (const replay::Reason& because : reason.because) addSteps(because, depth + 1, steps);
}

Result<Why> PastSource::explain(const std::string& name) {
  const auto place = nc_->readPlace(past_->instance().program(), name);
  if (!place) return failure(scenario::unknownName(past_->instance().program(), *nc_, name));
  const replay::Explanation explanation = replay::why(*past_, *place);
  Why why{replay::textOf(explanation), {}, explanation.toChange, explanation.skipped};
  addSteps(explanation.reason, 0, why.steps);
  return why;
}

// ---- pictures ----------------------------------------------------------------------------------------------------

std::string PastSource::valueOf(const std::string& name) const {
  const auto place = nc_->readPlace(past_->instance().program(), name);
  if (!place) return {};
  return scenario::showShort(scenario::readValue(past_->instance(), nc_->control(), *place, false));
}

RunState PastSource::state() const {
  return running_ ? RunState::Running : past_->instance().faulted() ? RunState::Fault : RunState::Past;
}

// Tasks may run in different slices: each element as in its last run within a scan.
std::vector<uint8_t> PastSource::elementsHere() {
  const replay::Flow* flow = past_->flow({}, past_->partsPerScan());
  return flow == nullptr ? std::vector<uint8_t>() : view().states.of(*flow, past_->flowInstance().block());
}

// While the operator has stopped the program nothing runs: then the rungs are those of the last part that ran, which is
// played again once. (A fault ends the recording of scans.)
void PastSource::fillElements(Picture& picture) {
  const uint64_t here = past_->part();
  const auto after = std::ranges::upper_bound(stops_, here);
  if (!past_->instance().stopped() || after == stops_.begin()) {
    picture.elements = elementsHere();
    return;
  }
  const uint64_t ran = *std::prev(after);
  if (heldPart_ != ran || heldNumber_ != picture.drawn.number) {
    past_->keep();
    held_ = past_->goTo(ran).empty() ? elementsHere() : std::vector<uint8_t>();
    (void)past_->goTo(here);
    heldPart_ = ran;
    heldNumber_ = picture.drawn.number;
  }
  picture.elements = held_;
  if (!held_.empty()) picture.ranLast = ran;
}

void PastSource::fill(Picture& picture, const std::set<std::string>& names) {
  const View& shown = view();
  picture.drawn = shown.drawn;
  picture.scan = past_->part();
  picture.us = nowUs();
  picture.state = state();
  picture.follows = running_;
  if (past_->instance().faulted()) picture.fault = past_->instance().faultText();
  fillElements(picture);
  for (const std::string& name : names)
    if (std::string value = valueOf(name); !value.empty()) picture.values.emplace(name, std::move(value));
  const auto after = std::ranges::upper_bound(messages_, past_->part(), {}, &Heard::scan);
  if (after != messages_.begin()) picture.messages = std::prev(after)->messages;
  picture.forces = forcedCells(shown.places);
  picture.firstScan = firstScan();
  picture.lastScan = past_->contents().parts;
}

} // namespace rung::web
