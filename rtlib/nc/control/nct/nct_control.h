// The control of an NCT PLC: constant and clock signals on the hardware side of the NC area (the time-slice memory),
// reports about displayed messages to the program, names of the NC area.
#pragma once
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/nct/messages.h"
#include "rtlib/nc/control/nct/nct_functions.h"
#include "rtlib/nc/control/nct/signal_memory.h"

namespace rung::nc {

class NctControl final : public Control {
public:
  void prepare(runtime::Instance& instance, PowerOn kind) override;
  std::unique_ptr<Places> locate(const rung_program& program) const override;
  // At power-on both memories hold the values of the NC.
  void start(runtime::Instance& instance) override;

  // Called before every time slice, when NC inputs are written to the time-slice memory.
  void onHook(runtime::Instance& instance, uint32_t work) override;
  void afterSlice(runtime::Instance& instance) override;
  // The kind of the current time slice.
  nct::Messages::Slice slice() const { return now_; }

  // The NC and the hardware write the time-slice memory; the program sees it at the next synchronisation.
  std::optional<runtime::Ref> writePlace(const rung_program& program, std::string_view name) const override;

  void accept(const rung_message& message) override { messages_.accept(message); }
  std::vector<ShownMessage> messages(const runtime::Instance& instance) const override {
    return messages_.shown(instance.program());
  }
  bool shows(const runtime::Instance&, std::span<const ShownMessage> these) const noexcept override {
    return messages_.shows(these);
  }
  bool nextChange(const runtime::Instance&, rung_message& message) noexcept override {
    return messages_.nextChange(message);
  }
  // The text includes the values of the message.
  size_t describe(const rung_program& program, const rung_message& message,
                  std::span<char> out) const noexcept override;
  nct::Messages& list() { return messages_; }
  // The time-slice memory, once the program has been prepared.
  const nct::SignalMemory& signals() const { return ts_; }

  void save(core::Saver& saver) const noexcept override { saver(*this); }
  void load(core::Loader& loader) override { loader(*this); }
  template <class Archive>
  void state(Archive& archive) {
    archive(messages_, functions_, now_, timeSlices_, cycles_, slice_, retainedLost_);
  }

  NctFunctions* functions(uint32_t channel) override {
    return channel < functions_.size() ? &functions_[channel] : nullptr;
  }

  bool writesItself(const rung_program& program, const runtime::Ref& place) const override;

  void reportRetainedLost() override { retainedLost_ = true; }

protected:
  void usePlaces(runtime::Instance& instance, Places& places) noexcept override;

private:
  // Clock signals with their periods, 50 % duty (man. 7.12, l.7892-7896).
  struct Clock {
    nct::BitSignal signal;
    int64_t periodUs = 0;
  };

  void writeConstants();
  void beginCycle(nct::SignalWord& common);

  nct::BitSignal on_{"N_ON"};
  nct::BitSignal ready_{"N_NCREADY"};
  nct::BitSignal nvramOk_{"N_NVRAMOK"};
  nct::BitSignal firstCycle_{"N_FIRSTCC"};
  nct::BitSignal timeSliceClock_{"N_P2MS"};
  nct::BitSignal cycleClock_{"N_P2T"};
  nct::BitSignal bufferEmpty_{"AN_BEPTY"};
  nct::BitSignal motionDone_{"AN_IEPTY"};
  Clock clocks_[3] = {{nct::BitSignal("N_P100MS"), 100'000},
                      {nct::BitSignal("N_P1S"), 1'000'000},
                      {nct::BitSignal("N_P1M"), 60'000'000}};
  nct::SignalMemory ts_;
  nct::Messages messages_;
  std::array<NctFunctions, 8> functions_ = {NctFunctions(0), NctFunctions(1), NctFunctions(2), NctFunctions(3),
                                            NctFunctions(4), NctFunctions(5), NctFunctions(6), NctFunctions(7)};
  nct::Messages::Slice now_ = nct::Messages::Slice::Alone;
  uint64_t timeSlices_ = 0;
  uint64_t cycles_ = 0;
  uint32_t slice_ = 0;         // time slices so far, over all PLC cycles
  uint32_t slicesOfCycle_ = 1; // time slices in a PLC cycle
  bool retainedLost_ = false;
};

} // namespace rung::nc
