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

} // namespace

class Skimmer {
public:
  Skimmer(Contents& to, uint32_t segment, std::span<const uint8_t> events)
      : to_(to), segment_(segment), first_(to.read_), reader_(events.subspan(to.read_)) {}

  void run() {
    while (!reader_.atEnd() && !to_.unreadable_) {
      const size_t at = position();
      const Event event = reader_.takeEvent();
      const bool known = take(event, at);
      if (known && reader_.good()) continue;
      add(Landmark::Kind::Damaged, fmt::format("damaged at byte {} of segment {}", at, segment_ + 1));
      to_.unreadable_ = true;
    }
  }

private:
  size_t position() const { return first_ + reader_.position(); }
  void add(Landmark::Kind kind, std::string text) { to_.landmarks.push_back({kind, to_.parts, std::move(text)}); }
  void numbers(uint64_t count) {
    for (; count != 0 && reader_.good(); --count) (void)reader_.takeNumber();
  }

  // False: there is no such event, or it cannot be here.
  bool take(Event event, size_t at) {
    switch (event) {
    case Event::State: return state(at);
    case Event::Program:
      group_ = at;
      numbers(1);
      return true;
    case Event::Surroundings:
      if (!group_) group_ = at;
      numbers(3);
      return true;
    case Event::Inputs: return inputs();
    case Event::Input: numbers(1); return bytes();
    case Event::Configured: numbers(4); return bytes();
    case Event::Function: numbers(3); return true;
    case Event::Abort:
    case Event::Served:
    case Event::Decision: numbers(1); return true;
    case Event::Saved: return true;
    case Event::Outputs: numbers(2 * reader_.takeNumber()); return true;
    case Event::Forces: numbers(3 * reader_.takeNumber()); return true;
    case Event::Part:
      numbers(2);
      group_.reset();
      to_.parts += to_.whole_ ? 1 : 0;
      return true;
    case Event::Repeat: to_.parts += to_.whole_ ? reader_.takeNumber() : (numbers(1), 0); return true;
    case Event::Clock:
    case Event::Stopped:
    case Event::Within:
    case Event::Task:
    case Event::Hash: numbers(1); return true;
    case Event::Bytes: numbers(1); return bytes();
    case Event::Reply:
    case Event::Answer:
    case Event::Request:
      numbers(event == Event::Request ? 1 : 2);
      numbers(reader_.takeNumber());
      return true;
    case Event::Ended: return true;
    case Event::Fault:
      numbers(4);
      add(Landmark::Kind::Fault, "the program stopped with a fault");
      return true;
    case Event::Anew:
      to_.whole_ = false;
      add(Landmark::Kind::Start, "started, or another state loaded");
      return true;
    case Event::Mark: {
      const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
      add(Landmark::Kind::Note, {reinterpret_cast<const char*>(text.data()), text.size()});
      return true;
    }
    case Event::Lost:
      to_.whole_ = false;
      add(Landmark::Kind::Lost, "events are missing");
      return true;
    }
    return false;
  }
  bool bytes() {
    (void)reader_.takeBytes(reader_.takeNumber());
    return true;
  }
  bool inputs() {
    for (uint64_t count = reader_.takeNumber(); count != 0 && reader_.good(); --count) {
      numbers(1);
      bytes();
    }
    return true;
  }
  bool state(size_t at) {
    bytes();
    if (!reader_.good()) return false;
    to_.states.push_back({segment_, group_.value_or(at), position(), to_.parts});
    group_.reset();
    to_.whole_ = true;
    return true;
  }

  Contents& to_;
  uint32_t segment_;
  size_t first_;
  EventReader reader_;
  std::optional<size_t> group_; // where the events before a state begin
};

void Contents::grow(const Recording& recording) {
  if (segmentParts.empty() && !recording.segments.empty()) segmentParts.push_back(0);
  while (!segmentParts.empty()) {
    const auto last = static_cast<uint32_t>(segmentParts.size() - 1);
    const Segment& segment = recording.segments[last];
    read_ = std::min(read_, segment.events.size());
    Skimmer(*this, last, segment.events).run();
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
  droppedLandmarks += std::erase_if(landmarks, [&](const Landmark& landmark) { return landmark.part < first; });
}

} // namespace rung::replay
