// Goes through a recording (see past.h).
#include "tools/replay/past.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "tools/scenario/session.h"

namespace rung::replay {

using runtime::Event;
using runtime::Played;

namespace {

constexpr size_t kMostDifferences = 100;
constexpr uint64_t kNear = 8192; // parts before the aim in which states are kept

} // namespace

Result<std::unique_ptr<Past>> Past::open(const Recording& recording, const PastOptions& options) {
  if (recording.programs.empty()) return failure("the recording has no program");
  std::unique_ptr<Past> past(new Past(recording, options));
  if (past->contents_.states.empty())
    return failure(past->contents_.landmarks.empty()
                       ? "the recording is empty"
                       : "nothing in the recording can be played: " + past->contents_.landmarks[0].text);
  if (std::string problem = past->goTo(past->firstPart()); !problem.empty()) return failure(problem);
  return past;
}

// ---- places ------------------------------------------------------------------------------------------------------

size_t Past::position() const { return again_ != 0 ? base_ : base_ + stages_[stageNumber_]->player().position(); }

Result<void> Past::useStage(uint32_t number) {
  if (!stages_[number]) {
    Result<std::unique_ptr<Stage>> made = Stage::make(*recording_.programs[number], options_.engine, recording_.mode);
    if (!made.ok()) return made.failure();
    stages_[number] = std::move(made).value();
    stages_[number]->player().compare(compares_);
  }
  if (stageNumber_ != number) scanParts_ = 0;
  stageNumber_ = number;
  watch(watch_);
  return {};
}

void Past::watch(runtime::OutsideWatch* watch) {
  watch_ = watch;
  for (const std::unique_ptr<Stage>& one : stages_)
    if (one) one->player().instance().setOutsideWatch(one == stages_[stageNumber_] ? watch : nullptr);
}

void Past::play(size_t from) {
  base_ = from;
  again_ = resumed_ ? takeRepeats(events(), base_) : 0;
  stage().player().setEvents(events().subspan(base_));
}

// Of the programs, the one whose state it is.
bool Past::begin(const StatePoint& point) {
  segment_ = point.segment;
  part_ = point.part;
  resumed_ = false;
  const uint32_t first = stageNumber_;
  const auto count = static_cast<uint32_t>(recording_.programs.size());
  for (uint32_t i = 0; i < count; ++i) {
    const Result<void> made = useStage((first + i) % count);
    if (!made.ok()) {
      problem_ = made.error();
      return false;
    }
    play(point.begins);
    const Played played = stage().player().play();
    if (played == Played::State) return true;
    if (played != Played::Other && played != Played::Damaged) break;
  }
  problem_ = fmt::format("the state before scan {} is of no program of this recording, or damaged", point.part + 1);
  return false;
}

bool Past::resume(const Moment& moment) {
  if (const Result<void> made = useStage(moment.program); !made.ok()) return false;
  segment_ = moment.segment;
  part_ = moment.part;
  if (!playState(stage().player(), moment.events)) return false;
  againKind_ = moment.kind;
  againNumber_ = moment.number;
  againEvent_.resize(32);
  runtime::EventWriter writer(againEvent_);
  writer.put(Event::Part, static_cast<uint8_t>(moment.kind), moment.number);
  againEvent_.resize(writer.size());
  resumed_ = moment.repeats == 0;
  play(moment.position);
  if (!resumed_) again_ = moment.repeats;
  return true;
}

std::optional<Moment> Past::present() {
  runtime::Player& player = stage().player();
  std::vector<uint8_t> state = player.state();
  if (state.empty()) return std::nullopt;
  const bool again = again_ != 0;
  return Moment{.program = stageNumber_,
                .segment = segment_,
                .position = position(),
                .part = part_,
                .repeats = again ? again_ : player.repeatsLeft(),
                .kind = again ? againKind_ : player.lastKind(),
                .number = again ? againNumber_ : player.lastNumber(),
                .events = std::move(state)};
}

void Past::keep() {
  if (kept_.contains(part_)) return;
  if (std::optional<Moment> moment = present()) keep(std::move(*moment));
}

void Past::keep(Moment moment) {
  const uint64_t part = moment.part;
  const size_t bytes = moment.events.size();
  if (!kept_.emplace(part, std::move(moment)).second) return;
  keptBytes_ += bytes;
  keptOrder_.push_back(part);
  while (keptBytes_ > options_.keptBytes && keptOrder_.size() > 1) {
    const auto oldest = kept_.find(keptOrder_.front());
    keptBytes_ -= oldest->second.events.size();
    kept_.erase(oldest);
    keptOrder_.erase(keptOrder_.begin());
  }
}

// ---- playing -----------------------------------------------------------------------------------------------------

bool Past::playAgain() {
  stage().player().setEvents(againEvent_);
  if (stage().player().play() != Played::Part) return false;
  ++part_;
  resumed_ = false;
  takeSent();
  if (--again_ == 0) play(base_);
  return true;
}

// What comes after the events that the player has.
bool Past::nextSegment() {
  if (const size_t ends = position(); ends < events().size()) { // the segment has grown
    play(ends);
    return true;
  }
  if (segment_ + 1 < recording_.segments.size() && recording_.segments[segment_ + 1].continues) {
    ++segment_;
    play(0);
    return true;
  }
  for (uint32_t next = segment_ + 1; next < recording_.segments.size(); ++next) {
    const auto point = std::ranges::find(contents_.states, next, &StatePoint::segment);
    if (point == contents_.states.end()) continue;
    const bool follows = next == segment_ + 1 && recording_.segments[segment_].damage.empty();
    if (!begin(*point)) return false;
    if (follows) noteDifference();
    return true;
  }
  problem_.clear();
  return false;
}

// The player has come to the events of a state of another program, or has read it.
bool Past::otherProgram() {
  const size_t at = position();
  const auto point = std::ranges::find_if(contents_.states,
                                          [&](const StatePoint& p) { return p.segment == segment_ && p.ends >= at; });
  if (point != contents_.states.end()) return begin(*point);
  problem_ = fmt::format("after scan {} another program takes over, of which the recording has no state", part_);
  return false;
}

bool Past::next() {
  problem_.clear();
  sent_.clear();
  for (;;) {
    if (again_ != 0) return playAgain();
    switch (stage().player().play()) {
    case Played::Part:
      ++part_;
      resumed_ = false;
      noteDifference();
      takeSent();
      return true;
    case Played::State: noteDifference(); break;
    case Played::Lost: break;
    case Played::End:
      if (!nextSegment()) return false;
      break;
    case Played::Other:
      if (!otherProgram()) return false;
      break;
    case Played::NoForces: problem_ = "its forces cannot be put in effect"; return false;
    case Played::Damaged: problem_ = fmt::format("the recording is damaged after scan {}", part_); return false;
    }
  }
}

void Past::grown() {
  contents_.grow(recording_);
  stages_.resize(recording_.programs.size());
  std::erase_if(keptOrder_, [&](uint64_t part) {
    const auto moment = kept_.find(part);
    if (moment->second.segment >= recording_.firstSegment) return false;
    keptBytes_ -= moment->second.events.size();
    kept_.erase(moment);
    return true;
  });
  if (segment_ >= recording_.firstSegment) return;
  reached_ = false;
  (void)goTo(firstPart());
}

void Past::compare(bool compares) {
  compares_ = compares;
  for (const std::unique_ptr<Stage>& stage : stages_)
    if (stage) stage->player().compare(compares);
}

void Past::takeSent() {
  rung_message message;
  while (stage().player().instance().messages().pop(message)) sent_.push_back(message);
}

void Past::noteDifference() {
  const std::optional<runtime::PlayedDifference>& what = stage().player().difference();
  if (!what || differences_.size() == kMostDifferences) return;
  const auto known = std::ranges::find(differences_, part_, &Difference::part);
  if (known != differences_.end()) return;
  Difference difference{part_, *what, {}};
  const rung_program& program = instance().program();
  if (const auto byte = what->offset == RUNG_NONE ? std::nullopt : runtime::byteAt(program, what->offset))
    difference.place = nc::describe(program, runtime::intRef(byte->space, byte->byte, 8));
  differences_.push_back(std::move(difference));
}

std::string Past::rangeText() const {
  return fmt::format("the recording has scans {} to {}", firstPart(), contents_.parts);
}

std::string Past::goTo(uint64_t aim) {
  if (aim > contents_.parts || aim < firstPart()) return rangeText();
  const auto afterKept = kept_.upper_bound(aim);
  const Moment* kept = afterKept == kept_.begin() ? nullptr : &std::prev(afterKept)->second;
  // Of several states before the same part the last one is what it begins with; the part before ends with the first.
  const auto afterPoint = std::ranges::lower_bound(contents_.states, aim, {}, &StatePoint::part);
  const StatePoint* point = afterPoint == contents_.states.begin() ? nullptr : &*std::prev(afterPoint);
  if (afterPoint != contents_.states.end() && afterPoint->part == aim && (point == nullptr || aim == firstPart()))
    point = &*afterPoint;
  const uint64_t fromKept = kept != nullptr ? kept->part : 0, fromPoint = point != nullptr ? point->part : 0;
  const bool stay = reached_ && part_ <= aim && part_ >= std::max(fromKept, fromPoint);
  if (!stay) {
    reached_ = false;
    if (kept != nullptr && (point == nullptr || fromKept >= fromPoint)) {
      if (!resume(*kept)) return "a kept state cannot be used";
    } else if (point == nullptr || !begin(*point)) {
      return problem_.empty() ? "there is no state to begin with" : problem_;
    }
  }
  reached_ = false;
  for (uint64_t nextKept = part_ + options_.keptEvery; part_ < aim;) {
    if (!next()) return problem_.empty() ? "the recording has ended" : problem_;
    if (aim - part_ < kNear) keepAfter(nextKept);
  }
  reached_ = true;
  return {};
}

// The state is that between two scans: within one of several slices it cannot be saved.
void Past::keepAfter(uint64_t& part) {
  if (part_ < part || !instance().atListStart()) return;
  keep();
  part = part_ + options_.keptEvery;
}

std::string Past::goToTime(int64_t us) {
  size_t low = 0, high = contents_.states.size();
  while (high - low > 1) { // the clock at states[low] is not after `us`, or low is 0
    const size_t middle = low + (high - low) / 2;
    reached_ = false;
    if (!begin(contents_.states[middle])) return problem_;
    (instance().nowUs() <= us ? low : high) = middle;
  }
  if (!begin(contents_.states[low])) return problem_;
  uint64_t nextKept = part_ + options_.keptEvery;
  while (instance().nowUs() < us && next()) keepAfter(nextKept);
  reached_ = problem_.empty();
  return problem_;
}

namespace {

// The parts between two runs of each task.
class TaskPeriods final : public runtime::TaskWatch {
public:
  explicit TaskPeriods(const uint64_t& part) : part_(part) {}
  void begins(const runtime::Instance&, uint32_t task) override {
    const auto [at, isNew] = last_.try_emplace(task, part_);
    if (!isNew) longest_ = std::max(longest_, part_ - std::exchange(at->second, part_));
  }
  void ended(const runtime::Instance&, uint32_t) override {}
  uint64_t longest() const { return longest_; }

private:
  const uint64_t& part_;
  std::map<uint32_t, uint64_t> last_;
  uint64_t longest_ = 1;
};

} // namespace

uint64_t Past::partsPerScan() {
  constexpr uint64_t kLooked = 128, kValid = 1000; // parts
  if (scanParts_ != 0 && scanKnown_ <= part_ && part_ - scanKnown_ < kValid) return scanParts_;
  const uint64_t here = part_;
  if (!goTo(here - std::min(here - firstPart(), kLooked)).empty()) {
    (void)goTo(here);
    return 1;
  }
  TaskPeriods periods(part_);
  runtime::Instance& watched = stage().player().instance();
  watched.setTaskWatch(&periods);
  while (part_ < here && next()) { // not from a kept moment
  }
  watched.setTaskWatch(nullptr);
  (void)goTo(here);
  scanParts_ = periods.longest();
  scanKnown_ = here;
  return scanParts_;
}

// The events from a moment on that lead to the present position.
std::vector<uint8_t> Past::eventsFrom(const Moment& from) const {
  const std::vector<Segment>& segments = recording_.segments;
  uint32_t i = from.segment;
  size_t begin = from.position;
  while (begin == segments[i].events.size() && i < segment_ && segments[i + 1].continues) ++i, begin = 0;
  const uint64_t repeats = from.repeats != 0 ? from.repeats : takeRepeats(segments[i].events, begin);
  std::vector<uint8_t> all(32);
  runtime::EventWriter writer(all);
  if (repeats != 0) writer.put(Event::Part, static_cast<uint8_t>(from.kind), from.number);
  if (repeats > 1) writer.put(Event::Repeat, repeats - 1);
  all.resize(writer.size());
  for (; i <= segment_; ++i, begin = 0) {
    if (i != from.segment && !segments[i].continues) all.clear(); // it begins with a state
    const std::span<const uint8_t> events = segments[i].events;
    const size_t end = i == segment_ ? position() : events.size();
    all.insert(all.end(), events.begin() + static_cast<ptrdiff_t>(begin), events.begin() + static_cast<ptrdiff_t>(end));
  }
  return all;
}

// The last moment up to the present position from which playing can begin: the position itself, or the beginning of the
// scan whose slices lead to it. The position is the same afterwards.
std::optional<Moment> Past::beginning() {
  if (std::optional<Moment> here = present()) return here;
  const uint64_t aim = part_;
  const auto after = std::ranges::upper_bound(contents_.states, aim, {}, &StatePoint::part);
  const uint64_t least = after == contents_.states.begin() ? firstPart() : std::prev(after)->part;
  std::optional<Moment> last;
  for (uint64_t back = 16; !last && part_ == aim; back *= 4) {
    const uint64_t from = std::max(least, aim - std::min(aim, back));
    if (!goTo(from).empty()) return std::nullopt;
    last = present();
    while (part_ < aim && next())
      if (instance().atListStart()) last = present();
    reached_ = part_ == aim;
    if (from == least) break;
  }
  return last;
}

// The state with which the program of now begins with this part, as the recording has it.
std::optional<Moment> Past::firstOf(uint64_t part) const {
  const auto ofPart = [&](const StatePoint& p) { return p.segment == segment_ && p.part + 1 == part; };
  const auto point = std::find_if(contents_.states.rbegin(), contents_.states.rend(), ofPart);
  if (point == contents_.states.rend()) return std::nullopt;
  const std::span<const uint8_t> state = events().subspan(point->begins, point->ends - point->begins);
  return Moment{.program = stageNumber_,
                .segment = segment_,
                .position = point->ends,
                .part = part - 1,
                .events = {state.begin(), state.end()}};
}

// Whether nothing but the part lies between the states before and after it.
bool Past::followsFromBefore(uint64_t part) const {
  if (part <= firstPart() + 1) return true;
  return std::ranges::none_of(contents_.landmarksAt(part - 1), [](const Landmark& landmark) {
    return landmark.kind == Landmark::Kind::Start || landmark.kind == Landmark::Kind::Lost ||
           landmark.kind == Landmark::Kind::Damaged;
  });
}

bool Past::isContinuous(uint32_t from) const {
  for (uint32_t i = from + 1; i <= segment_; ++i)
    if (!recording_.segments[i].continues) return false;
  return true;
}

const Flow* Past::flow(const FlowEngine::AfterRun& afterRun, uint64_t parts) {
  const uint64_t here = part_;
  blockBefore_.clear();
  outside_.clear();
  parts = std::min(parts, here - std::min(here, firstPart()));
  if (parts == 0) return nullptr;
  std::optional<Moment> from = goTo(here - parts).empty() ? beginning() : std::nullopt;
  const std::span<const uint8_t> block = instance().block();
  std::vector<uint8_t> before(block.begin(), block.end());
  if (from) keep(*from);
  if (!goTo(here).empty() || !from) return nullptr;
  const bool isOther = from->program != stageNumber_;
  if (parts > 1 && (isOther || !isContinuous(from->segment))) return flow(afterRun, 1);
  if (isOther) from = firstOf(here); // a program that takes over begins with its state
  if (!from) return nullptr;
  if (!isOther && followsFromBefore(here)) blockBefore_ = std::move(before);
  const std::vector<uint8_t> events = eventsFrom(*from);
  const uint64_t skipped = here - parts - from->part;
  outside_ = replay::outsideWrites(from->events, events, skipped, recording_.mode);
  return stage().flow(from->events, events, skipped, parts, afterRun);
}

std::string positionText(const Past& past) { return scenario::scanText(past.part(), past.instance().nowUs()); }

} // namespace rung::replay
