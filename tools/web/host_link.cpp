// See host_link.h.
#include "tools/web/host_link.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>

#include <nlohmann/json.hpp>

#include "machine/rung-compile/collect.h"

namespace rung::web {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr auto kPatience = 3s;       // for an answer
constexpr auto kForcePatience = 70s; // the host may have to compile code
constexpr auto kAskEvery = 400ms;
constexpr auto kConnectEvery = 500ms;

std::string mayWriteOf(const json& map, const std::string& host) {
  for (const json& right : map.value("permissions", json::array()))
    if (right == "set" || right == "force" || right == "reload") return {};
  return fmt::format(
      "{} lets no client write; [rungctl] permissions = [\"set\", \"force\"] in its mapping file allows it", host);
}

std::string shown(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

json requestOf(const Order& order) {
  switch (order.kind) {
  case Order::Kind::Set: return {{"do", "set"}, {"name", order.name}, {"value", control::writtenValue(order.value)}};
  case Order::Kind::Force:
    return {{"do", "force"}, {"name", order.name}, {"value", control::writtenValue(order.value)}};
  case Order::Kind::Unforce:
    return order.name.empty() ? json{{"do", "unforce"}, {"all", true}} : json{{"do", "unforce"}, {"name", order.name}};
  case Order::Kind::Mark: return {{"do", "mark"}, {"text", order.name}};
  case Order::Kind::Run:
  case Order::Kind::Pause:
  case Order::Kind::Step:
  case Order::Kind::Seek:
  case Order::Kind::Reload: // several requests
  case Order::Kind::Statement: break;
  }
  return nullptr;
}

std::string doneOf(const Order& order, const json& answer) {
  std::string text;
  if (order.kind == Order::Kind::Set)
    text = fmt::format("{} = {} (was {})", order.name, shown(answer["value"]), shown(answer["former"]));
  if (order.kind == Order::Kind::Force) text = fmt::format("{} is forced to {}", order.name, shown(answer["value"]));
  if (order.kind == Order::Kind::Unforce) {
    for (const json& name : answer.value("names", json::array()))
      text += fmt::format("{}{}", text.empty() ? "" : ", ", shown(name));
    text = text.empty() ? "nothing was forced" : "no longer forced: " + text;
  }
  if (order.kind == Order::Kind::Mark) text = "marked";
  if (answer.contains("note")) text += "; " + shown(answer["note"]);
  return text;
}

} // namespace

HostLink::HostLink(std::string host, std::vector<std::string> files)
    : host_(std::move(host)), files_(std::move(files)), thread_([this] { run(); }) {}

HostLink::~HostLink() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

HostState HostLink::state() {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::vector<HostEntry> HostLink::takeEntries() {
  const std::lock_guard lock(mutex_);
  return std::exchange(entries_, {});
}

// ---- the thread --------------------------------------------------------------------------------------------------

void HostLink::run() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    lock.unlock();
    try {
      serve();
    } catch (const std::exception& problem) {
      lost(problem.what());
    }
    lock.lock();
    wake_.wait_for(lock, kConnectEvery, [this] { return ends_; });
  }
}

void HostLink::lost(const std::string& why) {
  const std::lock_guard lock(mutex_);
  state_.reached = false;
  state_.problem = why;
}

// Until the host ends, by an exception.
void HostLink::serve() {
  control::Client client(host_, kPatience);
  const json map = control::asked(client, {{"do", "map"}}, kPatience);
  const json log = control::asked(client, {{"do", "log"}, {"follow", true}}, kPatience);
  for (const json& entry : log.value("entries", json::array())) takeLog(entry);
  {
    const std::lock_guard lock(mutex_);
    state_.mayWrite = mayWriteOf(map, host_);
  }
  for (;;) {
    ask(client);
    const auto until = std::chrono::steady_clock::now() + kAskEvery;
    for (auto left = kAskEvery; left > 0ms;
         left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now())) {
      if (const std::optional<json> event = client.event(std::min(left, std::chrono::milliseconds(100))))
        if (event->value("event", "") == "log") takeLog((*event)["entry"]);
      const std::lock_guard lock(mutex_);
      if (ends_) return;
    }
  }
}

// `follow` makes the host write what it records at once, for two seconds.
void HostLink::ask(control::Client& client) {
  const json recording = client.ask({{"do", "recording"}, {"follow", true}}, kPatience);
  const json status = control::asked(client, {{"do", "status"}}, kPatience);
  const std::lock_guard lock(mutex_);
  state_.reached = true;
  state_.problem = recording.value("ok", false) ? recording.value("problem", "") : recording.value("error", "");
  state_.folder = recording.value("folder", "");
  state_.stopped = status.value("stopped", false);
  state_.fault = status.value("fault", "");
}

// Messages, faults and marks are in the recording, with their scans.
void HostLink::takeLog(const json& entry) {
  constexpr int64_t kUs = 1'000'000;
  constexpr std::array<std::string_view, 4> kRecorded = {"message", "note", "fault", "mark"};
  const std::string kind = entry.value("kind", "");
  const std::pair<int64_t, uint64_t> key{entry.value("came", int64_t{0}), entry.value("n", uint64_t{0})};
  const std::lock_guard lock(mutex_);
  if (key <= lastEntry_ || std::ranges::find(kRecorded, kind) != kRecorded.end()) return;
  lastEntry_ = key;
  std::string text = entry.value("text", "");
  if (const auto by = entry.find("by"); by != entry.end()) text += fmt::format(" (by {})", by->value("name", ""));
  entries_.push_back({key.first * kUs, kind, std::move(text)});
}

// ---- writing -----------------------------------------------------------------------------------------------------

// The sources as they are now, which the host compiles.
Result<std::string> HostLink::reload(control::Client& client) const {
  const volatile int goesOn = 0;
  std::vector<std::string> files = files_;
  if (files.empty()) files = control::asked(client, {{"do", "program"}})["files"].get<std::vector<std::string>>();
  const rung_compile::Collected collected = rung_compile::collect(files);
  if (!collected.sources) return failure(collected.report);
  const json compiled = control::compiledByHost(client, packed(*collected.sources), goesOn);
  if (compiled.value("state", "") != "compiled")
    return failure(compiled.value("report", "the host cannot compile them"));
  const json answer = client.ask({{"do", "reload"}, {"compiled", true}});
  if (answer.value("ok", false)) return control::whetherItRuns(answer, "new");
  return failure(answer.value("error", "the host refuses") + "; nothing has changed" +
                 (answer.contains("needs") ? "; `rungctl reload` lists what would be lost" : ""));
}

Result<std::string> HostLink::write(const Order& order) {
  const json request = requestOf(order);
  const bool isReload = order.kind == Order::Kind::Reload;
  if (request.is_null() && !isReload) return failure("a machine takes no statements of scenarios");
  const std::lock_guard lock(writing_);
  for (const bool isAgain : {false, true}) {
    const bool isOld = writer_ != nullptr;
    try {
      if (!isOld) writer_ = std::make_unique<control::Client>(host_, kPatience);
      if (isReload) return reload(*writer_);
      const json answer = writer_->ask(request, kForcePatience);
      if (!answer.value("ok", false)) return failure(answer.value("error", "the host refuses"));
      return doneOf(order, answer);
    } catch (const std::exception& problem) {
      writer_.reset();
      if (!isOld || isAgain) return failure(problem.what()); // otherwise the host may have been started again
    }
  }
  return failure("the host does not answer");
}

} // namespace rung::web
