// Reads events without playing them (see recording.h).
#include "tools/replay/recording.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "rtlib/record/events.h"

namespace rung::replay {
namespace {

using runtime::Event;
using runtime::EventReader;

class Skimmer {
public:
  Skimmer(Contents& to, uint32_t segment, const Segment& of) : to_(to), segment_(segment), reader_(of.events) {}

  void run() {
    while (!reader_.atEnd()) {
      const size_t at = reader_.position();
      const Event event = reader_.takeEvent();
      const bool known = take(event, at);
      if (known && reader_.good()) continue;
      add(Landmark::Kind::Damaged, fmt::format("damaged at byte {} of segment {}", at, segment_ + 1));
      return;
    }
  }

private:
  void add(Landmark::Kind kind, std::string text) { to_.landmarks.push_back({kind, to_.parts, std::move(text)}); }
  void numbers(uint64_t count) {
    for (; count != 0 && reader_.good(); --count) (void)reader_.takeNumber();
  }

  // False: there is no such event, or it cannot be here.
  bool take(Event event, size_t at) {
    switch (event) {
    case Event::State: return state(at);
    case Event::Surroundings:
      group_ = at;
      numbers(3);
      return true;
    case Event::Outputs: numbers(2 * reader_.takeNumber()); return true;
    case Event::Forces: numbers(3 * reader_.takeNumber()); return true;
    case Event::Part:
      numbers(2);
      group_.reset();
      to_.parts += whole_ ? 1 : 0;
      return true;
    case Event::Repeat: to_.parts += whole_ ? reader_.takeNumber() : (numbers(1), 0); return true;
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
      whole_ = false;
      add(Landmark::Kind::Start, "started, or another state loaded");
      return true;
    case Event::Mark: {
      const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
      add(Landmark::Kind::Note, {reinterpret_cast<const char*>(text.data()), text.size()});
      return true;
    }
    case Event::Lost:
      whole_ = false;
      add(Landmark::Kind::Lost, "events are missing");
      return true;
    }
    return false;
  }
  bool bytes() {
    (void)reader_.takeBytes(reader_.takeNumber());
    return true;
  }
  bool state(size_t at) {
    bytes();
    if (!reader_.good()) return false;
    to_.states.push_back({segment_, group_.value_or(at), reader_.position(), to_.parts});
    group_.reset();
    whole_ = true;
    return true;
  }

  Contents& to_;
  uint32_t segment_;
  EventReader reader_;
  std::optional<size_t> group_; // where the events before a state begin
  bool whole_ = false;
};

} // namespace

Contents::Contents(const Recording& recording) {
  for (uint32_t i = 0; i < recording.segments.size(); ++i) {
    segmentParts.push_back(parts);
    Skimmer(*this, i, recording.segments[i]).run();
    if (const std::string& damage = recording.segments[i].damage; !damage.empty())
      landmarks.push_back({Landmark::Kind::Damaged, parts, damage});
  }
  for (const Note& note : recording.notes) landmarks.push_back({Landmark::Kind::Note, note.part, note.text});
  std::ranges::stable_sort(landmarks, {}, &Landmark::part);
}

} // namespace rung::replay
