// The control of the PMC family: the machine's and the CNC's signals outlive the PLC's power, messages are bits of the
// A area. A dialect has its own by a table (rtlib/nc/pmc/model.h). Of a CNC with several paths it serves the first one,
// whose signals are at F0 and G0.
#pragma once
#include <array>
#include <span>

#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/pmc/asked_axes.h"
#include "rtlib/nc/control/pmc/pmc_functions.h"
#include "rtlib/nc/pmc/model.h"

namespace rung::nc {

namespace pmc {

// Adjacent bytes of the A area, and their place in the memory block.
struct MessageBytes {
  uint32_t first = 0, count = 0;
  uint32_t offset = 0;
  bool expanded = false; // a byte of the block for each bit

  uint32_t size() const noexcept { return expanded ? 8 * count : count; } // in the block
};

} // namespace pmc

class PmcControl final : public Control {
public:
  // The model outlives it.
  explicit PmcControl(const pmc::Model& model) : model_(&model), functions_(model), axes_(model) {}

  static constexpr uint32_t kMostMessageBytes = 752; // of the A area; FANUC's largest has 750
  // X and F belong to the machine and the CNC, so switching the PLC off and on does not change them (inventory §18).
  void prepare(runtime::Instance& instance, PowerOn kind) override;
  std::unique_ptr<Places> locate(const rung_program& program) const override;
  // As the dialect's MessageRule says. By a text list the number is that of the text, the value of a message is the
  // number of the text in the program's table (8·byte + bit + 1, with the shift of the language), and requests without
  // a text are not shown.
  std::vector<ShownMessage> messages(const runtime::Instance& instance) const override;
  bool shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept override;
  bool nextChange(const runtime::Instance& instance, rung_message& message) noexcept override;
  size_t describe(const rung_program& program, const rung_message& message,
                  std::span<char> out) const noexcept override;
  std::string text(const ShownMessage& message) const override;
  // Whether a message is shown that puts the CNC into the alarm state. Allocates nothing.
  bool showsAlarm(const runtime::Instance& instance) const noexcept;
  // The second level is cut into slots of 8 ms.
  bool runsInSlots() const override { return true; }
  PmcFunctions* functions(uint32_t channel) override { return channel == 0 ? &functions_ : nullptr; }
  // Axes without a group, and the signals of their groups, are left alone.
  bool setAxisGroup(uint32_t axis, uint32_t group) override { return axes_.setGroup(axis, group); }
  void setServed(bool served) override { served_ = served; }
  void beforeSlice(runtime::Instance& instance) override {
    if (axes_.any() && io_) axes_.step(*io_, instance.services(), served_);
  }
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
  // Calls see(key, number) for each message that is shown, in order of the A bits, until it returns false; returns
  // whether it never did. `key` is the number of the text in the program's table.
  template <class See>
  bool forMessages(const runtime::Instance& instance, See see) const;
  // Whether messages are shown at all now (DISPB).
  bool displays(const runtime::Instance& instance) const noexcept;
  uint32_t shift(const runtime::Instance& instance) const noexcept;
  // The text's number and key for an A bit, from 1; number 0: there is no text.
  struct Known {
    uint32_t number = 0, key = 0;
  };
  Known known(uint32_t bit, uint32_t shift) const noexcept;

  // Whether the bytes of the A area and the display are those of the last call of `see`, so that no message has
  // changed.
  bool isAsSeen(const uint8_t* block, bool display) const noexcept;
  void see(const uint8_t* block, bool display) noexcept;

  const pmc::Model* model_;
  PmcFunctions functions_;
  PmcAskedAxes axes_;
  bool served_ = true;
  std::optional<pmc::SignalsIo> io_; // of the program that runs now
  uint32_t messageArea_ = RUNG_NONE;
  uint32_t messageBytes_ = 0;
  std::array<uint8_t, kMostMessageBytes> known_{};            // bits of messages as reported to the host
  std::span<const pmc::MessageBytes> messagePieces_;          // owned by the Places
  std::array<uint8_t, size_t{8} * kMostMessageBytes> seen_{}; // their bytes at the last `see`
  bool hasSeen_ = false;
  bool seenDisplay_ = false;          // the state of the display at the last `see`
  std::span<const uint32_t> numbers_; // of the texts by key - 1, 0: none; owned by the Places
  uint32_t displaySpace_ = RUNG_NONE; // @DISPB
  uint32_t shiftSpace_ = RUNG_NONE;   // K, if it has the message shift
};

} // namespace rung::nc
