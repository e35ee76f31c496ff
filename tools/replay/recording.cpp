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
    case Event::Program:
      group_ = at;
      numbers(1);
      return true;
    case Event::Surroundings:
      if (!group_) group_ = at;
      numbers(3);
      return true;
    case Event::Inputs: return inputs();
    case Event::Configured: numbers(4); return bytes();
    case Event::Function: numbers(3); return true;
    case Event::Abort:
    case Event::Served:
    case Event::Decision: numbers(1); return true;
    case Event::Saved: return true;
    case Event::Outputs: numbers(2 * reader_.takeNumber()); return true;
    case Event::Forces: numbers(3 * reader_.takeNumber()); return true;
    case Event::Part:
    case Event::Next:
      numbers(event == Event::Part ? 2 : 0);
      group_.reset();
      to_.parts += whole_ ? 1 : 0;
      return true;
    case Event::Repeat: to_.parts += whole_ ? reader_.takeNumber() : (numbers(1), 0); return true;
    case Event::Clock:
    case Event::Stopped:
    case Event::Within:
    case Event::Task:
    case Event::Hash: numbers(1); return true;
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
    case Event::Bytes:
    case Event::Input:
    case Event::Places: break; // the last one is only in states of a player
    }
    return runtime::isRun(event) && written(event);
  }
  bool written(Event first) {
    runtime::Places::Run run;
    std::span<const uint8_t> bytes;
    return runtime::takeRun(reader_, places_, first, run, bytes);
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
    to_.states.push_back({segment_, group_.value_or(at), reader_.position(), to_.parts});
    group_.reset();
    places_.clear();
    whole_ = true;
    return true;
  }

  Contents& to_;
  uint32_t segment_;
  EventReader reader_;
  runtime::Places places_;
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
  std::ranges::stable_sort(landmarks, {}, &Landmark::part);
}

// ---- files -------------------------------------------------------------------------------------------------------

namespace {

// The blocks of a file, in segments that each begin with a state. The last block may be cut off.
void readSegment(runtime::SegmentReader& reader, Recording& to) {
  Segment segment;
  runtime::RecordedBlock block;
  while (reader.next(block)) {
    if (block.afterGap && !segment.events.empty()) {
      segment.damage = fmt::format("{}: blocks before byte {} are damaged", reader.path(), block.offset);
      to.segments.push_back(std::exchange(segment, {}));
    }
    segment.events.insert(segment.events.end(), block.events.begin(), block.events.end());
  }
  if (!reader.ended() && reader.rest() != 0)
    segment.damage = fmt::format("{} ends with {} bytes of a block that was cut off", reader.path(), reader.rest());
  to.segments.push_back(std::move(segment));
  to.problems.insert(to.problems.end(), reader.problems().begin(), reader.problems().end());
}

// Whether the recording has this program now.
bool takeProgram(const runtime::RecordingReader& reader, uint64_t hash,
                 std::vector<std::unique_ptr<compiler::Compiled>>& known, Recording& to) {
  for (const auto& program : to.programs)
    if (program->codeHash == hash) return true;
  for (auto& program : known)
    if (program && program->codeHash == hash) {
      to.programs.push_back(std::move(program));
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
  to.programs.push_back(std::make_unique<compiler::Compiled>(std::move(program).value()));
  return true;
}

} // namespace

Result<Recording> readRecording(const std::string& path, std::vector<std::unique_ptr<compiler::Compiled>> known) {
  std::string problem;
  const std::optional<runtime::RecordingReader> reader = runtime::RecordingReader::open(path, problem);
  if (!reader) return failure(problem);
  Recording recording;
  bool first = true;
  for (const runtime::SegmentFile& file : reader->segments()) {
    std::optional<runtime::SegmentReader> segment = runtime::SegmentReader::open(reader->pathOf(file), problem);
    if (!segment) {
      recording.problems.push_back(problem);
      continue;
    }
    if (first) recording.mode = segment->head().mode;
    first = false;
    if (segment->head().mode != recording.mode) {
      recording.problems.push_back(file.name + " was recorded in another way than the segments before it");
      continue;
    }
    if (takeProgram(*reader, segment->head().program, known, recording)) readSegment(*segment, recording);
  }
  recording.problems.insert(recording.problems.end(), reader->problems().begin(), reader->problems().end());
  if (recording.programs.empty())
    return failure(recording.problems.empty() ? "there is nothing to read in " + path : recording.problems[0]);
  return recording;
}

} // namespace rung::replay
