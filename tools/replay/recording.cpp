// Reads events without playing them (see recording.h).
#include "tools/replay/recording.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

#include "compiler/embedded_ir.h"
#include "rtlib/record/events.h"
#include "rtlib/record/recording_reader.h"

namespace rung::replay {
namespace {

using runtime::Event;
using runtime::EventReader;

constexpr uint64_t kMostParts = uint64_t{1} << 48;   // of a recording; a damaged one may say more
constexpr uint64_t kMostNumbers = uint64_t{1} << 48; // of a list

void skipNumbers(EventReader& reader, uint64_t count) {
  for (; count != 0 && reader.good(); --count) (void)reader.takeNumber();
}
bool skipBytes(EventReader& reader) {
  (void)reader.takeBytes(reader.takeNumber());
  return true;
}

// The numbers of an event. False: there is no such event.
bool skipEvent(EventReader& reader, Event event) {
  switch (event) {
  case Event::State: return skipBytes(reader);
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
  case Event::Input:
  case Event::Bytes: skipNumbers(reader, 1); return skipBytes(reader);
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
  case Event::Anew:
  case Event::Lost:
  case Event::Saved: return true;
  }
  return false;
}

class Skimmer {
public:
  Skimmer(Contents& to, uint32_t segment, const Segment& of, const Contents::See& see)
      : to_(to), segment_(segment), reader_(of.events), see_(see) {}

  void run() {
    while (!reader_.atEnd()) {
      const size_t at = reader_.position();
      const Event event = reader_.takeEvent();
      if (see_) see_(event, to_.parts);
      const bool known = take(event, at);
      if (known && reader_.good()) continue;
      add(Landmark::Kind::Damaged, fmt::format("damaged at byte {} of segment {}", at, segment_ + 1));
      return;
    }
  }

private:
  void add(Landmark::Kind kind, std::string text) { to_.landmarks.push_back({kind, to_.parts, std::move(text)}); }

  // False: there is no such event, or it cannot be here.
  bool take(Event event, size_t at) {
    if (event == Event::Program || (event == Event::Surroundings && !group_)) group_ = at;
    switch (event) {
    case Event::State: return state(at);
    case Event::Forces: return forces();
    case Event::Repeat: return repeat();
    case Event::Part:
      group_.reset();
      to_.parts += whole_ ? 1 : 0;
      break;
    case Event::Fault: add(Landmark::Kind::Fault, "the program stopped with a fault"); break;
    case Event::Anew:
      whole_ = false;
      add(Landmark::Kind::Start, "started, or another state loaded");
      break;
    case Event::Mark: {
      const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
      add(Landmark::Kind::Note, {reinterpret_cast<const char*>(text.data()), text.size()});
      return true;
    }
    case Event::Lost:
      whole_ = false;
      add(Landmark::Kind::Lost, "events are missing");
      break;
    default: break;
    }
    return skipEvent(reader_, event);
  }
  bool repeat() {
    const uint64_t count = reader_.takeNumber();
    if (!whole_) return true;
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
    to_.states.push_back({segment_, group_.value_or(at), reader_.position(), to_.parts});
    group_.reset();
    whole_ = true;
    return true;
  }

  Contents& to_;
  uint32_t segment_;
  EventReader reader_;
  const Contents::See& see_;
  std::optional<size_t> group_; // where the events before a state begin
  bool whole_ = false;
};

} // namespace

std::vector<OutsideWrite> outsideWrites(std::span<const uint8_t> events, size_t at, runtime::RecordingMode mode) {
  using By = OutsideWrite::By;
  std::vector<OutsideWrite> writes;
  EventReader reader(events.subspan(at));
  const bool controlRuns = mode == runtime::RecordingMode::Control;
  bool inPart = false, within = false;
  while (!reader.atEnd()) {
    const Event event = reader.next();
    const bool isWrite = event == Event::Bytes || event == Event::Input;
    const bool ofNext = event == Event::Part || event == Event::Repeat || event == Event::Ended || (isWrite && !within);
    if (inPart && ofNext) return writes;
    (void)reader.takeEvent();
    if (!isWrite) {
      inPart = inPart || event == Event::Part;
      within = within || event == Event::Within;
      if (!skipEvent(reader, event)) return writes;
      continue;
    }
    const uint32_t offset = reader.takeNumber32();
    const auto count = static_cast<uint32_t>(reader.takeBytes(reader.takeNumber()).size());
    const By by = event == Event::Input ? By::Machine : controlRuns ? By::Client : inPart ? By::Control : By::Any;
    if (reader.good()) writes.push_back({offset, count, by});
  }
  return writes;
}

Contents::Contents(const Recording& recording, const See& see) : parts(recording.partsBefore) {
  for (uint32_t i = 0; i < recording.segments.size(); ++i) {
    segmentParts.push_back(parts);
    Skimmer(*this, i, recording.segments[i], see).run();
    if (const std::string& damage = recording.segments[i].damage; !damage.empty())
      landmarks.push_back({Landmark::Kind::Damaged, parts, damage});
  }
  std::ranges::stable_sort(landmarks, {}, &Landmark::part);
}

std::span<const Landmark> Contents::landmarksAt(uint64_t part) const {
  return std::ranges::equal_range(landmarks, part, {}, &Landmark::part);
}

// ---- files -------------------------------------------------------------------------------------------------------

namespace {

// Something is missing after what has been read so far.
void missing(Recording& to, std::string what) {
  if (!to.segments.empty() && to.segments.back().damage.empty()) to.segments.back().damage = std::move(what);
}

// The blocks of a file, in segments that each begin with a state. The last block may be cut off.
void readSegment(runtime::SegmentReader& reader, Recording& to) {
  Segment segment;
  runtime::RecordedBlock block;
  while (reader.next(block)) {
    if (block.afterGap) {
      if (!segment.events.empty()) to.segments.push_back(std::exchange(segment, {}));
      missing(to, fmt::format("{}: blocks before byte {} are damaged", reader.path(), block.offset));
    }
    segment.events.insert(segment.events.end(), block.events.begin(), block.events.end());
  }
  if (!reader.ended() && reader.rest() != 0)
    segment.damage = fmt::format("{} ends with {} bytes of a block that was cut off", reader.path(), reader.rest());
  to.segments.push_back(std::move(segment));
  to.problems.insert(to.problems.end(), reader.problems().begin(), reader.problems().end());
}

// The files, in the order in which they were written, whatever they are called now.
std::vector<runtime::SegmentReader> segmentsOf(const runtime::RecordingReader& reader, Recording& to) {
  std::vector<runtime::SegmentReader> segments;
  std::string problem;
  for (const runtime::SegmentFile& file : reader.segments()) {
    std::optional<runtime::SegmentReader> segment = runtime::SegmentReader::open(reader.pathOf(file), problem);
    if (segment)
      segments.push_back(std::move(*segment));
    else
      to.problems.push_back(problem);
  }
  std::ranges::stable_sort(segments, {}, [](const runtime::SegmentReader& segment) {
    return std::pair(segment.head().number, segment.head().wallUs);
  });
  const auto isSame = [&](const runtime::SegmentReader& a, const runtime::SegmentReader& b) {
    const bool same = a.head().run == b.head().run && a.head().number == b.head().number;
    if (same) to.problems.push_back(b.path() + " is a copy of " + a.path());
    return same;
  };
  segments.erase(std::unique(segments.begin(), segments.end(), isSame), segments.end());
  return segments;
}

// Whether the recording has this program now.
bool takeProgram(const runtime::RecordingReader& reader, uint64_t hash,
                 const std::vector<std::shared_ptr<const compiler::Compiled>>& known, Recording& to) {
  for (const auto& program : to.programs)
    if (program->codeHash == hash) return true;
  for (const auto& program : known)
    if (program->codeHash == hash) {
      to.programs.push_back(program);
      return true;
    }
  std::string problem;
  const std::optional<std::vector<uint8_t>> file = reader.program(hash, problem);
  if (!file) {
    to.problems.push_back(problem);
    return false;
  }
  Result<compiler::Compiled> program =
      compiler::programOf({reinterpret_cast<const char*>(file->data()), file->size()}, hash);
  if (!program.ok()) {
    to.problems.push_back(fmt::format("the program {}: {}", runtime::programName(hash), program.error()));
    return false;
  }
  to.programs.push_back(std::make_shared<compiler::Compiled>(std::move(program).value()));
  return true;
}

} // namespace

Result<Recording> readRecording(const std::string& path, std::vector<std::shared_ptr<const compiler::Compiled>> known) {
  std::string problem;
  const std::optional<runtime::RecordingReader> reader = runtime::RecordingReader::open(path, problem);
  if (!reader) return failure(problem);
  Recording recording;
  std::vector<runtime::SegmentReader> segments = segmentsOf(*reader, recording);
  const runtime::SegmentHead* last = nullptr; // of those that can be played
  for (runtime::SegmentReader& segment : segments) {
    const runtime::SegmentHead& head = segment.head();
    if (last == nullptr) recording.mode = head.mode;
    if (head.mode != recording.mode) {
      recording.problems.push_back(segment.path() + " was recorded in another way than the segments before it");
      continue;
    }
    if (!takeProgram(*reader, head.program, known, recording)) continue;
    if (last != nullptr && last->run == head.run && last->number + 1 != head.number)
      missing(recording,
              last->number + 2 == head.number
                  ? fmt::format("segment {} is missing, or cannot be read", last->number + 1)
                  : fmt::format("segments {} to {} are missing, or cannot be read", last->number + 1, head.number - 1));
    last = &head;
    readSegment(segment, recording);
  }
  recording.problems.insert(recording.problems.end(), reader->problems().begin(), reader->problems().end());
  if (recording.programs.empty())
    return failure(recording.problems.empty() ? "there is nothing to read in " + path : recording.problems[0]);
  return recording;
}

} // namespace rung::replay
