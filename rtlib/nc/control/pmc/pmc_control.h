// The control of the PMC family: the machine's and the CNC's signals outlive the PLC's power, messages are bits of the
// A area. A dialect has its own by a table (rtlib/nc/pmc/model.h). Of a CNC with several paths it serves the first one,
// whose signals are at F0 and G0.
#pragma once
#include <optional>
#include <span>

#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/pmc/asked_axes.h"
#include "rtlib/nc/control/pmc/messages.h"
#include "rtlib/nc/control/pmc/pmc_functions.h"
#include "rtlib/nc/pmc/model.h"

namespace rung::nc {

class PmcControl final : public Control {
public:
  // The model outlives it.
  explicit PmcControl(const pmc::Model& model)
      : model_(&model), functions_(model), axes_(model), messages_(model.messages) {}

  // X and F belong to the machine and the CNC, so switching the PLC off and on does not change them (inventory §18).
  void prepare(runtime::Instance& instance, PowerOn kind) override;
  std::unique_ptr<Places> locate(const rung_program& program) const override;
  std::vector<ShownMessage> messages(const runtime::Instance& instance) const override {
    return messages_.list(instance);
  }
  bool shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept override {
    return messages_.shows(instance, these);
  }
  bool nextChange(const runtime::Instance& instance, rung_message& message) noexcept override {
    return messages_.nextChange(instance, message);
  }
  size_t describe(const rung_program& program, const rung_message& message,
                  std::span<char> out) const noexcept override;
  std::string text(const ShownMessage& message) const override;
  // Whether a message is shown that puts the CNC into the alarm state. Allocates nothing.
  bool showsAlarm(const runtime::Instance& instance) const noexcept { return messages_.showsAlarm(instance); }
  bool isConstant(const rung_program& program, const runtime::Ref& place) const override;
  void save(core::Saver& saver) const noexcept override { saver(functions_, axes_, messages_, served_); }
  void load(core::Loader& loader) override { loader(functions_, axes_, messages_, served_); }
  // The second level is cut into slots of 8 ms.
  bool runsInSlots() const override { return true; }
  PmcFunctions* functions(uint32_t channel) override { return channel == 0 ? &functions_ : nullptr; }
  // Axes without a group, and the signals of their groups, are left alone.
  bool setAxisGroup(uint32_t axis, uint32_t group) override { return axes_.setGroup(axis, group); }
  void setServed(bool served) override { served_ = served; }
  void beforeSlice(runtime::Instance& instance) override {
    if (axes_.any() && io_) axes_.step(*io_, instance.services(), served_);
  }
  void afterSlice(runtime::Instance& instance) override { messages_.writeStates(instance); }
  // Window functions end with the dialect's code for "not provided".
  core::ServiceReply refuse(const core::ServiceRequest& request) const noexcept override;
  core::ServiceName ownService() const override {
    return {model_->service(pmc::ServiceKind::MoveAxis).text.data(), static_cast<uint32_t>(pmc::ServiceKind::MoveAxis)};
  }
  // The areas of the program that runs now; null before there is one.
  const pmc::SignalsIo* signals() const { return io_ ? &*io_ : nullptr; }

protected:
  void usePlaces(runtime::Instance& instance, Places& places) noexcept override;
  std::optional<runtime::Ref> signal(const rung_program& program, std::string_view name) const override;

private:
  const pmc::Model* model_;
  PmcFunctions functions_;
  PmcAskedAxes axes_;
  PmcMessages messages_;
  bool served_ = true;
  std::optional<pmc::SignalsIo> io_; // of the program that runs now
};

} // namespace rung::nc
