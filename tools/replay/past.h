// The past of a program: goes to any part of a recording, forwards and backwards, and says what its rungs did there.
//
//   Result<std::unique_ptr<Past>> past = Past::open(recording, {});
//   past.value()->goTo(1200);                 // the state after 1,200 parts
//   const Flow* flow = past.value()->flow();  // of part 1,200
//
// A part is what the program's owner runs at a time: a scan, a slot, a slice, a run of the fast part. Playing begins at
// the nearest whole state: of the recording, or one of those that this object keeps where it has been lately.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rtlib/nc/control/control.h"
#include "tools/replay/recording.h"
#include "tools/replay/stage.h"

namespace rung::replay {

struct PastOptions {
  compiler::EngineKind engine = compiler::EngineKind::Tiered;
  size_t keptBytes = size_t{128} << 20; // of states that are kept
  uint64_t keptEvery = 256;             // parts between two of them
};

// What was recorded, and what the program does now, are different.
struct Difference {
  uint64_t part = 0; // parts that have run
  runtime::PlayedDifference what;
  std::string place; // that differs, as users know it; "": unknown
};

class Past {
public:
  // The recording outlives this. Fails if nothing in it can be played.
  static Result<std::unique_ptr<Past>> open(const Recording& recording, const PastOptions& options);
  Past(const Past&) = delete;
  Past& operator=(const Past&) = delete;

  // The recording has grown, or dropped its oldest segments. The position stays, or is the first one.
  void grown();

  const Recording& recording() const { return recording_; }
  const Contents& contents() const { return contents_; }

  // Parts that have run at the present position.
  uint64_t part() const { return part_; }
  // The program in its state at the present position. To be read only.
  const runtime::Instance& instance() const { return stages_[stageNumber_]->player().instance(); }
  const compiler::Compiled& compiled() const { return stages_[stageNumber_]->compiled(); }
  uint32_t programNumber() const { return stageNumber_; } // in Recording::programs
  // The first part that can be reached.
  uint64_t firstPart() const { return contents_.states.front().part; }
  std::string rangeText() const; // "the recording has scans 0 to 100"

  // Goes there. "" or why that is impossible; the position is then undefined until the next call that succeeds.
  std::string goTo(uint64_t part);
  // Goes to the first part after which the clock is at least at `us`, or to the last one.
  std::string goToTime(int64_t us);
  // Keeps the present state, so that going here again is fast.
  void keep();
  // Continues by one part. False: the recording has ended, or cannot be played further; `problem` says why.
  bool next();
  const std::string& problem() const { return problem_; } // "": the end

  // What happened in the parts that have led to the present position, which stays; by default in the last one. Null: at
  // a beginning, also of another program.
  const Flow* flow(const FlowEngine::AfterRun& afterRun = {}, uint64_t parts = 1);
  // After flow(): its engine, and the instance as that part has left it.
  FlowEngine& flowEngine() { return stage().flowEngine(); }
  runtime::Instance& flowInstance() { return stage().flowInstance(); }
  // Parts in which every task has its turn, as they have run lately: a scan of several slices.
  uint64_t partsPerScan();
  // The state before these parts, of the same program; empty: the program was started, or a state loaded, in between.
  std::span<const uint8_t> blockBefore() const { return blockBefore_; }
  // What others wrote before that part and within it.
  std::span<const OutsideWrite> outsideWrites() const { return outside_; }

  // Sees what comes to the program from outside while it is played, whichever program runs. Null: none.
  void watch(runtime::OutsideWatch* watch);
  // The control that plays, whose messages are those of the present position; null if it does not run again. `attach`
  // makes another one see the program of now, without changing anything.
  const nc::Control* control() const { return controlOf(stages_[stageNumber_]->player()); }
  void attach(nc::Control& control) { control.onReplace(stage().player().instance()); }
  // The messages that the program has sent in the last part that `next` has run.
  std::span<const rung_message> sent() const { return sent_; }
  // Whether what the program does is compared with what was recorded, as it is at first: playing is faster without it.
  void compare(bool compares);
  bool compares() const { return compares_; }
  // Those found so far where it has been played; the first ones.
  const std::vector<Difference>& differences() const { return differences_; }

private:
  Past(const Recording& recording, const PastOptions& options)
      : recording_(recording), options_(options), contents_(recording), stages_(recording.programs.size()) {}

  Stage& stage() { return *stages_[stageNumber_]; }
  std::span<const uint8_t> events() const { return recording_.segments[segment_].events; }
  size_t position() const;
  std::vector<uint8_t> eventsFrom(const Moment& from) const;
  bool isContinuous(uint32_t from) const;
  Result<void> useStage(uint32_t number);
  bool begin(const StatePoint& point);
  bool resume(const Moment& moment);
  void play(size_t from);
  bool playAgain();
  bool nextSegment();
  bool otherProgram();
  bool followsFromBefore(uint64_t part) const;
  std::optional<Moment> firstOf(uint64_t part) const;
  std::optional<Moment> present();
  std::optional<Moment> beginning();
  void keep(Moment moment);
  void keepAfter(uint64_t& part);
  void noteDifference();
  void takeSent();

  const Recording& recording_;
  PastOptions options_;
  Contents contents_;
  std::vector<std::unique_ptr<Stage>> stages_; // by program; null: not used yet
  uint32_t stageNumber_ = 0;
  uint32_t segment_ = 0;
  size_t base_ = 0; // of the events that the player has
  uint64_t part_ = 0;
  bool reached_ = false; // the position is defined
  std::string problem_;
  // Repetitions of the last part that are still to be played before the events from base_ on.
  uint64_t again_ = 0;
  bool resumed_ = false; // the player has not run the last part itself
  std::vector<uint8_t> againEvent_;
  runtime::PartKind againKind_ = runtime::PartKind::Scan;
  uint32_t againNumber_ = 0;

  uint64_t scanParts_ = 0; // of the program; 0: unknown
  uint64_t scanKnown_ = 0; // the part where it was determined

  std::map<uint64_t, Moment> kept_; // by part
  size_t keptBytes_ = 0;
  std::vector<uint64_t> keptOrder_; // parts, the oldest first
  std::vector<uint8_t> blockBefore_;
  std::vector<OutsideWrite> outside_;
  std::vector<Difference> differences_;
  bool compares_ = true;
  std::vector<rung_message> sent_;
  runtime::OutsideWatch* watch_ = nullptr;
};

// What differs is of no interest, as long as this lives.
class NotCompared {
public:
  explicit NotCompared(Past& past) : past_(past), before_(past.compares()) { past_.compare(false); }
  ~NotCompared() { past_.compare(before_); }
  NotCompared(const NotCompared&) = delete;
  NotCompared& operator=(const NotCompared&) = delete;

private:
  Past& past_;
  bool before_;
};

// "scan 12, 0.120 s": parts and time as the prompt of `rungc run` counts them.
std::string positionText(const Past& past);

} // namespace rung::replay
