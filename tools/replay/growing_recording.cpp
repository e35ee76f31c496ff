// See growing_recording.h.
#include "tools/replay/growing_recording.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "compiler/embedded_ir.h"

namespace rung::replay {
namespace {

constexpr size_t kSegmentBytes = 64 * 1024;          // room of a segment in memory, at least
constexpr std::chrono::milliseconds kLookEvery{200}; // for other files
constexpr uint64_t kPacked = 8;                      // events take at most so many times the bytes of their file

} // namespace

Result<std::unique_ptr<GrowingRecording>>
GrowingRecording::open(const std::string& path, const RecordingLimits& limits,
                       std::vector<std::shared_ptr<const compiler::Compiled>> known) {
  std::string problem;
  std::optional<runtime::RecordingReader> reader = runtime::RecordingReader::open(path, problem);
  if (!reader) return failure(problem);
  std::unique_ptr<GrowingRecording> made(new GrowingRecording(std::move(*reader), limits, std::move(known)));
  made->recording_.problems = made->reader_.problems();
  const std::vector<Headed> files = made->filesInOrder();
  for (size_t i = made->firstOf(files); i < files.size(); ++i) {
    made->openFile(files[i].file);
    (void)made->readBlocks();
  }
  const Recording& recording = made->recording_;
  if (recording.programs.empty())
    return failure(recording.problems.empty() ? "there is nothing to read in " + path : recording.problems[0]);
  return made;
}

// The files, in the order in which they were written, whatever they are called now.
std::vector<GrowingRecording::Headed> GrowingRecording::filesInOrder() {
  std::vector<Headed> files;
  std::string problem;
  for (const runtime::SegmentFile& file : reader_.segments()) {
    if (const auto head = runtime::readSegmentHead(reader_.pathOf(file), problem))
      files.push_back({file, *head});
    else
      recording_.problems.push_back(problem);
  }
  std::ranges::stable_sort(files, {}, [](const Headed& one) { return std::pair(one.head.number, one.head.wallUs); });
  const auto isSame = [&](const Headed& a, const Headed& b) {
    const bool same = a.head.run == b.head.run && a.head.number == b.head.number;
    if (same) recording_.problems.push_back(reader_.pathOf(b.file) + " is a copy of " + reader_.pathOf(a.file));
    return same;
  };
  files.erase(std::unique(files.begin(), files.end(), isSame), files.end());
  return files;
}

// Of the newest files, as many as the limits allow.
size_t GrowingRecording::firstOf(const std::vector<Headed>& files) const {
  if (files.empty()) return 0;
  size_t first = files.size() - 1;
  const int64_t newest = files[first].head.wallUs;
  uint64_t bytes = files[first].file.bytes;
  while (first != 0 && newest - files[first].head.wallUs < limits_.us &&
         (bytes += files[first - 1].file.bytes) < limits_.bytes / kPacked)
    --first;
  return first;
}

bool GrowingRecording::take() {
  const bool dropped = drop();
  const bool any = readBlocks() || dropped;
  if (any || Clock::now() - looked_ < kLookEvery) return any;
  looked_ = Clock::now();
  return nextFiles();
}

// A file that has a successor is not written any more.
bool GrowingRecording::nextFiles() {
  reader_.refresh();
  bool any = false;
  for (const runtime::SegmentFile& file : reader_.segments()) {
    if (file.number <= fileNumber_) continue;
    (void)readBlocks();
    openFile(file);
    any = readBlocks() || any;
  }
  return any;
}

void GrowingRecording::openFile(const runtime::SegmentFile& file) {
  endFile();
  fileNumber_ = file.number;
  std::string problem;
  std::optional<runtime::SegmentReader> opened = runtime::SegmentReader::open(reader_.pathOf(file), problem);
  if (!opened) {
    recording_.problems.push_back(problem);
    return;
  }
  if (!std::exchange(hasMode_, true)) recording_.mode = opened->head().mode;
  if (opened->head().mode != recording_.mode) {
    recording_.problems.push_back(file.name + " was recorded in another way than the segments before it");
    return;
  }
  if (!takeProgram(opened->head().program))
    return missing(fmt::format("{} cannot be played without its program {}", opened->path(),
                               runtime::programName(opened->head().program)));
  const uint64_t number = opened->head().number;
  if (last_ && last_->run == opened->head().run && last_->number + 1 < number)
    missing(last_->number + 2 == number
                ? fmt::format("segment {} is missing, or cannot be read", last_->number + 1)
                : fmt::format("segments {} to {} are missing, or cannot be read", last_->number + 1, number - 1));
  last_ = opened->head();
  file_ = std::move(opened);
  fileProblems_ = 0;
  begins_ = true;
}

// Something is missing after what has been read so far.
void GrowingRecording::missing(std::string what) {
  std::vector<Segment>& segments = recording_.segments;
  if (!segments.empty() && segments.back().damage.empty()) segments.back().damage = std::move(what);
}

// Whether the recording has this program now.
bool GrowingRecording::takeProgram(uint64_t hash) {
  for (const auto& program : recording_.programs)
    if (program->codeHash == hash) return true;
  for (const auto& program : known_)
    if (program->codeHash == hash) {
      recording_.programs.push_back(program);
      return true;
    }
  std::string problem;
  const std::optional<std::vector<uint8_t>> file = reader_.program(hash, problem);
  if (!file) {
    recording_.problems.push_back(problem);
    return false;
  }
  Result<compiler::Compiled> program =
      compiler::programOf({reinterpret_cast<const char*>(file->data()), file->size()}, hash);
  if (!program.ok()) {
    recording_.problems.push_back(fmt::format("the program {}: {}", runtime::programName(hash), program.error()));
    return false;
  }
  recording_.programs.push_back(std::make_shared<compiler::Compiled>(std::move(program).value()));
  return true;
}

bool GrowingRecording::readBlocks() {
  if (!file_) return false;
  bool any = false;
  runtime::RecordedBlock block;
  while (file_->next(block)) {
    if (block.afterGap) missing(fmt::format("{}: blocks before byte {} are damaged", file_->path(), block.offset));
    begins_ = begins_ || block.afterGap;
    append(block);
    any = true;
  }
  const std::vector<std::string>& problems = file_->problems();
  recording_.problems.insert(recording_.problems.end(), problems.begin() + static_cast<ptrdiff_t>(fileProblems_),
                             problems.end());
  fileProblems_ = problems.size();
  return any;
}

void GrowingRecording::append(const runtime::RecordedBlock& block) {
  std::vector<Segment>& segments = recording_.segments;
  const bool continues = !std::exchange(begins_, false);
  const auto room = [&] { return segments.back().events.capacity() - segments.back().events.size(); };
  if (!continues || segments.empty() || room() < block.events.size()) {
    Segment& made = segments.emplace_back();
    made.continues = continues;
    made.beganUs = block.wallUs;
    made.events.reserve(std::max(kSegmentBytes, block.events.size()));
    bytes_ += made.events.capacity();
  }
  Segment& last = segments.back();
  last.events.insert(last.events.end(), block.events.begin(), block.events.end());
  last.writtenUs = block.wallUs;
  if (block.kind == runtime::BlockKind::State) lastState_ = static_cast<uint32_t>(segments.size() - 1);
}

void GrowingRecording::endFile() {
  if (file_ && !file_->ended() && file_->rest() != 0) {
    if (begins_) recording_.segments.emplace_back(); // it has no whole block
    missing(fmt::format("{} ends with {} bytes of a block that was cut off", file_->path(), file_->rest()));
  }
  if (file_ && file_->ended() && file_->rest() != 0)
    recording_.problems.push_back(
        fmt::format("{} has {} bytes after its end, which no recorder wrote", file_->path(), file_->rest()));
  file_.reset();
}

// Of the segments before the last state, which is needed to play what comes.
bool GrowingRecording::drop() {
  if (recording_.segments.empty()) return false;
  const uint32_t before = recording_.firstSegment;
  const int64_t oldest =
      recording_.segments.back().writtenUs - std::min(limits_.us, recording_.segments.back().writtenUs);
  while (recording_.firstSegment < lastState_) {
    Segment& first = recording_.segments[recording_.firstSegment];
    if (bytes_ <= limits_.bytes && first.writtenUs >= oldest) break;
    bytes_ -= first.events.capacity();
    std::vector<uint8_t>().swap(first.events);
    ++recording_.firstSegment;
  }
  return recording_.firstSegment != before;
}

Recording GrowingRecording::finish() && {
  endFile();
  return std::move(recording_);
}

Result<Recording> readRecording(const std::string& path, std::vector<std::shared_ptr<const compiler::Compiled>> known) {
  Result<std::unique_ptr<GrowingRecording>> growing = GrowingRecording::open(path, {}, std::move(known));
  if (!growing.ok()) return growing.failure();
  return std::move(*growing.value()).finish();
}

} // namespace rung::replay
