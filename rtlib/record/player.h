// The player: runs a program again as a recording says, part by part, and compares what it does with what it did then.
// The program may run on any engine. Not for real time. What the kinds of recordings have in common; bytes_player.h
// plays what a Recorder has recorded, rtlib/api/host_player.h what a HostRecorder has.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rtlib/record/events.h"
#include "rtlib/record/watched_bytes.h"
#include "rtlib/run/instance.h"

namespace rung::runtime {

enum class Played : uint8_t {
  Part,     // a part has run
  State,    // a whole state: the instance has it now
  Lost,     // events are missing, up to the next state
  End,      // of these events
  Other,    // `position` is where the recording continues with another program
  NoForces, // these cells are forced from now on, which the owner's `force` has refused
  Damaged,  // impossible events, whose place `position` is; nothing after it can be played
};

// A part that has run otherwise than it was recorded.
struct PlayedDifference {
  enum class Kind : uint8_t { Outputs, Fault, State, Requests } kind = Kind::Outputs;
  uint32_t offset = RUNG_NONE; // State: of the first byte of the block that differs; RUNG_NONE: something else does
};

// What the owner of the instance does for the player.
class PlayerOwner {
public:
  virtual ~PlayerOwner() = default;
  // Puts exactly these forces in effect. False: it cannot.
  virtual bool force(Instance& instance, std::span<const core::ForcedBits> bits);
  // Code of the program that leaves the forced bits as they are (Forcing::needsCode). Nothing: there is none.
  virtual std::optional<core::Code> codeFor(const Forcing& forcing) { return (void)forcing, std::nullopt; }
  virtual void marked(std::string_view text) { (void)text; }

private:
  std::unique_ptr<Forcing> forcing_;
};

class Player {
public:
  virtual ~Player() = default;
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  virtual Instance& instance() = 0;
  const Instance& instance() const { return const_cast<Player*>(this)->instance(); }

  // Plays these events next, which outlive their use. A whole state must come before the first part.
  void setEvents(std::span<const uint8_t> events);
  size_t position() const { return reader_.position(); }
  // Runs up to the end of the next part, or of a whole state.
  Played play();
  // How often the last part still follows as it was, with no event of its own.
  uint64_t repeatsLeft() const { return repeats_; }
  PartKind lastKind() const { return kind_; }
  uint32_t lastNumber() const { return number_; } // of its task or fault
  // What was different in the last call; nothing if all was as recorded.
  const std::optional<PlayedDifference>& difference() const { return difference_; }
  // Whether outputs are compared after each part, where the recording has them; states are in any case.
  virtual void compareOutputs(bool compares) { (void)compares; }
  // The state that the recording has at this place is compared with that of the instance, if there is one.
  bool isWhole() const { return whole_; }
  // Events by which another player gets the present state, up to their end. Empty within a scan, and before a state.
  std::vector<uint8_t> state() const;

protected:
  // The owner outlives the player.
  explicit Player(PlayerOwner& owner) : owner_(owner) {}
  void beginWith(const rung_program& program) { bits_ = bitBytes(program); } // when the instance exists

  // What the kinds of recordings do in their own ways.
  virtual bool save(core::Saver& saver) const = 0;
  virtual LoadResult load(core::Loader& loader) = 0;
  // Events of a state before and after the one that has its bytes, and their size at most.
  virtual size_t roomForOthers() const { return 0; }
  virtual void putBeforeState(EventWriter& writer) const = 0;
  virtual void putAfterState(EventWriter& writer) const { (void)writer; }
  // Before and during a comparison with a recorded state: whether this byte of the block matters.
  virtual void beforeComparison() {}
  virtual bool matters(size_t offset) const { return (void)offset, true; }
  virtual bool takeOther(Event event) = 0; // an event before a part
  virtual bool mayRun(PartKind kind) const = 0;
  virtual void run() = 0;            // the last part, again or for the first time
  virtual void compareOutcome() = 0; // of it, but for its fault

  bool isNext(Event event) const { return !reader_.atEnd() && reader_.next() == event; }
  bool takeReplies(); // those that follow
  std::optional<core::ServiceReply> takeReply();
  bool takeList(int64_t* values, uint32_t count);
  bool takeBytes(uint64_t& offset, std::span<const uint8_t>& bytes); // for the block
  bool takeBytes();
  void differs(PlayedDifference::Kind kind) { difference_ = PlayedDifference{.kind = kind}; }

  EventReader reader_{{}};
  bool whole_ = false;
  bool failed_ = false;
  PartKind kind_ = PartKind::Scan; // of the last part
  uint32_t number_ = 0;

private:
  Played damaged();
  Played playState();
  Played playPart();
  bool takeBefore(Event event);
  bool takeForces();
  bool takeMark();
  void compareState(std::span<const uint8_t> recorded);
  Played runAndCompare();
  void compareFault(bool wasFaulted);

  PlayerOwner& owner_;
  BlockBytes bits_;
  uint64_t repeats_ = 0; // that are left
  std::optional<PlayedDifference> difference_;
};

} // namespace rung::runtime
