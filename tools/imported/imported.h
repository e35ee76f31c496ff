// From a file of a FANUC control, of LADDER-III or of the PMC simulator to a file of a project (docs/importing.md). The
// readers take text in UTF-8 without byte order mark, its lines end with LF or CR LF.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/text/position.h"

namespace rung::imported {

// The file that is read.
struct Source {
  std::string_view name; // as messages and the comments of the result show it
  std::string_view text;
};

// What a user must know about a place of the file.
struct Remark {
  text::Position at;
  std::string text;
  bool wrong = false; // a mistake in the file, which makes the result unusable
};

// "FILE:LINE:COLUMN: error: TEXT", or "note:" for a remark that is not about a mistake.
std::string textOf(const Source& source, const Remark& remark);

struct Imported {
  std::string text; // of the file to write
  std::vector<Remark> remarks;

  bool isUsable() const;
};

// PMC parameters: a file of `set` statements, which a scenario includes and the prompt of `rungc run` executes.
Imported initialValues(const Source& source);

// Symbols and comments: a section %@2-E, which is a file of a program.
Imported symbolSection(const Source& source);

// How the frames of a trace are turned into statements.
struct Sampling {
  int64_t us = 0;         // from one frame to the next: 1 µs to a minute
  uint32_t tolerance = 1; // frames before and after a sample in which an output must be the same to be expected
  int64_t settleUs = 0;   // to run with the signals of the first frame before the trace begins
};

// A signal trace: a scenario that sets the inputs of each frame and expects the outputs.
Imported scenarioOfTrace(const Source& source, const Sampling& sampling);

// A signal operation file: a scenario that sets what the file sets. It expects nothing.
Imported scenarioOfSignals(const Source& source);

} // namespace rung::imported
