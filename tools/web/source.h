// Where the page's pictures come from: a program that runs in this process, a machine that is followed, a recording.
#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ir/support/result.h"
#include "tools/web/shown_program.h"

namespace rung::web {

enum class RunState : uint8_t {
  Running,
  Paused,
  Past,
  Fault,
  Stopped, // by the operator
  Lost,    // the machine cannot be reached
};

// The program that is shown.
struct Drawn {
  uint32_t number = 0; // other for another program
  std::shared_ptr<const ShownProgram> program;
};

struct ShownMessage {
  std::string number; // as operators know it
  std::string text;
};

struct ForcedCell {
  std::string name;
  std::string value;
  std::vector<uint32_t> rows; // NameRow::id of the names of this cell
};

// Everything that the page shows of one scan.
struct Picture {
  uint64_t revision = 0; // larger in every picture
  uint64_t scan = 0;
  int64_t us = 0; // on the program's clock
  // The operator has stopped the program: the scan whose rungs are shown, the last one that ran. 0: they are of `scan`.
  uint64_t ranLast = 0;
  Drawn drawn;
  RunState state = RunState::Running;
  bool follows = false; // it continues by itself
  std::string fault;
  std::string notice;            // what people must know besides, such as that the machine cannot be reached
  std::string mayWrite;          // as Source::mayWrite
  std::vector<uint8_t> elements; // by element of the program (ElementState)
  std::map<std::string, std::string> values; // of what is followed: by name
  std::vector<ShownMessage> messages;
  std::vector<ForcedCell> forces;
  uint64_t firstScan = 0; // how far back it can go
  uint64_t lastScan = 0;  // the newest one
  uint64_t lastEvent = 0; // number of the newest entry of the log
  std::string trigger;    // the condition that is looked for; "": none
};

// What a page wants done.
struct Order {
  enum class Kind : uint8_t { Run, Pause, Step, Seek, Set, Force, Unforce, Mark, Reload, Statement };
  Kind kind = Kind::Pause;
  int64_t scans = 0; // Step: forwards or backwards; Seek: to this scan
  std::string name;  // Set, Force, Unforce; Mark: the text; Statement: the whole line
  std::string value;
};

struct Event {
  uint64_t number = 0;
  uint64_t scan = 0;
  int64_t us = 0;
  std::string kind; // "message", "gone", "acknowledged", "fault", "trigger", "set", "force", "statement", "mark"
  std::string text;
};

// What decided in a step of the chain.
struct WhyCause {
  std::string name;
  std::string value;         // "": it has none, such as the clock
  std::vector<uint32_t> ids; // NameRow::id of the names of this place
  bool alone = false;        // its other value alone would have given another result
};

// A step of the chain that leads to a value.
struct WhyStep {
  uint32_t depth = 0;
  std::string text;
  uint64_t scan = 0;           // since when
  std::optional<uint32_t> row; // of the rung that wrote
  std::vector<WhyCause> causes;
};

struct Why {
  std::string text;
  std::vector<WhyStep> steps{};        // empty: the text is all
  std::vector<std::string> toChange{}; // as replay::Explanation has them
  std::vector<std::string> skipped{};
};

// Values of names scan by scan.
struct ScanTrace {
  uint64_t firstScan = 0;
  std::vector<std::vector<std::string>> values; // by name, then by scan
};

// How often each rung has run in some scans, and what share of all work it was.
struct RungShare {
  uint32_t rung = 0; // number, as drawn
  uint64_t runs = 0;
  uint64_t operations = 0; // of all these runs, as if no branch within a rung were left out
};
struct Shares {
  uint64_t firstScan = 0, lastScan = 0;
  std::vector<RungShare> rungs; // all that can run, in the order of the program
};

// Any thread may call these.
class Source {
public:
  virtual ~Source() = default;
  // The newest picture, once it is newer than `after`; after `wait` the same one again. Null: none yet. `page` names a
  // page, which follows the values of `names`; a page that has not asked for some seconds follows nothing.
  virtual std::shared_ptr<const Picture> picture(const std::string& page, const std::vector<std::string>& names,
                                                 uint64_t after, std::chrono::milliseconds wait) = 0;
  // The program of the newest picture.
  virtual Drawn drawn() = 0;
  // What was done, in words; fails if it was not.
  virtual Result<std::string> execute(const Order& order) = 0;
  // Entries after the one with this number, oldest first; at most kMostEvents are kept.
  static constexpr size_t kMostEvents = 1000;
  virtual std::vector<Event> events(uint64_t after) = 0;
  // Why the value of a name is what it is, at the picture that is shown.
  virtual Result<Why> why(const std::string& name) = 0;
  // The values of these names in the last `scans` scans up to `last`, or up to the one that is shown if `last` is 0; a
  // name that does not exist has the value "".
  virtual Result<ScanTrace> trace(const std::vector<std::string>& names, uint64_t scans, uint64_t last) = 0;
  // Of the last `scans` scans up to the one that is shown.
  virtual Result<Shares> shares(uint64_t scans) = 0;
  // Each scan in which the condition (docs/replay.md) begins to hold gets an entry in the log, from now on, or of a
  // recording everywhere; "": no condition. Returns what is looked for, in words.
  virtual Result<std::string> setTrigger(const std::string& condition) = 0;
  // Notes in the log that the messages that are shown have been seen.
  virtual Result<std::string> acknowledge() = 0;
  // Whether there is a newest scan that becomes older: false for what has ended.
  virtual bool isLive() const = 0;
  // Whether it is a machine, which runs on whatever is shown.
  virtual bool isMachine() const { return false; }
  // Whether pages may write: "" or why not.
  virtual std::string mayWrite() const = 0;
};

} // namespace rung::web
