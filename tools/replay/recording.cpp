// Reads events without playing them (see recording.h).
#include "tools/replay/recording.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <utility>

#include "rtlib/record/events.h"

namespace rung::replay {
namespace {

using runtime::Event;
using runtime::EventReader;
using runtime::Places;

constexpr uint64_t kMostParts = uint64_t{1} << 48;   // of a recording; a damaged one may say more
constexpr uint64_t kMostNumbers = uint64_t{1} << 48; // of a list

void skipNumbers(EventReader& reader, uint64_t count) {
  for (; count != 0 && reader.good(); --count) (void)reader.takeNumber();
}
bool skipBytes(EventReader& reader) {
  (void)reader.takeBytes(reader.takeNumber());
  return true;
}

// The numbers of an event whose first byte has been taken. False: it is none that can be.
bool skipEvent(EventReader& reader, Places& places, Event event) {
  Places::Run run;
  std::span<const uint8_t> bytes;
  if (runtime::isRun(event)) return runtime::takeRun(reader, places, event, run, bytes);
  switch (event) {
  case Event::State: places.clear(); return skipBytes(reader);
  case Event::Inputs:
    for (uint64_t count = reader.takeNumber(); count != 0 && reader.good(); --count) {
      skipNumbers(reader, 1);
      skipBytes(reader);
    }
    return true;
  case Event::Configured: skipNumbers(reader, 4); return skipBytes(reader);
  case Event::Surroundings:
  case Event::Function: skipNumbers(reader, 3); return true;
  case Event::Part: skipNumbers(reader, 2); return true;
  case Event::Outputs: skipNumbers(reader, 2 * std::min(reader.takeNumber(), kMostNumbers)); return true;
  case Event::Forces: skipNumbers(reader, 3 * std::min(reader.takeNumber(), kMostNumbers)); return true;
  case Event::Program:
  case Event::Repeat:
  case Event::Clock:
  case Event::Stopped:
  case Event::Within:
  case Event::Task:
  case Event::Hash:
  case Event::Abort:
  case Event::Served:
  case Event::Decision: skipNumbers(reader, 1); return true;
  case Event::Reply:
  case Event::Answer:
    skipNumbers(reader, 2);
    skipNumbers(reader, reader.takeNumber());
    return true;
  case Event::Request:
    skipNumbers(reader, 1);
    skipNumbers(reader, reader.takeNumber());
    return true;
  case Event::Fault: skipNumbers(reader, 4); return true;
  case Event::Mark: return skipBytes(reader);
  case Event::Ended:
  case Event::Next:
  case Event::Anew:
  case Event::Lost:
  case Event::Saved: return true;
  default: return false; // Places are only in states of a player
  }
}

// What the events after those of a state refer to.
Places placesOf(std::span<const uint8_t> state) {
  Places places;
  for (EventReader reader(state); !reader.atEnd();) {
    const Event event = reader.takeEvent();
    if (event == Event::Places) return skipNumbers(reader, 2), (void)places.takeList(reader), places;
    if (!skipEvent(reader, places, event)) break;
  }
  return places;
}

} // namespace

class Skimmer {
public:
  Skimmer(Contents& to, uint32_t segment, std::span<const uint8_t> events, const Contents::See& see)
      : to_(to), segment_(segment), first_(to.read_), reader_(events.subspan(to.read_)), see_(see) {}

  void run() {
    while (!reader_.atEnd() && !to_.unreadable_) {
      const size_t at = position();
      const Event event = reader_.takeEvent();
      if (see_) see_(event, to_.parts);
      const bool known = take(event, at);
      if (known && reader_.good()) continue;
      add(Landmark::Kind::Damaged, fmt::format("damaged at byte {} of segment {}", at, segment_ + 1));
      to_.unreadable_ = true;
    }
  }

private:
  size_t position() const { return first_ + reader_.position(); }
  void add(Landmark::Kind kind, std::string text) { to_.landmarks.push_back({kind, to_.parts, std::move(text)}); }

  // The program of the next state comes before it.
  std::string startText() const {
    if (!to_.program_) return "started";
    if (next_ == to_.program_) return "started again, or another state of the same program loaded";
    return "another program runs: " + runtime::programName(next_.value_or(0));
  }

  // False: there is no such event, or it cannot be here.
  bool take(Event event, size_t at) {
    if (event == Event::Program || (event == Event::Surroundings && !group_)) group_ = at;
    switch (event) {
    case Event::Program: {
      EventReader hash = reader_;
      next_ = hash.takeNumber();
      break;
    }
    case Event::State: to_.program_ = next_.value_or(0); return state(at);
    case Event::Forces: return forces();
    case Event::Repeat: return repeat();
    case Event::Part:
    case Event::Next:
      group_.reset();
      to_.parts += to_.whole_ ? 1 : 0;
      break;
    case Event::Fault: add(Landmark::Kind::Fault, "the program stopped with a fault"); break;
    case Event::Anew:
      to_.whole_ = false;
      add(Landmark::Kind::Start, startText());
      break;
    case Event::Mark: {
      const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
      add(Landmark::Kind::Note, {reinterpret_cast<const char*>(text.data()), text.size()});
      return true;
    }
    case Event::Lost:
      to_.whole_ = false;
      add(Landmark::Kind::Lost, "events are missing");
      break;
    default: break;
    }
    return skipEvent(reader_, to_.places_, event);
  }
  bool repeat() {
    const uint64_t count = reader_.takeNumber();
    if (!to_.whole_) return true;
    if (count > kMostParts - to_.parts) return false;
    to_.parts += count;
    return true;
  }
  bool forces() {
    ForceChange change{.part = to_.parts, .bits = {}};
    for (uint64_t count = reader_.takeNumber(); count != 0 && reader_.good(); --count) {
      const uint32_t offset = reader_.takeNumber32(), mask = reader_.takeNumber32(), value = reader_.takeNumber32();
      change.bits.push_back({offset, static_cast<uint8_t>(mask), static_cast<uint8_t>(value)});
    }
    const auto same = [](const core::ForcedBits& a, const core::ForcedBits& b) {
      return a.offset == b.offset && a.mask == b.mask && a.value == b.value;
    };
    const bool known =
        to_.forces.empty() ? change.bits.empty() : std::ranges::equal(to_.forces.back().bits, change.bits, same);
    if (!known && reader_.good()) to_.forces.push_back(std::move(change));
    return true;
  }
  bool state(size_t at) {
    skipBytes(reader_);
    if (!reader_.good()) return false;
    to_.states.push_back({segment_, group_.value_or(at), position(), to_.parts});
    group_.reset();
    to_.places_.clear();
    to_.whole_ = true;
    return true;
  }

  Contents& to_;
  uint32_t segment_;
  size_t first_;
  EventReader reader_;
  const Contents::See& see_;
  std::optional<uint64_t> next_; // the program of the next state
  std::optional<size_t> group_;  // where the events before a state begin
};

std::vector<OutsideWrite> outsideWrites(std::span<const uint8_t> before, std::span<const uint8_t> events,
                                        uint64_t skipped, runtime::RecordingMode mode) {
  using By = OutsideWrite::By;
  std::vector<OutsideWrite> writes;
  Places places = placesOf(before);
  EventReader reader(events);
  const bool controlRuns = mode == runtime::RecordingMode::Control;
  bool inPart = false, within = false;
  while (!reader.atEnd()) {
    const Event event = reader.next();
    const bool isWrite = runtime::isRun(event), isPart = event == Event::Part || event == Event::Next;
    const bool ofNext = isPart || event == Event::Repeat || event == Event::Ended || (isWrite && !within);
    if (inPart && ofNext) {
      if (skipped-- == 0) return writes;
      writes.clear();
      inPart = within = false;
    }
    (void)reader.takeEvent();
    if (event == Event::Repeat) { // parts of which nothing is recorded
      const uint64_t count = reader.takeNumber();
      if (skipped < count) return {};
      skipped -= count;
      continue;
    }
    if (!isWrite) {
      inPart = inPart || isPart;
      within = within || event == Event::Within;
      if (!skipEvent(reader, places, event)) return writes;
      continue;
    }
    Places::Run run;
    std::span<const uint8_t> bytes;
    if (!runtime::takeRun(reader, places, event, run, bytes)) return writes;
    const By by = run.event == Event::Input ? By::Machine : controlRuns ? By::Client : inPart ? By::Control : By::Any;
    writes.push_back({run.offset, run.count, by});
  }
  return writes;
}

void Contents::grow(const Recording& recording, const See& see) {
  if (segmentParts.empty() && !recording.segments.empty()) {
    parts = recording.partsBefore;
    segmentParts.push_back(parts);
  }
  while (!segmentParts.empty()) {
    const auto last = static_cast<uint32_t>(segmentParts.size() - 1);
    const Segment& segment = recording.segments[last];
    read_ = std::min(read_, segment.events.size());
    Skimmer(*this, last, segment.events, see).run();
    read_ = segment.events.size();
    if (!segment.damage.empty() && !damageNoted_) {
      landmarks.push_back({Landmark::Kind::Damaged, parts, segment.damage});
      damageNoted_ = true;
    }
    if (segmentParts.size() == recording.segments.size()) break;
    segmentParts.push_back(parts);
    read_ = 0;
    damageNoted_ = false;
    if (recording.segments[last + 1].continues) continue;
    unreadable_ = false;
    whole_ = false;
  }
  drop(recording);
}

std::span<const Landmark> Contents::landmarksAt(uint64_t part) const {
  return std::ranges::equal_range(landmarks, part, {}, &Landmark::part);
}

uint64_t Contents::partAt(const Recording& recording, int64_t wallUs) const {
  for (auto i = static_cast<uint32_t>(segmentParts.size()); i-- > recording.firstSegment;) {
    const Segment& segment = recording.segments[i];
    if (segment.beganUs > wallUs) continue;
    const uint64_t first = segmentParts[i], end = i + 1 < segmentParts.size() ? segmentParts[i + 1] : parts;
    if (wallUs >= segment.writtenUs) return end;
    const auto share =
        static_cast<double>(wallUs - segment.beganUs) / static_cast<double>(segment.writtenUs - segment.beganUs);
    return first + static_cast<uint64_t>(share * static_cast<double>(end - first));
  }
  return states.empty() ? 0 : states.front().part;
}

void Contents::drop(const Recording& recording) {
  std::erase_if(states, [&](const StatePoint& point) { return point.segment < recording.firstSegment; });
  if (states.empty() || recording.firstSegment == 0) return;
  const uint64_t first = states.front().part;
  const auto needed = std::ranges::upper_bound(forces, first, {}, &ForceChange::part);
  if (needed != forces.begin()) forces.erase(forces.begin(), std::prev(needed));
  droppedLandmarks += std::erase_if(landmarks, [&](const Landmark& landmark) { return landmark.part < first; });
}

} // namespace rung::replay
