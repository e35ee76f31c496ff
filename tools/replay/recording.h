// A recording in memory: what came to a program from outside (rtlib/record), in segments that can each be played by
// themselves, and the programs that it was.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "ir/support/result.h"
#include "rtlib/record/recording_file.h"

namespace rung::replay {

struct Segment {
  std::vector<uint8_t> events; // of a recording that grows they stay where they are
  bool continues = false;      // the segment before it, so that no state is needed to play it after that one
  int64_t beganUs = 0;         // since 1970: when its first and its last events were written; 0: unknown
  int64_t writtenUs = 0;
  std::string damage; // what is missing after it; "": nothing
};

struct Recording {
  std::vector<Segment> segments;
  uint32_t firstSegment = 0; // those before it have been dropped, and are empty
  // Compiled with marks and their modules as built (CompileRequest::marks, keepBuilt); the first one first.
  std::vector<std::unique_ptr<compiler::Compiled>> programs;
  runtime::RecordingMode mode = runtime::RecordingMode::Bytes;
  std::vector<std::string> problems; // what of its files could not be read
};

// A place in a recording at which a whole state lies.
struct StatePoint {
  uint32_t segment = 0;
  size_t begins = 0; // offset of the first event that belongs to it
  size_t ends = 0;   // offset after it
  uint64_t part = 0; // parts before it
};

struct Landmark {
  enum class Kind : uint8_t {
    Start,   // the program was started, or other state was loaded
    Note,    // a mark: of a person, or a statement of a scenario
    Fault,   // `part` has ended with it
    Lost,    // events are missing
    Damaged, // the rest of the segment cannot be read
  };
  Kind kind = Kind::Note;
  uint64_t part = 0; // parts before it; of a Fault with the one that has it
  std::string text;
};

// What a recording contains, without playing it. Parts are counted from the beginning; those that cannot be played,
// because no state comes before them, do not count.
class Contents {
public:
  explicit Contents(const Recording& recording) { grow(recording); }
  // Adds what has been appended to the recording since, and removes what it has dropped.
  void grow(const Recording& recording);

  uint64_t parts = 0;
  std::vector<StatePoint> states;     // ascending
  std::vector<Landmark> landmarks;    // by part
  uint64_t droppedLandmarks = 0;      // before the first of them
  std::vector<uint64_t> segmentParts; // by segment: parts before it

  // Parts that had run at this time, about; of a recording whose segments have times.
  uint64_t partAt(const Recording& recording, int64_t wallUs) const;

private:
  friend class Skimmer;
  void drop(const Recording& recording);

  size_t read_ = 0;          // of the events of the last segment
  bool whole_ = false;       // a state has come before
  bool unreadable_ = false;  // up to the next segment that does not continue
  bool damageNoted_ = false; // of the last segment
};

} // namespace rung::replay
