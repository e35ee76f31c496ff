// Packs what comes out of a PartStream and appends it to the segments of a folder, in a thread of its own. Whatever the
// disk does, the scan thread does not notice it: what cannot be written is counted and left out.
#pragma once
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "rtlib/load/file.h"
#include "rtlib/record/part_stream.h"
#include "rtlib/record/recording_file.h"

namespace rung::runtime {

struct RecordingOptions {
  std::string folder;                        // made if it does not exist; the folder that it is in must
  uint64_t limitBytes = uint64_t{512} << 20; // of segments that are not kept
  uint64_t keptBytes = uint64_t{256} << 20;  // of kept ones
  uint64_t segmentBytes = uint64_t{8} << 20; // after which the next one begins
  int64_t segmentUs = 600'000'000;
};

struct RecordingState {
  std::string folder;
  std::string file;     // that is written now; "": none
  int64_t sinceUs = 0;  // since 1970: when the oldest segment began; 0: there is none
  uint64_t bytes = 0;   // of all segments
  uint64_t written = 0; // bytes since the start
  uint64_t raw = 0;     // the same before packing
  uint64_t losses = 0;  // gaps in the recording
  std::string problem;  // why nothing is written now, or was a moment ago because the folder had gone; "": all is well
};

// The disk as a writer sees it; a test has one that is full.
class AppendedFile {
public:
  virtual ~AppendedFile() = default;
  // False, with a sentence in `error`: the file is as before.
  virtual bool append(std::span<const uint8_t> bytes, std::string& error) = 0;
};
using OpenFile = std::function<std::unique_ptr<AppendedFile>(const std::string& path, std::string& error)>;
std::unique_ptr<AppendedFile> openAppended(const std::string& path, std::string& error);

class RecordingWriter {
public:
  // Nothing is written before `start` or `look`. The stream outlives the writer. Throws std::runtime_error if the
  // folder cannot be made or another process records into it.
  RecordingWriter(PartStream& stream, RecordingMode mode, const RecordingOptions& options,
                  const OpenFile& open = &openAppended);
  // Writes what is left.
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  // Begins the thread.
  void start();
  // What the thread does again and again; for tests without it.
  void look();

  // Any thread; may wait for the disk.
  void mark(std::string_view text); // the segments of now are kept, too
  void keep();                      // the segments of now
  void follow();                    // for two seconds blocks are written 30 times a second, otherwise 12 times
  RecordingState state() const;
  // Adds the file of a program that may be recorded: `bytes` are those of its shared object, or the text of its IR.
  void addProgram(uint64_t hash, std::span<const uint8_t> bytes);

private:
  struct Deflate;
  struct FolderId {
    uint64_t device = 0, number = 0; // 0: there is none
    bool operator==(const FolderId&) const = default;
  };
  static FolderId idOf(const std::string& folder) noexcept;
  std::string useFolder();
  void lookForFolder();
  void writeProgram(uint64_t hash, std::string_view bytes);
  void run();
  void turn();
  void take(std::span<const uint8_t> record);
  void beginState(uint64_t program);
  bool beginSegment(uint64_t program);
  void writeBlock(BlockKind kind);
  void failed(const std::string& why);
  void takeMarks();
  void keepNow();
  void makeRoom();
  void deletePrograms();

  PartStream& stream_;
  const RecordingMode mode_;
  const RecordingOptions options_;
  const OpenFile open_;
  const uint64_t run_;

  mutable std::mutex mutex_; // of all below
  DiskLock lock_;
  std::unique_ptr<Deflate> deflate_;
  std::unique_ptr<AppendedFile> file_; // null: none is written
  std::vector<uint8_t> pending_;       // events of the next block
  bool beginsState_ = false;           // the next block begins with a state
  bool gap_ = false;                   // events were left out since the last block
  uint64_t program_ = 0;               // of the segment
  uint64_t number_ = 0;                // of the present or last segment
  uint64_t segmentBytes_ = 0;
  int64_t segmentUs_ = 0;
  uint64_t written_ = 0, raw_ = 0, lostBlocks_ = 0;
  bool dropped_ = false; // nothing is written until the next state
  uint32_t seenFaults_ = 0;
  std::string problem_, programProblem_;
  std::map<uint64_t, File> programs_; // of this run; a file stays readable when the folder is moved
  FolderId folder_;                   // in which the lock is
  std::string moved_;                 // what happened to the former folder, and when
  int64_t movedUs_ = 0;
  std::vector<std::string> marks_;
  bool keeps_ = false;
  int64_t followUntilUs_ = 0;

  std::condition_variable wake_;
  bool ends_ = false;
  std::thread thread_;
};

} // namespace rung::runtime
