// A recording in memory: what came to a program from outside (rtlib/record), in segments that can each be played by
// themselves, and the programs that it was.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "ir/support/result.h"
#include "rtlib/core/runner.h"
#include "rtlib/record/events.h"
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
  uint64_t partsBefore = 0;  // that came before and are no longer in it
  // Compiled with marks and their modules as built (CompileRequest::marks, keepBuilt); the first one first.
  std::vector<std::shared_ptr<const compiler::Compiled>> programs;
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

// From this part on, these bits of the memory block are forced.
struct ForceChange {
  uint64_t part = 0; // parts before it
  std::vector<core::ForcedBits> bits;
};

// What others have written to the program's memory before a part, or in hooks within it, by the events of the part.
struct OutsideWrite {
  enum class By : uint8_t {
    Machine, // inputs that the host binds
    Client,  // a person or another program, through the host
    Control, // in a hook; or the machine, where its control does not run again
    Any,     // one of these: between two parts of a program in a simulated control
  };
  uint32_t offset = 0, count = 0; // in the block
  By by = By::Any;
};
// Of a part in `events`, which follow on those of the state `before` them (Player::state): the first one after
// `skipped` others.
std::vector<OutsideWrite> outsideWrites(std::span<const uint8_t> before, std::span<const uint8_t> events,
                                        uint64_t skipped, runtime::RecordingMode mode);

// What a recording contains, without playing it. Parts are counted from the beginning; those that cannot be played,
// because no state comes before them, do not count.
class Contents {
public:
  // `see`, if there is one, is called for each event, with the parts before it.
  using See = std::function<void(runtime::Event event, uint64_t part)>;
  explicit Contents(const Recording& recording, const See& see = {}) { grow(recording, see); }
  // Adds what has been appended to the recording since, and removes what it has dropped.
  void grow(const Recording& recording, const See& see = {});

  uint64_t parts = 0;
  std::vector<StatePoint> states;     // ascending
  std::vector<Landmark> landmarks;    // by part
  uint64_t droppedLandmarks = 0;      // before the first of them
  std::vector<uint64_t> segmentParts; // by segment: parts before it
  std::vector<ForceChange> forces;    // by part

  // Those with so many parts before them.
  std::span<const Landmark> landmarksAt(uint64_t part) const;
  // Parts that had run at this time, about; of a recording whose segments have times.
  uint64_t partAt(const Recording& recording, int64_t wallUs) const;

private:
  friend class Skimmer;
  void drop(const Recording& recording);

  size_t read_ = 0;                 // of the events of the last segment
  runtime::Places places_;          // that the next events refer to
  bool whole_ = false;              // a state has come before
  std::optional<uint64_t> program_; // of the last one; nothing: there was none
  bool unreadable_ = false;         // up to the next segment that does not continue
  bool damageNoted_ = false;        // of the last segment
};
} // namespace rung::replay
