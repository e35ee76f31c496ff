// The channels of the control: part programs in memory, which one is selected, and whether one runs.
#pragma once
#include <array>
#include <vector>

#include "rtlib/nc/model/nct/topic.h"
#include "rtlib/nc/nct/parameters.h"

namespace rung::nc::nct {

class Channels final : public Topic {
public:
  explicit Channels(Control& control) : Topic(control) {}

  // Channels count from 0. A program runs or is interrupted: CN_START, CN_STOP or CN_INTD.
  bool busy(uint32_t channel) const;
  bool hasProgram(int32_t number) const;
  void select(uint32_t channel, int32_t number);

  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;

private:
  BitSignal start_{"CN_START"};
  BitSignal stop_{"CN_STOP"};
  BitSignal interrupted_{"CN_INTD"};
  std::vector<int32_t> programs_;
  std::array<int32_t, kChannels> selected_{};
};

} // namespace rung::nc::nct
