// Why a value is what it is, as a chain: the last write of the cell, what decided it in the rung that wrote, the last
// writes of these, and so on back to inputs, the clock, people and the beginning.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ir/core/memory_use.h"
#include "tools/replay/past.h"

namespace rung::replay {

struct Reason {
  enum class Kind : uint8_t {
    Rung,    // a rung wrote it
    Copy,    // a task has copied it, at its beginning or end
    Outside, // the machine, the control or a person wrote it
    Machine, // the host wrote it as an input
    Client,  // a person or another program wrote it, through the host
    Control, // the control or the machine wrote it, within the part
    Forced,  // a person holds it
    Start,   // it is so since the program was started, or a state was loaded
    Before,  // it is so since the recording began
    Clock,   // the program's clock
    Answer,  // of the control, to a request
    Kept,    // the chain is not followed further: `most` reasons are there, or it is there already
  };
  Kind kind = Kind::Before;
  std::string name;  // as users write it; of state of the compiler "its own state"
  std::string value; // as scenarios write it
  uint64_t part = 0; // since this part
  int64_t us = 0;    // and this time
  std::string rung;  // `rung 3 "title", main.pmc:12`
  std::string file;  // of the operation; "": unknown
  uint32_t line = 0;
  uint32_t column = 0;      // of the element that it belongs to; 0: unknown
  uint32_t lowered = kNone; // of a Rung, over all routines
  bool alone = false;       // in the rung above: it decided alone
  bool partForced = false;  // some of its bits are held
  bool isIndex = false;     // in the rung above: it determined the address
  bool computed = false;    // written at a computed address
  bool unchanged = false;   // of a Rung: it has the value since the recording began, and is written again and again
  std::string note;         // such as the statement of a scenario that set it
  // Of a Rung: its timers that decided, such as "TMRB 1 runs: 0.016 s of 0.032 s".
  std::vector<std::string> timers;
  // What decided; the one that changed last comes first, and the chain continues with it.
  std::vector<Reason> because;
};

struct Explanation {
  Reason reason;
  std::string beginning; // of what is known: WhyOptions
  // For a bit: what would have to be different for the rung that wrote it last. Empty: unknown.
  std::vector<std::string> toChange;
  // Rungs that write the place and did not run in the scan, and why not; of a value that nothing has written, what
  // could.
  std::vector<std::string> skipped;
  std::string also; // other rungs that wrote it in the scan; "": none
};

struct WhyOptions {
  size_t most = 40;               // reasons
  uint64_t mostParts = 1'000'000; // of the search for a change
  std::string beginning = "the recording began";
};

// The value that the place has at the present position of the past, which stays.
Explanation why(Past& past, const runtime::Ref& place, const WhyOptions& options = {});

// Each write of the place in the part that has led to the present position: "rung 3 "title", main.pmc:12: 1".
std::vector<std::string> writesOf(Past& past, const runtime::Ref& place);

// What gave the value: "written by rung 3 …", "forced by a person"; "" if the chain says nothing about it.
std::string kindText(const Reason& reason);
// What a text leaves out is counted.
struct TextLimits {
  size_t steps = SIZE_MAX;  // of the chain
  size_t places = SIZE_MAX; // of one step, and rungs that did not run
};
// As lines of text; the first is that of the value itself.
std::string textOf(const Explanation& explanation, const TextLimits& limits = {});
std::string jsonOf(const Explanation& explanation);

} // namespace rung::replay
