// A recording in memory: what came to a program from outside (rtlib/record), in segments that can each be played by
// themselves, and the programs that it was.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
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
  std::vector<uint8_t> events;
  std::string damage; // what is missing after it; "": nothing
};

struct Recording {
  std::vector<Segment> segments;
  uint64_t partsBefore = 0; // that came before and are no longer in it
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
// The events from `at` on, up to the end of the part that they are of.
std::vector<OutsideWrite> outsideWrites(std::span<const uint8_t> events, size_t at, runtime::RecordingMode mode);

// What a recording contains, without playing it. Parts are counted from the beginning; those that cannot be played,
// because no state comes before them, do not count.
struct Contents {
  // `see`, if there is one, is called for each event, with the parts before it.
  using See = std::function<void(runtime::Event event, uint64_t part)>;
  explicit Contents(const Recording& recording, const See& see = {});

  uint64_t parts = 0;
  std::vector<StatePoint> states;  // ascending
  std::vector<Landmark> landmarks; // by part
  // Those with so many parts before them.
  std::span<const Landmark> landmarksAt(uint64_t part) const;
  std::vector<uint64_t> segmentParts; // by segment: parts before it
  std::vector<ForceChange> forces;    // by part
};

// Reads the files of a recording: a folder, or one segment (docs/recording.md). `known`: programs that it may be of, in
// addition to those that it has. Fails if there is nothing to read, or no program for any of it.
Result<Recording> readRecording(const std::string& path,
                                std::vector<std::shared_ptr<const compiler::Compiled>> known = {});

} // namespace rung::replay
