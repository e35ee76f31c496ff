// The channels of the control (see channels.h).
#include "rtlib/nc/model/nct/channels.h"

#include <algorithm>

namespace rung::nc::nct {

bool Channels::busy(uint32_t channel) const {
  const SignalMemory& signals = control().signals;
  return signals.get(start_, channel) || signals.get(stop_, channel) || signals.get(interrupted_, channel);
}

bool Channels::hasProgram(int32_t number) const { return std::ranges::find(programs_, number) != programs_.end(); }

void Channels::select(uint32_t channel, int32_t number) {
  if (channel < selected_.size()) selected_[channel] = number;
}

Handled Channels::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (name != "program") return std::nullopt;
  const int64_t number = integerKey(keys, "number", 0);
  if (number < 1 || number > 99'999'999) return "event program takes number=1 to 99999999";
  if (!hasProgram(static_cast<int32_t>(number))) programs_.push_back(static_cast<int32_t>(number));
  return "";
}

std::optional<double> Channels::quantity(std::string_view name) const {
  const auto channel = numbersBehind(name, "PROGRAM.");
  if (!channel || channel->size() != 1 || (*channel)[0] < 1 || (*channel)[0] > selected_.size()) return std::nullopt;
  return selected_[(*channel)[0] - 1];
}

} // namespace rung::nc::nct
