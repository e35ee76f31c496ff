// Runs the session and makes pictures of it (see session_source.h).
#include "tools/web/session_source.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

#include "tools/report/place_names.h"
#include "tools/scenario/names.h"
#include "tools/scenario/statements.h"
#include "tools/scenario/values.h"
#include "tools/scenario/words.h"

namespace rung::web {
namespace {

using namespace std::chrono_literals;

constexpr auto kPictureEvery = 33ms;
constexpr auto kLookedAt = 5s; // what a page has not asked for so long is not followed
constexpr size_t kMostPages = 64;
constexpr size_t kMostTasks = 32;
constexpr auto kPatience = 20s;             // for the program's thread to do a task
constexpr int64_t kMomentEveryUs = 500'000; // on the program's clock
constexpr size_t kMostMoments = 600;

std::string numberOf(const nc::ShownMessage& message) {
  std::array<char, nc::kMessageNumber> text{};
  const size_t size = nc::putMessageNumber(message.number, message.channel, message.index, text);
  return {text.data(), size};
}

} // namespace

SessionSource::SessionSource(scenario::Session& session, const scenario::Explainer& explainer,
                             const ShownProgram& program, FlowObserver& flow)
    : session_(session), explainer_(explainer), flow_(flow) {
  const rung_program& running = session.instance().program();
  for (const view::NameTable& table : program.tables())
    for (const view::NameRow& row : table.rows)
      if (!row.name.empty() && !row.constant && !table.texts)
        if (const auto place = session.nc().readPlace(running, row.name))
          places_.emplace_back(report::bitsOf(*place), row.id);
  for (const ShownProgram::Contact& contact : program.contacts())
    if (const auto place = session.nc().readPlace(running, contact.name); place && !flow.shows(contact.element))
      flow.setConstant(contact.element, (session.instance().read(*place) != 0) != contact.negated);
}

// ---- the program's thread -------------------------------------------------------------------------------------------

void SessionSource::run(const std::function<bool()>& ended) {
  Clock::time_point due = Clock::now();
  Clock::time_point pictured{};
  keepMoment();
  bool changed = true;
  std::unique_lock lock(mutex_);
  while (!ended()) {
    changed = takeTasks(lock) || changed;
    if (running_ && Clock::now() >= due) {
      lock.unlock();
      const int64_t before = session_.nowUs();
      oneScan();
      due += std::chrono::microseconds(std::max<int64_t>(session_.nowUs() - before, 1000));
      due = std::max(due, Clock::now() - 200ms); // too slow for the clock: it takes its time
      changed = true;
      lock.lock();
    }
    const Clock::time_point now = Clock::now();
    if (stale_ || (changed && now - pictured >= kPictureEvery)) {
      stale_ = changed = false;
      const std::set<std::string> names = followed();
      lock.unlock();
      publish(names);
      pictured = Clock::now();
      lock.lock();
      continue;
    }
    Clock::time_point until = now + 100ms;
    if (running_) until = std::min(until, due);
    if (changed) until = std::min(until, pictured + kPictureEvery);
    work_.wait_until(lock, until, [&] { return stale_ || !tasks_.empty(); });
  }
  ended_ = true;
  for (Task& task : tasks_) task.done.set_value(failure("the program has ended"));
  tasks_.clear();
  news_.notify_all();
}

// Whether there was one.
bool SessionSource::takeTasks(std::unique_lock<std::mutex>& lock) {
  bool any = false;
  while (!tasks_.empty()) {
    Task task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task.done.set_value(task.act());
    lock.lock();
    any = true;
  }
  return any;
}

std::string SessionSource::statement(const std::string& line) {
  const scenario::ParsedLine parsed = scenario::parseLine(line);
  if (!parsed.statement) return parsed.problem;
  const auto problem = session_.execute(*parsed.statement);
  return problem ? problem->message : "";
}

void SessionSource::oneScan() {
  flow_.beginScan();
  const std::string problem = statement("scan");
  ++scan_;
  const bool isNew = scan_ > last_;
  last_ = std::max(last_, scan_);
  if (!isNew) return;
  if (!problem.empty()) log("fault", problem);
  compareMessages();
  if (session_.instance().faulted() && !std::exchange(faulted_, true)) log("fault", session_.instance().faultText());
  if (moments_.empty() || session_.nowUs() - moments_.back().us >= kMomentEveryUs) keepMoment();
}

// A program that has stopped within a scan cannot be continued: then there is no moment.
void SessionSource::keepMoment() {
  Moment moment{scan_, session_.nowUs(), done_.size(), {}};
  if (moments_.size() == kMostMoments) {
    moment.name = std::move(moments_.front().name);
    moments_.pop_front();
  } else {
    moment.name = fmt::format("web-{}", moments_.size());
  }
  if (statement("snapshot " + moment.name).empty()) moments_.push_back(std::move(moment));
}

// Back to a moment before the scan, and forwards again with what was done meanwhile, so that its flow is seen again.
Result<std::string> SessionSource::seek(uint64_t scan) {
  if (moments_.empty()) return failure("the program has not kept a moment to which it could go back");
  scan = std::clamp(scan, std::min(moments_.front().scan + 1, last_), last_);
  if (scan == scan_) return fmt::format("scan {}", scan);
  const auto after = std::ranges::lower_bound(moments_, scan, {}, &Moment::scan);
  const Moment& from = after == moments_.begin() ? *after : *std::prev(after);
  if (from.scan > scan_ || scan < scan_) {
    if (const std::string problem = statement("restore " + from.name); !problem.empty()) return failure(problem);
    scan_ = from.scan;
    nextDone_ = from.statements;
  }
  while (scan_ < scan) {
    repeat();
    oneScan();
  }
  if (scan_ == last_) repeat();
  return fmt::format("scan {}", scan);
}

// What was executed before the next scan.
void SessionSource::repeat() {
  for (; nextDone_ < done_.size() && done_[nextDone_].scan == scan_; ++nextDone_)
    (void)statement(done_[nextDone_].line);
}

void SessionSource::compareMessages() {
  const auto& control = session_.nc().control();
  if (control.shows(session_.instance(), messages_)) return;
  std::vector<nc::ShownMessage> now = control.messages(session_.instance());
  const auto isIn = [](const std::vector<nc::ShownMessage>& list, const nc::ShownMessage& one) {
    return std::ranges::find(list, one) != list.end();
  };
  for (const nc::ShownMessage& one : messages_)
    if (!isIn(now, one)) log("gone", fmt::format("{} {}", numberOf(one), one.text));
  for (const nc::ShownMessage& one : now)
    if (!isIn(messages_, one)) log("message", fmt::format("{} {}", numberOf(one), one.text));
  messages_ = std::move(now);
}

void SessionSource::log(std::string kind, std::string text) {
  const std::lock_guard lock(mutex_);
  if (events_.size() == kMostEvents) events_.pop_front();
  events_.push_back({++lastEvent_, scan_, session_.nowUs(), std::move(kind), std::move(text)});
}

std::vector<ForcedCell> SessionSource::forces() {
  std::vector<ForcedCell> cells;
  for (const auto& [name, value] : session_.forces()) {
    ForcedCell& cell = cells.emplace_back(ForcedCell{name, value.text, {}});
    const auto place = session_.nc().readPlace(session_.instance().program(), name);
    if (!place) continue;
    const ir::BitRange bits = report::bitsOf(*place);
    for (const auto& [of, row] : places_)
      if (ir::overlap(of, bits)) cell.rows.push_back(row);
  }
  return cells;
}

void SessionSource::publish(const std::set<std::string>& names) {
  auto made = std::make_shared<Picture>();
  made->scan = scan_;
  made->us = session_.nowUs();
  const bool faulted = session_.instance().faulted();
  made->state = scan_ < last_ ? RunState::Past
                : faulted     ? RunState::Fault
                : running_    ? RunState::Running
                              : RunState::Paused;
  if (faulted) made->fault = session_.instance().faultText();
  made->elements = flow_.states();
  for (const std::string& name : names) {
    const Result<scenario::Reading> reading = scenario::readName(session_.instance(), session_.nc(), name, false);
    if (reading.ok()) made->values.emplace(name, scenario::showShort(reading.value()));
  }
  for (const nc::ShownMessage& one : session_.nc().control().messages(session_.instance()))
    made->messages.push_back({numberOf(one), one.text});
  made->forces = forces();
  made->firstScan = moments_.empty() ? scan_ : std::min(moments_.front().scan + 1, last_);
  made->lastScan = last_;
  const std::lock_guard lock(mutex_);
  made->revision = picture_ == nullptr ? 1 : picture_->revision + 1;
  made->lastEvent = lastEvent_;
  picture_ = std::move(made);
  news_.notify_all();
}

// ---- orders --------------------------------------------------------------------------------------------------------

Result<std::string> SessionSource::hand(std::function<Result<std::string>()> act) {
  std::future<Result<std::string>> done;
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return failure("the program has ended");
    if (tasks_.size() == kMostTasks) return failure("too much has been asked for at the same time: try again");
    Task& task = tasks_.emplace_back(Task{std::move(act), {}});
    done = task.done.get_future();
  }
  work_.notify_all();
  if (done.wait_for(kPatience) != std::future_status::ready) return failure("the program's scan takes too long");
  return done.get();
}

Result<std::string> SessionSource::execute(const Order& order) {
  return hand([this, order] { return carryOut(order); });
}

Result<std::string> SessionSource::write(const std::string& line, const char* kind) {
  if (scan_ < last_) return failure("this is the past: nothing can be written there; go to the newest scan first");
  const scenario::ParsedLine parsed = scenario::parseLine(line);
  if (!parsed.statement) return failure(parsed.problem);
  if (const std::string problem = statement(line); !problem.empty()) return failure(problem);
  done_.push_back({scan_, line});
  nextDone_ = done_.size();
  log(kind, line);
  return line;
}

Result<std::string> SessionSource::carryOut(const Order& order) {
  const auto word = [](const std::string& text) { return scenario::asWord(text); };
  switch (order.kind) {
  case Order::Kind::Run: {
    const Result<std::string> there = seek(last_);
    if (there.ok()) running_ = true;
    return there.ok() ? Result<std::string>("running") : there;
  }
  case Order::Kind::Pause: running_ = false; return std::string("paused");
  case Order::Kind::Step:
    running_ = false;
    if (order.scans > 0 && scan_ == last_) {
      for (int64_t i = 0; i < std::min<int64_t>(order.scans, 10'000); ++i) oneScan();
      return fmt::format("scan {}", scan_);
    }
    return seek(order.scans < 0 && scan_ < static_cast<uint64_t>(-order.scans)
                    ? 0
                    : scan_ + static_cast<uint64_t>(order.scans));
  case Order::Kind::Seek: running_ = false; return seek(order.scans < 0 ? 0 : static_cast<uint64_t>(order.scans));
  case Order::Kind::Set: return write(fmt::format("set {} {}", word(order.name), word(order.value)), "set");
  case Order::Kind::Force: return write(fmt::format("force {} {}", word(order.name), word(order.value)), "force");
  case Order::Kind::Unforce:
    return write(order.name.empty() ? "unforce" : fmt::format("unforce {}", word(order.name)), "force");
  case Order::Kind::Statement: return write(order.name, "statement");
  }
  return failure("an unknown order");
}

Result<std::string> SessionSource::why(const std::string& name) {
  return hand([this, name]() -> Result<std::string> {
    const Result<scenario::Reading> reading = scenario::readName(session_.instance(), session_.nc(), name, false);
    if (!reading.ok()) return reading.failure();
    return fmt::format("{} = {}{}", name, scenario::show(reading.value()), explainer_.why(name));
  });
}

// ---- pages ---------------------------------------------------------------------------------------------------------

std::set<std::string> SessionSource::followed() {
  std::set<std::string> names;
  std::erase_if(followers_, [&](const auto& one) { return Clock::now() - one.second.asked > kLookedAt; });
  for (const auto& [page, follower] : followers_) names.insert(follower.names.begin(), follower.names.end());
  return names;
}

std::shared_ptr<const Picture> SessionSource::picture(const std::string& page, const std::vector<std::string>& names,
                                                      uint64_t after, std::chrono::milliseconds wait) {
  std::unique_lock lock(mutex_);
  if (followers_.size() >= kMostPages && !followers_.contains(page)) (void)followed();
  if (followers_.size() < kMostPages || followers_.contains(page)) {
    Follower& follower = followers_[page];
    follower.asked = Clock::now();
    if (follower.names != names) {
      follower.names = names;
      stale_ = true;
      work_.notify_all();
    }
  }
  const auto isNewer = [&] { return ended_ || (!stale_ && picture_ != nullptr && picture_->revision > after); };
  news_.wait_for(lock, wait, isNewer);
  return picture_;
}

std::vector<Event> SessionSource::events(uint64_t after) {
  const std::lock_guard lock(mutex_);
  std::vector<Event> found;
  for (const Event& event : events_)
    if (event.number > after) found.push_back(event);
  return found;
}

} // namespace rung::web
