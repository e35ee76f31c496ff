// The thread and the pages (see paced_source.h).
#include "tools/web/paced_source.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

#include "tools/report/place_names.h"

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
    if (!isIn(now, one)) log("gone", fmt::format("{} {}", numberOf(one), one.text), scan, instance.nowUs());
  for (const nc::ShownMessage& one : now)
    if (!isIn(messages_, one)) log("message", fmt::format("{} {}", numberOf(one), one.text), scan, instance.nowUs());
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
  for (const nc::ShownMessage& one : control.messages(instance)) shown.push_back({numberOf(one), one.text});
  return shown;
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

Result<ScanTrace> PacedSource::trace(const std::vector<std::string>& names, uint64_t scans) {
  return hand<ScanTrace>([this, names, scans] { return readTrace(names, scans); });
}

// Goes back and comes to the same scan again.
Result<ScanTrace> PacedSource::readTrace(const std::vector<std::string>& names, uint64_t scans) {
  const uint64_t here = shownScan();
  const uint64_t wanted = here > scans ? here - scans + 1 : 1;
  ScanTrace trace{std::max(wanted, std::min(firstScan(), here)), std::vector<std::vector<std::string>>(names.size())};
  if (const auto there = seek(trace.firstScan); !there.ok()) return there.failure();
  for (uint64_t scan = trace.firstScan; scan <= here; ++scan) {
    if (scan > trace.firstScan) (void)nextScan();
    for (size_t i = 0; i < names.size(); ++i) trace.values[i].push_back(valueOf(names[i]));
  }
  if (const auto back = seek(here); !back.ok()) return back.failure();
  return trace;
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
        if (const auto place = nc.readPlace(running, row.name)) places_.emplace_back(report::bitsOf(*place), row.id);
  for (const ShownProgram::Contact& contact : program.contacts())
    if (const auto place = nc.readPlace(running, contact.name); place && !states.shows(contact.element))
      states.setConstant(contact.element, (instance.read(*place) != 0) != contact.negated);
}

std::vector<uint32_t> NamePlaces::at(const ir::BitRange& place) const {
  std::vector<uint32_t> rows;
  for (const auto& [of, row] : places_)
    if (ir::overlap(of, place)) rows.push_back(row);
  return rows;
}

} // namespace rung::web
