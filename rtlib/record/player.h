// The player: runs a program again as a recording says (recorder.h), part by part, and compares what it does with what
// it did then. The program may run on any engine. Not for real time.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
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

class Player final : public ScheduleHooks {
public:
  // The instance has the player as its hooks from now on. Both outlive it.
  Player(Instance& instance, PlayerOwner& owner);
  ~Player() override;
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

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
  // Whether outputs after each part, and states, are compared with the recorded ones, as they are at first.
  void compareOutputs(bool compares);
  // The state that the recording has at this place is compared with that of the instance, if there is one.
  bool isWhole() const { return whole_; }

  uint32_t works() const override { return surroundings_.works; }
  void onHook(Instance&, uint32_t) override { within(); }
  void onFault(Instance&) override { within(); }
  void onLatch(Instance&, uint32_t) override { within(); }
  bool respond(Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;

private:
  bool isNext(Event event) const { return !reader_.atEnd() && reader_.next() == event; }
  Played damaged();
  Played playState();
  Played playPart();
  bool takeBefore(Event event);
  bool takeSurroundings();
  bool takeForces();
  bool takeBytes();
  bool takeReplies();
  bool takeRequest();
  std::optional<core::ServiceReply> takeReply();
  bool takeList(int64_t* values, uint32_t count);
  void run();
  void compareOutcome();
  void compareState(std::span<const uint8_t> recorded);
  void within();

  Instance& instance_;
  PlayerOwner& owner_;
  EventReader reader_{{}};
  Surroundings surroundings_;
  BlockBytes written_; // by the program
  BlockBytes bits_;
  std::optional<WatchedBytes> outputs_;
  uint32_t outputsHash_ = 0;
  bool comparesOutputs_ = true;
  bool whole_ = false;
  bool failed_ = false;
  PartKind kind_ = PartKind::Scan; // of the last part
  uint32_t number_ = 0;
  uint64_t repeats_ = 0; // that are left
  uint32_t within_ = 0;
  std::optional<PlayedDifference> difference_;
};

} // namespace rung::runtime
