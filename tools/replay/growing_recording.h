// Reads the files of a recording (docs/recording.md), also while a host still writes them.
//
//   auto growing = GrowingRecording::open(folder, {.bytes = 64 << 20, .us = 600'000'000});
//   auto past = Past::open(growing.value()->recording(), {});
//   if (growing.value()->take()) past.value()->grown();
//
// What is appended moves nothing that is there. With limits the oldest segments are dropped; numbers of segments and
// parts stay as they are.
#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rtlib/record/recording_reader.h"
#include "tools/replay/recording.h"

namespace rung::replay {

// What is kept in memory, and as much more as is needed to play that.
struct RecordingLimits {
  uint64_t bytes = UINT64_MAX; // of events
  int64_t us = INT64_MAX;      // before what was written last
};

class GrowingRecording {
public:
  // Reads what there is: a folder, or one segment. `known`: programs that it may be of, in addition to those that it
  // has. Fails if there is nothing to read, or no program for any of it.
  static Result<std::unique_ptr<GrowingRecording>> open(const std::string& path, const RecordingLimits& limits,
                                                        std::vector<std::shared_ptr<const compiler::Compiled>> known);
  GrowingRecording(const GrowingRecording&) = delete;
  GrowingRecording& operator=(const GrowingRecording&) = delete;

  const Recording& recording() const { return recording_; }
  // Appends what has been written since, and drops what exceeds the limits. Whether there was anything; then
  // Past::grown() is to be called before anything else of a Past of this recording.
  bool take();
  // Whether the host has ended the recording regularly.
  bool ended() const { return file_ && file_->ended(); }
  // The recording, as one that grows no more: what follows its last whole block was cut off.
  Recording finish() &&;

private:
  using Clock = std::chrono::steady_clock;
  GrowingRecording(runtime::RecordingReader reader, const RecordingLimits& limits,
                   std::vector<std::shared_ptr<const compiler::Compiled>> known)
      : reader_(std::move(reader)), limits_(limits), known_(std::move(known)) {}

  struct Headed {
    runtime::SegmentFile file;
    runtime::SegmentHead head;
  };
  std::vector<Headed> filesInOrder();
  size_t firstOf(const std::vector<Headed>& files) const;
  bool nextFiles();
  void openFile(const runtime::SegmentFile& file);
  void missing(std::string what);
  bool takeProgram(uint64_t hash);
  bool readBlocks();
  void append(const runtime::RecordedBlock& block);
  void endFile();
  bool drop();

  runtime::RecordingReader reader_;
  RecordingLimits limits_;
  std::vector<std::shared_ptr<const compiler::Compiled>> known_;
  Recording recording_;
  std::optional<runtime::SegmentHead> last_;   // of the last file that can be played
  std::optional<runtime::SegmentReader> file_; // nothing: none, or one that cannot be read
  uint64_t fileNumber_ = 0;                    // of the last one that was looked at; 0: none
  size_t fileProblems_ = 0;                    // of it that are known
  bool begins_ = false;                        // the next block begins a segment
  bool hasMode_ = false;
  uint32_t lastState_ = 0;     // the last segment with a state
  uint64_t bytes_ = 0;         // of all segments
  Clock::time_point looked_{}; // for files
};

// Reads a recording that has ended.
Result<Recording> readRecording(const std::string& path,
                                std::vector<std::shared_ptr<const compiler::Compiled>> known = {});

} // namespace rung::replay
