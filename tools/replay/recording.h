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
  std::vector<uint8_t> events;
  std::string damage; // what is missing after it; "": nothing
};

struct Recording {
  std::vector<Segment> segments;
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
struct Contents {
  explicit Contents(const Recording& recording);

  uint64_t parts = 0;
  std::vector<StatePoint> states;     // ascending
  std::vector<Landmark> landmarks;    // by part
  std::vector<uint64_t> segmentParts; // by segment: parts before it
};

// Reads the files of a recording: a folder, or one segment (docs/recording.md). `known`: programs that it may be of, in
// addition to those that it has. Fails if there is nothing to read, or no program for any of it.
Result<Recording> readRecording(const std::string& path, std::vector<std::unique_ptr<compiler::Compiled>> known = {});

} // namespace rung::replay
