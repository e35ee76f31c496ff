// Axes of a program that the host's CNC moves: for each command of PMC axis control the control makes a request,
// which is answered when the axis has executed it. Scan thread.
#pragma once
#include <array>

#include "rtlib/core/queues.h"
#include "rtlib/nc/control/pmc/axis_groups.h"

namespace rung::nc {

class PmcAskedAxes final : public PmcAxisGroups::Mover {
public:
  // The model outlives it.
  explicit PmcAskedAxes(const pmc::Model& model) : model_(&model), groups_(model) {}

  // From now on the program commands the axis by a group; both count from 0. False if the CNC does not
  // have the axis or the group.
  bool setGroup(uint32_t axis, uint32_t group);
  bool any() const { return served_ != 0; }
  // At power-on: whatever the axes are doing, the program has not commanded it.
  void powerOn();
  // Runs before the program in every slot. `served`: a CNC carries out the commands.
  void step(const pmc::SignalsIo& io, core::ServiceQueue& services, bool served);

  template <class Archive>
  void state(Archive& archive) {
    archive(groups_, axes_, unknown_, lost_, isServed_);
  }

  std::optional<uint32_t> groupOf(uint32_t axis) const override { return axes_[axis].group; }
  bool begin(uint8_t axes, const PmcAxisGroups::Command& command) override;
  void change(uint8_t axes, const PmcAxisGroups::Command& command) override { (void)order(axes, command); }
  PmcAxisGroups::Progress move(uint8_t axes, const PmcAxisGroups::Command& command) override;
  void pause(uint8_t axes) override;
  void stop(uint8_t axes, bool cleared) override;
  PmcAxisGroups::Motion look(uint8_t axes) const override;

private:
  struct Axis {
    std::optional<uint32_t> group;
    uint32_t motion = 0, stop = 0; // tickets
    bool paused = false;
    bool ordered = false; // a command is not finished yet
    template <class Archive>
    void state(Archive& archive) { // the group is of the configuration
      archive(motion, stop, paused, ordered);
    }
  };
  bool order(uint8_t axes, const PmcAxisGroups::Command& command);
  uint32_t ask(uint32_t axis, int64_t command, int64_t data1, int64_t data2);
  bool isPending(uint32_t ticket) const { return services_->poll(ticket) == RUNG_SERVICE_PENDING; }

  const pmc::Model* model_;
  PmcAxisGroups groups_;
  std::array<Axis, PmcAxisGroups::kAxes> axes_;
  uint8_t served_ = 0;  // groups that have an axis
  uint8_t given_ = 0;   // axes that have a group
  uint8_t unknown_ = 0; // axes that may be moving since before the power-on or the absence of a CNC
  uint8_t lost_ = 0;    // those of them that the program had moved
  bool isServed_ = true;
  const pmc::SignalsIo* io_ = nullptr; // during a slot, as the next
  core::ServiceQueue* services_ = nullptr;
};

} // namespace rung::nc
