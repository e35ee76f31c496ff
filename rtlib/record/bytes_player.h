// Plays what a Recorder has recorded: what hooks and latches wrote is in the recording, so the program runs without
// them.
#pragma once
#include <cstdint>
#include <optional>

#include "rtlib/record/player.h"

namespace rung::runtime {

class BytesPlayer : public Player, private ScheduleHooks {
public:
  // The instance has the player as its hooks from now on. Both outlive it.
  BytesPlayer(Instance& instance, PlayerOwner& owner);
  ~BytesPlayer() override;

  Instance& instance() override { return instance_; }
  void compare(bool compares) override;

private:
  // An observer sees all hooks of the schedule; those that did not run when it was recorded do nothing.
  uint32_t works() const override { return ~0u; }
  void onHook(Instance&, uint32_t work) override {
    if ((surroundings_.works >> work & 1) != 0) within();
  }
  void onFault(Instance&) override { within(); }
  void onLatch(Instance&, uint32_t) override { within(); }
  bool respond(Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;

  bool save(core::Saver& saver) const override { return instance_.save(saver, false); }
  LoadResult load(core::Loader& loader) override;
  void putBeforeState(EventWriter& writer) const override;
  // What only others write and the program never reads is not recorded.
  bool matters(size_t offset) const override { return written_[offset]; }
  bool takeOther(Event event) override;
  bool mayRun(PartKind kind) const override { return kind != PartKind::PowerOff; } // the control does that
  void run() override;
  void compareOutcome() override;

  bool takeSurroundings();
  bool takeRequest();
  bool takeWithin(bool& ranTask);
  void within();

  Instance& instance_;
  Surroundings surroundings_;
  BlockBytes written_; // by the program
  std::optional<WatchedBytes> outputs_;
  uint32_t outputsHash_ = 0;
  uint32_t within_ = 0;
};

} // namespace rung::runtime
