// One engine's run.
#include "tools/scenario/engine_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "rtlib/nc/control/control.h"
#include "tools/scenario/words.h"

namespace rung::scenario {

namespace {

constexpr ptrdiff_t kMostUnread = 50'000; // most log entries; a session of hours must not fill the memory

// A shared object counts as JIT code, whichever engine made it.
compiler::EngineKind kindOf(const runtime::Engine& engine) {
  return compiler::engineFromName(engine.name()).value_or(compiler::EngineKind::Jit);
}

std::unique_ptr<sim::SimulatedNc> makeNc(const runtime::Engine& engine, bool recorded) {
  if (recorded) return std::make_unique<RecordedNc>(engine.program().dialect);
  return sim::makeSimulatedNc(engine.program().dialect);
}

void serveWith(rung::Image& image, const runtime::Engine& engine, const compiler::GetCompiled& compiled) {
  if (compiled) check(compiler::serveImage(image.handle(), compiled, kindOf(engine), {}));
}

} // namespace

EngineRun::EngineRun(runtime::Engine& engine, std::string folder, sim::Clock clock, bool controlRecorded)
    : engine_(&engine), machine_(engine.program(), engine.context(), makeNc(engine, controlRecorded), clock) {
  recordedNc_ = dynamic_cast<RecordedNc*>(&nc());
  nc().setFolder(std::move(folder));
  nc().setAnswers(&requests_);
  requests_.report(nc());
}

void EngineRun::serve(const compiler::GetCompiled& compiled) { serveWith(machine_.image(), *engine_, compiled); }

void EngineRun::powerOn(nc::PowerOn kind) {
  machine_.powerOn(kind);
  takeLog();
  unreadLog_.clear();
  requests_.clear();
}

std::string EngineRun::replace(runtime::Engine& next, const compiler::GetCompiled& compiled,
                               ReplaceReport& report) try {
  const rung_program& former = instance().program();
  rung::Image image = rung::Image::adopt(next.program(), next.context());
  serveWith(image, next, compiled);
  rung::Replacement replacement(machine_.instance(), image);
  replacement.allowLate(); // a scenario's clock waits for the replacement
  ReplaceReport planned(replacement);
  requests_.take(instance());
  if (check(rung_instance_replace(machine_.instance().handle(), replacement.handle())) == RUNG_LATER)
    return rung_error_text();
  engine_ = &next;
  machine_.setImage(std::move(image));
  requests_.programChanged(instance(), sim::Relocation(former, instance().program()));
  report = std::move(planned);
  return {};
} catch (const rung::Error& error) {
  return error.what();
}

std::optional<EngineRun::Snapshot> EngineRun::snapshot() {
  requests_.take(instance());
  std::optional<std::vector<uint8_t>> state = machine_.instance().save();
  if (!state) return std::nullopt;
  return Snapshot{std::move(*state), requests_, unreadLog_};
}

void EngineRun::restore(const Snapshot& snapshot) {
  machine_.instance().load(snapshot.state);
  takeLog();
  requests_.restore(instance(), snapshot.requests);
  unreadLog_ = snapshot.unreadLog;
}

void EngineRun::advance(Advance how) {
  (machine_.*how)();
  takeLog();
}

void EngineRun::takeLog() {
  for (std::string& line : nc().takeLog()) unreadLog_.push_back(std::move(line));
  if (std::ssize(unreadLog_) > 2 * kMostUnread) unreadLog_.erase(unreadLog_.begin(), unreadLog_.end() - kMostUnread);
}

void EngineRun::ignore() {
  core::ServiceRequest request;
  while (instance().services().take(request)) instance().services().complete(nc().control().refuse(request));
  unreadLog_.clear();
}

// The report of a replacement.

namespace {

constexpr size_t kListed = 8; // most changes in a message
constexpr char kCutNote[] = ": its new place has no room for all its contents, the rest is lost";

std::string counted(uint32_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

bool same(const runtime::StateChange& a, const runtime::StateChange& b) {
  return a.kind == b.kind && a.slot == b.slot && a.name == b.name && a.formerName == b.formerName;
}

std::string listOf(const std::vector<runtime::StateChange>& changes) {
  if (changes.empty()) return "none";
  std::string list;
  for (size_t i = 0; i < std::min(changes.size(), kListed); ++i) list += (i == 0 ? "" : ", ") + textOf(changes[i]);
  if (changes.size() > kListed) list += fmt::format(" and {} more", changes.size() - kListed);
  return list;
}

} // namespace

std::optional<runtime::ChangeKind> changeKindFromName(std::string_view name) {
  const auto* found = std::ranges::find(runtime::kChangeKinds, name);
  if (found == std::end(runtime::kChangeKinds)) return std::nullopt;
  return static_cast<runtime::ChangeKind>(found - std::begin(runtime::kChangeKinds));
}

std::string textOf(const runtime::StateChange& change) {
  std::string text(runtime::kChangeKinds[static_cast<size_t>(change.kind)]);
  if (change.slot) text.append(" ").append(kStateWord);
  if (change.kind == runtime::ChangeKind::Renamed) text += " " + asWord(change.formerName);
  return text + " " + asWord(change.name);
}

ReplaceReport::ReplaceReport(const rung::Replacement& replacement) {
  const rung_replacement_info info = replacement.report();
  keptCells = info.kept_cells;
  keptStates = info.kept_states;
  bound = info.bound;
  for (const rung_change& change : replacement.changes())
    changes.push_back(
        {static_cast<runtime::ChangeKind>(change.kind), change.is_state != 0, change.name, change.former});
}

std::string ReplaceReport::take(const runtime::StateChange& change) {
  const auto found =
      std::ranges::find_if(changes, [&](const runtime::StateChange& other) { return same(change, other); });
  if (found == changes.end())
    return fmt::format("the report does not contain: {}; it contains: {}", textOf(change), listOf(changes));
  changes.erase(found);
  return {};
}

std::string ReplaceReport::expectNone() const {
  return changes.empty() ? std::string() : "there are changes that no expect_change names: " + listOf(changes);
}

std::vector<std::string> ReplaceReport::lines() const {
  std::vector<std::string> lines = {
      fmt::format("kept {} and {}", counted(keptCells, "variable"), counted(keptStates, "internal state"))};
  for (const runtime::StateChange& change : changes)
    lines.push_back(textOf(change) + (change.kind == runtime::ChangeKind::Cut ? kCutNote : ""));
  lines.push_back("a slice may last " + bound);
  return lines;
}

} // namespace rung::scenario
