// The thread and the pages (see paced_source.h).
#include "tools/web/paced_source.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

#include "tools/report/place_names.h"
#include "tools/scenario/names.h"

namespace rung::web {
namespace {

using namespace std::chrono_literals;

constexpr auto kPictureEvery = 33ms;
constexpr auto kLookedAt = 5s; // what a page has not asked for so long is not followed
constexpr size_t kMostPages = 64;
constexpr size_t kMostTasks = 32;
constexpr auto kPatience = 20s; // for the program's thread to do a task

std::string numberOf(const nc::ShownMessage& message) {
  std::array<char, nc::kMessageNumber> text{};
  const size_t size = nc::putMessageNumber(message.number, message.channel, message.index, text);
  return {text.data(), size};
}

// A program may have been compiled without the texts of its messages.
std::string textOf(const nc::ShownMessage& message) { return message.text.empty() ? "(no text)" : message.text; }

std::string lineOf(const nc::ShownMessage& message) { return fmt::format("{} {}", numberOf(message), textOf(message)); }

} // namespace

// ---- the program's thread -------------------------------------------------------------------------------------------

void PacedSource::run(const std::function<bool()>& ended) {
  Clock::time_point due = Clock::now();
  Clock::time_point pictured{};
  bool changed = true;
  std::unique_lock lock(mutex_);
  while (!ended()) {
    changed = takeTasks(lock) || changed;
    lock.unlock();
    changed = look() || changed;
    lock.lock();
    if (running_ && Clock::now() >= due) {
      lock.unlock();
      const int64_t before = nowUs();
      running_ = nextScan();
      due += std::chrono::microseconds(std::max<int64_t>(nowUs() - before, 1000));
      due = std::max(due, Clock::now() - 200ms); // too slow for the clock: it takes its time
      changed = true;
      lock.lock();
    }
    const Clock::time_point now = Clock::now();
    const bool isDue = changed && !followers_.empty(); // otherwise no page looks
    if (stale_ || (isDue && now - pictured >= kPictureEvery)) {
      stale_ = changed = false;
      const std::set<std::string> names = followed();
      lock.unlock();
      publish(names);
      pictured = Clock::now();
      lock.lock();
      continue;
    }
    Clock::time_point until = now + lookEvery();
    if (running_) until = std::min(until, due);
    if (isDue) until = std::min(until, pictured + kPictureEvery);
    work_.wait_until(lock, until, [&] { return stale_ || !tasks_.empty(); });
  }
  ended_ = true;
  for (const Task& task : tasks_) task(false);
  tasks_.clear();
  news_.notify_all();
}

// Whether there was one.
bool PacedSource::takeTasks(std::unique_lock<std::mutex>& lock) {
  bool any = false;
  while (!tasks_.empty()) {
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task(true);
    lock.lock();
    any = true;
  }
  return any;
}

void PacedSource::publish(const std::set<std::string>& names) {
  auto made = std::make_shared<Picture>();
  fill(*made, names);
  made->mayWrite = mayWrite();
  const std::lock_guard lock(mutex_);
  made->revision = picture_ == nullptr ? 1 : picture_->revision + 1;
  made->lastEvent = lastEvent_;
  made->trigger = triggerText_;
  picture_ = std::move(made);
  news_.notify_all();
}

bool PacedSource::compareMessages(const runtime::Instance& instance, const nc::Control& control, uint64_t scan) {
  if (control.shows(instance, messages_)) return false;
  std::vector<nc::ShownMessage> now = control.messages(instance);
  const auto isIn = [](const std::vector<nc::ShownMessage>& list, const nc::ShownMessage& one) {
    return std::ranges::find(list, one) != list.end();
  };
  for (const nc::ShownMessage& one : messages_)
    if (!isIn(now, one)) log("gone", lineOf(one), scan, instance.nowUs());
  for (const nc::ShownMessage& one : now)
    if (!isIn(messages_, one)) log("message", lineOf(one), scan, instance.nowUs());
  messages_ = std::move(now);
  return true;
}

void PacedSource::log(std::string kind, std::string text, uint64_t scan, int64_t us) {
  const std::lock_guard lock(mutex_);
  if (events_.size() == kMostEvents) events_.pop_front();
  events_.push_back({++lastEvent_, scan, us, std::move(kind), std::move(text)});
}

std::vector<ShownMessage> messagesOf(const runtime::Instance& instance, const nc::Control& control) {
  std::vector<ShownMessage> shown;
  for (const nc::ShownMessage& one : control.messages(instance)) shown.push_back({numberOf(one), textOf(one)});
  return shown;
}

uint64_t scanFrom(uint64_t from, int64_t scans) {
  const auto count = static_cast<uint64_t>(scans);
  return scans < 0 ? from - std::min(from, uint64_t{0} - count) : from + count;
}

// ---- orders --------------------------------------------------------------------------------------------------------

// A task that is not done in time is done all the same: its promise belongs to it.
template <class T>
Result<T> PacedSource::hand(std::function<Result<T>()> act) {
  auto promise = std::make_shared<std::promise<Result<T>>>();
  std::future<Result<T>> done = promise->get_future();
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return failure("the program has ended");
    if (tasks_.size() == kMostTasks) return failure("too much has been asked for at the same time: try again");
    tasks_.push_back([promise, act = std::move(act)](bool runs) {
      promise->set_value(runs ? act() : Result<T>(failure("the program has ended")));
    });
  }
  work_.notify_all();
  if (done.wait_for(kPatience) != std::future_status::ready) return failure("the program's scan takes too long");
  return done.get();
}

Result<std::string> PacedSource::execute(const Order& order) {
  return hand<std::string>([this, order] { return carryOut(order); });
}

Result<Why> PacedSource::why(const std::string& name) {
  return hand<Why>([this, name] { return explain(name); });
}

Result<ScanTrace> PacedSource::trace(const std::vector<std::string>& names, uint64_t scans, uint64_t last) {
  return hand<ScanTrace>([this, names, scans, last] { return readTrace(names, scans, last); });
}

Result<Shares> PacedSource::shares(uint64_t scans) {
  return hand<Shares>([this, scans] { return readShares(scans); });
}

// Visits scans that have been, and comes to the same scan again. "" or why that is impossible.
template <class Visit>
std::string PacedSource::visit(uint64_t first, uint64_t last, Visit visitor) {
  const uint64_t here = shownScan();
  if (const auto there = seek(first); !there.ok()) return there.error();
  for (uint64_t scan = first; scan <= last; ++scan) {
    if (scan > first) (void)nextScan();
    visitor();
  }
  const auto back = seek(here);
  return back.ok() ? "" : back.error();
}

// The first of so many scans that end with `last`, as far as they can be shown.
uint64_t PacedSource::firstOf(uint64_t scans, uint64_t last) const {
  const uint64_t wanted = last > scans ? last - scans + 1 : 1;
  return std::max(wanted, std::min(firstScan(), last));
}

Result<ScanTrace> PacedSource::readTrace(const std::vector<std::string>& names, uint64_t scans, uint64_t last) {
  last = last == 0 ? shownScan() : std::min(last, lastScan());
  ScanTrace trace{firstOf(scans, last), std::vector<std::vector<std::string>>(names.size())};
  const std::string problem = visit(trace.firstScan, last, [&] {
    for (size_t i = 0; i < names.size(); ++i) trace.values[i].push_back(valueOf(names[i]));
  });
  if (!problem.empty()) return failure(problem);
  return trace;
}

Result<Shares> PacedSource::readShares(uint64_t scans) {
  const replay::Elements& elements = flowEngine().elements();
  Shares shares{firstOf(scans, shownScan()), shownScan(), {}};
  for (const replay::SourceRung& rung : elements.rungs()) shares.rungs.push_back({rung.number, 0, 0});
  const std::string problem = visit(shares.firstScan, shares.lastScan, [&] {
    const replay::Flow* flow = shownFlow();
    if (flow == nullptr || &flowEngine().elements() != &elements) return; // before another program took over
    const std::vector<uint32_t> times = flow->timesRun();
    for (size_t i = 0; i < times.size(); ++i) shares.rungs[i].runs += times[i];
    for (const replay::RungFlow& run : flow->runs())
      if (const uint32_t rung = elements.rungOf(run.lowered); rung != replay::kNone)
        shares.rungs[rung].operations += flowEngine().rung(run.lowered).ops.size();
  });
  if (!problem.empty()) return failure(problem);
  return shares;
}

// ---- trigger, messages ---------------------------------------------------------------------------------------------

Result<runtime::Ref> PacedSource::locate(std::string_view name) const {
  const rung_program& program = instance().program();
  if (const auto place = nc().readPlace(program, std::string(name))) return *place;
  return failure(scenario::unknownName(program, nc(), std::string(name)));
}

Result<std::string> PacedSource::setTrigger(const std::string& condition) {
  return hand<std::string>([this, condition] { return trigger(condition); });
}

Result<std::string> PacedSource::trigger(const std::string& condition) {
  std::optional<replay::Condition> parsed;
  if (!condition.empty()) {
    auto read = replay::Condition::parse(condition, [this](std::string_view name) { return locate(name); });
    if (!read.ok()) return read.failure();
    parsed = std::move(read).value();
  }
  trigger_ = std::move(parsed);
  {
    const std::lock_guard lock(mutex_);
    triggerText_ = condition;
  }
  if (!trigger_) return std::string("no trigger");
  searchPast(*trigger_, condition); // which may end in another program
  triggerProgram_ = nullptr;
  // In the past it is not known whether it holds in the newest scan: then it is taken as holding.
  triggerHeld_ = shownScan() < lastScan() || triggerHolds();
  return "looking for: " + condition;
}

// A program that lacks one of its names does not fulfil it.
bool PacedSource::triggerHolds() {
  if (const rung_program* now = &instance().program(); std::exchange(triggerProgram_, now) != now)
    triggerKnown_ = trigger_->locate([this](std::string_view name) { return locate(name); }).empty();
  return triggerKnown_ && trigger_->holds(instance().memory());
}

void PacedSource::checkTrigger() {
  if (!trigger_) return;
  const bool held = std::exchange(triggerHeld_, triggerHolds());
  if (triggerHeld_ && !held) log("trigger", triggerText_, shownScan(), nowUs());
}

Result<std::string> PacedSource::acknowledge() {
  return hand<std::string>([this]() -> Result<std::string> {
    if (shownScan() < lastScan()) return failure("this is the past: go to the newest scan first");
    if (messages_.empty()) return failure("no message is shown");
    for (const nc::ShownMessage& one : messages_) log("acknowledged", lineOf(one), lastScan(), nowUs());
    return fmt::format("{} acknowledged", messages_.size());
  });
}

// ---- forces --------------------------------------------------------------------------------------------------------

std::vector<ForcedCell> PacedSource::forcedCells(const NamePlaces& places) const {
  std::vector<ForcedCell> cells = places.forced(instance());
  for (ForcedCell& cell : cells) cell.value = valueOf(cell.name);
  return cells;
}

// ---- pages ---------------------------------------------------------------------------------------------------------

std::set<std::string> PacedSource::followed() {
  std::set<std::string> names;
  std::erase_if(followers_, [&](const auto& one) { return Clock::now() - one.second.asked > kLookedAt; });
  for (const auto& [page, follower] : followers_) names.insert(follower.names.begin(), follower.names.end());
  return names;
}

std::shared_ptr<const Picture> PacedSource::picture(const std::string& page, const std::vector<std::string>& names,
                                                    uint64_t after, std::chrono::milliseconds wait) {
  std::unique_lock lock(mutex_);
  if (followers_.size() >= kMostPages && !followers_.contains(page)) (void)followed();
  if (followers_.size() < kMostPages || followers_.contains(page)) {
    const auto [at, isNew] = followers_.try_emplace(page);
    Follower& follower = at->second;
    follower.asked = Clock::now();
    if (isNew || follower.names != names) {
      follower.names = names;
      stale_ = true;
      work_.notify_all();
    }
  }
  const auto isNewer = [&] { return ended_ || (!stale_ && picture_ != nullptr && picture_->revision > after); };
  news_.wait_for(lock, wait, isNewer);
  return picture_;
}

Drawn PacedSource::drawn() {
  const std::lock_guard lock(mutex_);
  return picture_ == nullptr ? drawn_ : picture_->drawn;
}

std::vector<Event> PacedSource::events(uint64_t after) {
  const std::lock_guard lock(mutex_);
  std::vector<Event> found;
  for (const Event& event : events_)
    if (event.number > after) found.push_back(event);
  return found;
}

// ---- names ---------------------------------------------------------------------------------------------------------

NamePlaces::NamePlaces(const ShownProgram& program, const runtime::Instance& instance, const sim::SimulatedNc& nc,
                       ElementStates& states) {
  const rung_program& running = instance.program();
  for (const view::NameTable& table : program.tables())
    for (const view::NameRow& row : table.rows)
      if (!row.name.empty() && !row.constant && !table.texts)
        if (const auto place = nc.readPlace(running, row.name))
          names_.push_back({*place, report::bitsOf(*place), &row});
  std::ranges::stable_sort(names_, std::ranges::greater(), [](const Named& one) { return one.bits.count; });
  for (const ShownProgram::Contact& contact : program.contacts())
    if (const auto place = nc.readPlace(running, contact.name); place && states.isConstant(report::bitsOf(*place)))
      states.setConstant(contact.element, (instance.read(*place) != 0) != contact.negated);
}

std::vector<uint32_t> NamePlaces::at(const ir::BitRange& place) const {
  std::vector<uint32_t> rows;
  for (const Named& one : names_)
    if (ir::overlap(one.bits, place)) rows.push_back(one.row->id);
  return rows;
}

namespace {

using HeldBytes = std::map<uint32_t, uint8_t>; // bits, by offset in the block

bool isHeld(const HeldBytes& held, const core::Place& place) {
  if (place.outside() || place.apart()) return false;
  for (uint32_t i = 0; i < 8; ++i) {
    const auto bits = static_cast<uint8_t>(place.mask >> (8 * i));
    if (bits == 0) continue;
    const auto at = held.find(place.window + i);
    if (at == held.end() || (at->second & bits) != bits) return false;
  }
  return true;
}

bool contains(const ir::BitRange& whole, const ir::BitRange& part) {
  return whole.space == part.space && whole.first <= part.first && part.first + part.count <= whole.first + whole.count;
}

} // namespace

std::vector<ForcedCell> NamePlaces::forced(const runtime::Instance& instance) const {
  std::vector<ForcedCell> cells;
  if (!instance.forced()) return cells;
  HeldBytes held;
  for (const core::ForcedBits& bits : instance.forcedBits()) held[bits.offset] |= bits.mask;
  std::vector<ir::BitRange> found; // by cell
  for (const Named& one : names_) {
    if (!isHeld(held, runtime::locate(instance.memory(), one.place))) continue;
    const auto whole = std::ranges::find_if(found, [&](const ir::BitRange& of) { return contains(of, one.bits); });
    if (whole == found.end()) {
      found.push_back(one.bits);
      cells.push_back({one.row->name, {}, {one.row->id}});
    } else {
      cells[static_cast<size_t>(whole - found.begin())].rows.push_back(one.row->id);
    }
  }
  return cells;
}

} // namespace rung::web
