// Reads the segments of a recording (recording_file.h), also of one that still grows. What is damaged is left out and
// named; what is whole is read. Not for the scan thread.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rtlib/load/file.h"
#include "rtlib/record/recording_file.h"

namespace rung::runtime {

struct RecordedBlock {
  BlockKind kind = BlockKind::Events;
  uint64_t offset = 0;         // in the file
  int64_t wallUs = 0;          // when it was written
  bool afterGap = false;       // blocks before it are damaged; then it begins with a state
  std::vector<uint8_t> events; // for a player; State: they begin with Event::Program or Event::Lost
};

class SegmentReader {
public:
  // Nothing: `problem` says why.
  static std::optional<SegmentReader> open(const std::string& path, std::string& problem);
  SegmentReader(SegmentReader&&) noexcept;
  SegmentReader& operator=(SegmentReader&&) noexcept;
  ~SegmentReader();

  const SegmentHead& head() const { return head_; }
  const std::string& path() const { return path_; }
  // The next block that is whole. False: there is none now; a file that grows may have one later.
  bool next(RecordedBlock& block);
  // Continues with this block, which is a state.
  void seek(uint64_t offset);
  // The blocks with states from the present position on, without their events; the position stays.
  std::vector<RecordedBlock> states();
  // Whether the recording ended here regularly.
  bool ended() const { return ended_; }
  // Bytes at the end of the file that are no whole block: one that is being written, or was cut off.
  uint64_t rest() const;
  // One sentence for each place that is damaged.
  const std::vector<std::string>& problems() const { return problems_; }

private:
  struct Inflate;
  SegmentReader(File file, std::string path, const SegmentHead& head);
  bool read(uint64_t offset, void* to, size_t size) const;
  uint64_t size() const;
  std::optional<BlockHead> blockAt(uint64_t offset, std::vector<uint8_t>& packed) const;
  std::optional<uint64_t> stateAfter(uint64_t offset) const;
  bool unpack(const BlockHead& head, const std::vector<uint8_t>& packed, RecordedBlock& block);
  bool skipDamage(uint64_t from);

  File file_;
  std::string path_;
  SegmentHead head_;
  std::unique_ptr<Inflate> inflate_;
  uint64_t at_ = sizeof(SegmentHead);
  bool gap_ = false;
  bool ended_ = false;
  std::vector<std::string> problems_;
};

// A recording: a folder, or one segment of it.
class RecordingReader {
public:
  // Nothing: `problem` says why there is nothing to read.
  static std::optional<RecordingReader> open(const std::string& path, std::string& problem);

  // By number; looked up again by `refresh`, when the recording grows.
  const std::vector<SegmentFile>& segments() const { return segments_; }
  void refresh();
  std::string pathOf(const SegmentFile& segment) const { return folder_ + "/" + segment.name; }
  // The bytes of a program that the recording has; nothing: `problem` says why.
  std::optional<std::vector<uint8_t>> program(uint64_t hash, std::string& problem) const;
  // What cannot be read of the folder, one sentence each.
  const std::vector<std::string>& problems() const { return problems_; }

private:
  std::string folder_;
  std::string only_; // the name of the only segment; "": all
  std::vector<SegmentFile> segments_;
  std::vector<std::string> problems_;
};

} // namespace rung::runtime
