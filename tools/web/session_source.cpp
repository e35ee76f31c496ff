// Runs the session and makes pictures of it (see session_source.h).
#include "tools/web/session_source.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "ir/interp/interp.h"
#include "tools/report/place_names.h"
#include "tools/scenario/names.h"
#include "tools/scenario/statements.h"
#include "tools/scenario/values.h"
#include "tools/scenario/words.h"

namespace rung::web {
namespace {

constexpr int64_t kMomentEveryUs = 500'000; // on the program's clock
constexpr size_t kMostMoments = 600;
constexpr int64_t kMostSteps = 10'000; // of one order

// Code in which forced bits are as an observer holds them: the program's own.
int32_t ownCode(void*, const rung_image* image, void* engine, const rung_forced_byte*, uint32_t, rung_forced_code* code,
                char*, size_t) {
  *code = {.chunk_fns = rung_image_program(image)->chunk_fns, .engine = engine, .release = nullptr, .owner = nullptr};
  return RUNG_OK;
}

// A forced bit that the operation has written has its value again before anything can read it.
class HeldBits final : public ir::RungObserver {
public:
  explicit HeldBits(runtime::Instance& instance) : instance_(instance) {}
  void rungRan(uint32_t, std::span<const uint64_t>) override {}
  void accessed(const ir::Access& access) override {
    if (access.writes) instance_.hold();
  }

private:
  runtime::Instance& instance_;
};

// Statements that only act between two scans of the same program.
bool isAction(const scenario::Statement& statement) {
  const scenario::StatementInfo& info = scenario::StatementInfo::of(statement);
  const bool travels = statement.kind == scenario::Kind::Snapshot || statement.kind == scenario::Kind::Restore;
  return info.stage == scenario::Stage::Run && info.advances == scenario::Advance::Nothing &&
         info.program == scenario::OtherProgram::None && !travels;
}

} // namespace

void observeForces(scenario::Session& session, replay::FlowEngine& engine) {
  session.machine().image().serve(
      {.size = sizeof(rung_code_maker), .reserved = 0, .force = &ownCode, .release = nullptr, .user = nullptr});
  static_cast<ir::InterpEngine&>(engine.engine()).setObserver(std::make_unique<HeldBits>(session.instance()));
}

SessionSource::SessionSource(scenario::Session& session, replay::SessionPast& past, const Drawn& drawn,
                             replay::FlowEngine& engine)
    : PacedSource(drawn), session_(session), past_(past), engine_(engine), drawn_(drawn),
      states_(engine, *drawn.program), places_(*drawn.program, session.instance(), session.nc(), states_),
      scan_(past.scans()), last_(scan_) {
  keepMoment();
}

std::string SessionSource::statement(const std::string& line) {
  const scenario::ParsedLine parsed = scenario::parseLine(line);
  if (!parsed.statement) return parsed.problem;
  const auto problem = session_.execute(*parsed.statement);
  return problem ? problem->message : "";
}

bool SessionSource::nextScan() {
  (void)advance();
  return true;
}

// False: the program has stopped with a fault. Then no scan runs, and none is counted, here or in a recording.
bool SessionSource::advance() {
  repeat();
  if (session_.instance().faulted()) return false;
  oneScan();
  return true;
}

void SessionSource::oneScan() {
  std::string problem;
  engine_.observe(session_.instance(), [&] { problem = statement("scan"); });
  ++scan_;
  const bool isNew = scan_ > last_;
  last_ = std::max(last_, scan_);
  if (!isNew) return;
  if (!problem.empty()) logHere("fault", problem);
  compareMessages(session_.instance(), session_.nc().control(), scan_);
  checkTrigger();
  if (session_.instance().faulted()) logHere("fault", session_.instance().faultText());
  if (moments_.empty() || session_.nowUs() - moments_.back().us >= kMomentEveryUs) keepMoment();
}

// The oldest moment makes room for a new one. A program that has stopped within a scan cannot be continued: then there
// is no new one.
void SessionSource::keepMoment() {
  const bool full = moments_.size() == kMostMoments;
  Moment moment{scan_, session_.nowUs(), done_.size(),
                full ? moments_.front().name : fmt::format("web-{}", moments_.size())};
  if (!statement("snapshot " + moment.name).empty()) return;
  if (full) moments_.pop_front();
  moments_.push_back(std::move(moment));
}

// Back to a moment before the scan, and forwards again with what was done meanwhile, so that its flow is seen again.
Result<std::string> SessionSource::seek(uint64_t scan) {
  if (moments_.empty()) return failure("the program has not kept a moment to which it could go back");
  scan = std::clamp(scan, firstScan(), last_);
  if (scan != scan_) {
    const auto after = std::ranges::lower_bound(moments_, scan, {}, &Moment::scan);
    const Moment& from = after == moments_.begin() ? *after : *std::prev(after);
    if (from.scan > scan_ || scan < scan_) {
      past_.setRepeats(true);
      if (const std::string problem = statement("restore " + from.name); !problem.empty()) return failure(problem);
      scan_ = from.scan;
      nextDone_ = from.statements;
    }
    while (scan_ < scan && advance()) {
    }
  }
  if (scan_ == last_) repeat();
  return fmt::format("scan {}", scan_);
}

// What was executed before the next scan. What follows after the newest one has not been yet.
void SessionSource::repeat() {
  for (; nextDone_ < done_.size() && done_[nextDone_].scan == scan_; ++nextDone_)
    (void)statement(done_[nextDone_].line);
  if (scan_ == last_) past_.setRepeats(false);
}

std::vector<ForcedCell> SessionSource::forces() {
  std::vector<ForcedCell> cells;
  for (const auto& [name, value] : session_.forces()) {
    ForcedCell& cell = cells.emplace_back(ForcedCell{name, value.text, {}});
    if (const auto place = session_.nc().readPlace(session_.instance().program(), name))
      cell.rows = places_.at(report::bitsOf(*place));
  }
  return cells;
}

std::string SessionSource::valueOf(const std::string& name) const {
  const Result<scenario::Reading> reading = scenario::readName(session_.instance(), session_.nc(), name, false);
  return reading.ok() ? scenario::showShort(reading.value()) : "";
}

void SessionSource::fill(Picture& picture, const std::set<std::string>& names) {
  picture.drawn = drawn_;
  picture.scan = scan_;
  picture.us = session_.nowUs();
  const bool faulted = session_.instance().faulted();
  picture.state = scan_ < last_ ? RunState::Past
                  : faulted     ? RunState::Fault
                  : running_    ? RunState::Running
                                : RunState::Paused;
  picture.follows = picture.state == RunState::Running;
  if (faulted) picture.fault = session_.instance().faultText();
  picture.elements = states_.of(engine_.flow(), session_.instance().block());
  for (const std::string& name : names)
    if (std::string value = valueOf(name); !value.empty()) picture.values.emplace(name, std::move(value));
  picture.messages = messagesOf(session_.instance(), session_.nc().control());
  picture.forces = forces();
  picture.firstScan = firstScan();
  picture.lastScan = last_;
}

Result<std::string> SessionSource::write(const std::string& line, const char* kind) {
  if (scan_ < last_) return failure("this is the past: nothing can be written there; go to the newest scan first");
  const scenario::ParsedLine parsed = scenario::parseLine(line);
  if (!parsed.statement) return failure(parsed.problem);
  if (!isAction(*parsed.statement)) return failure("only statements that act between two scans can be given here");
  if (const std::string problem = statement(line); !problem.empty()) return failure(problem);
  done_.push_back({scan_, line});
  nextDone_ = done_.size();
  logHere(kind, line);
  return line;
}

Result<std::string> SessionSource::step(int64_t scans) {
  if (scans < 0 || scan_ < last_) return seek(scanFrom(scan_, scans));
  for (int64_t i = 0; i < std::min(scans, kMostSteps); ++i) nextScan();
  return fmt::format("scan {}", scan_);
}

Result<std::string> SessionSource::carryOut(const Order& order) {
  const std::string name = order.name.empty() ? "" : scenario::asWord(order.name);
  running_ = running_ && order.kind >= Order::Kind::Set;
  switch (order.kind) {
  case Order::Kind::Run: {
    const Result<std::string> there = seek(last_);
    running_ = there.ok();
    return there.ok() ? Result<std::string>("running") : there;
  }
  case Order::Kind::Pause: return std::string("paused");
  case Order::Kind::Step: return step(order.scans);
  case Order::Kind::Seek: return seek(scanFrom(0, order.scans));
  case Order::Kind::Set: return write(fmt::format("set {} {}", name, scenario::asWord(order.value)), "set");
  case Order::Kind::Force: return write(fmt::format("force {} {}", name, scenario::asWord(order.value)), "force");
  case Order::Kind::Unforce: return write(name.empty() ? "unforce" : "unforce " + name, "force");
  case Order::Kind::Mark:
  case Order::Kind::Reload: return failure("only a machine can do that");
  case Order::Kind::Statement: return write(order.name, "statement");
  }
  return failure("an unknown order");
}

Result<Why> SessionSource::explain(const std::string& name) {
  Result<std::string> text = past_.why(name, last_ - scan_);
  if (!text.ok()) return text.failure();
  return Why{std::move(text).value(), {}};
}

} // namespace rung::web
