// Follows the machine (see machine_source.h).
#include "tools/web/machine_source.h"

#include <fmt/format.h>
#include <utility>

namespace rung::web {
namespace {

using namespace std::chrono_literals;

// How often what the host writes is looked for: while it is shown, and while an earlier scan is.
constexpr auto kLookNow = 8ms, kLookPast = 100ms;
constexpr auto kListenPast = 500ms;

} // namespace

MachineSource::MachineSource(HostLink& link, replay::Followed followed, std::shared_ptr<const ShownProgram> program,
                             Draw draw)
    : PastSource(*followed.past, std::move(program), std::move(draw)), link_(link), followed_(std::move(followed)),
      knownProblems_(followed_.files->recording().problems.size()) {}

Result<std::string> MachineSource::execute(const Order& order) {
  return order.kind < Order::Kind::Set ? PastSource::execute(order) : link_.write(order);
}

// ---- what is new -------------------------------------------------------------------------------------------------

bool MachineSource::takeHost() {
  HostState now = link_.state();
  for (HostEntry& entry : link_.takeEntries()) {
    const replay::Contents& contents = past().contents();
    logLater(contents.partAt(followed_.files->recording(), entry.wallUs), std::move(entry.kind), std::move(entry.text));
  }
  if (now == host_) return false;
  host_ = std::move(now);
  return true;
}

// After its start a host may record elsewhere.
void MachineSource::takeFolder() {
  if (folder_.empty()) folder_ = host_.folder;
  if (!host_.reached || host_.folder.empty() || host_.folder == folder_) return;
  Result<replay::Followed> other = replay::follow(host_.folder);
  if (!other.ok()) return; // nothing is there yet
  folder_ = host_.folder;
  show(*other.value().past);
  followed_ = std::move(other).value();
  knownProblems_ = followed_.files->recording().problems.size();
}

bool MachineSource::look() {
  bool changed = takeHost();
  takeFolder();
  changed = followed_.take() || changed;
  const uint64_t here = past().part();
  const auto now = std::chrono::steady_clock::now();
  if (follows_ || now - heardAt_ >= kListenPast) {
    heardAt_ = now;
    const bool heard = listen();
    if (heard && past().part() != past().contents().parts) past().keep();
    changed = changed || heard;
  }
  if (follows_)
    goToNewest();
  else
    (void)past().goTo(here);
  return changed;
}

// What cannot be played ends at the next whole state.
void MachineSource::goToNewest() {
  const uint64_t lastState = past().contents().states.back().part;
  if (unplayable_ != lastState) {
    unplayed_ = past().goTo(past().contents().parts);
    if (unplayed_.empty()) return;
    unplayable_ = lastState;
  }
  (void)past().goTo(lastState);
}

std::chrono::milliseconds MachineSource::lookEvery() const { return follows_ && host_.reached ? kLookNow : kLookPast; }

Result<std::string> MachineSource::carryOut(const Order& order) {
  follows_ = order.kind == Order::Kind::Run;
  if (!follows_) return PastSource::carryOut(order);
  goToNewest();
  return std::string("what runs now");
}

// ---- what is shown -----------------------------------------------------------------------------------------------

RunState MachineSource::state() const {
  if (!follows_) return RunState::Past;
  if (!host_.reached) return RunState::Lost;
  if (past().instance().faulted() || !host_.fault.empty()) return RunState::Fault;
  // The recording knows it earlier than the host is asked.
  return past().instance().stopped() || host_.stopped ? RunState::Stopped : RunState::Running;
}

std::string MachineSource::notice() const {
  const std::vector<std::string>& problems = followed_.files->recording().problems;
  if (!host_.reached && host_.problem.empty()) return {}; // it has not been asked yet
  if (!host_.reached) return fmt::format("{}. Shown is what it has recorded. Trying again …", host_.problem);
  if (!host_.problem.empty()) return "Nothing new can be shown: " + host_.problem;
  if (!unplayed_.empty()) return "What runs now can be shown in a few seconds: " + unplayed_;
  if (problems.size() > knownProblems_) return "Not all can be shown: " + problems.back();
  return {};
}

void MachineSource::fill(Picture& picture, const std::set<std::string>& names) {
  PastSource::fill(picture, names);
  picture.follows = follows_;
  picture.notice = notice();
  // A fault by the host's time limit is not played.
  if (picture.state == RunState::Fault && picture.fault.empty()) picture.fault = host_.fault;
}

} // namespace rung::web
