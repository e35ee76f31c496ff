// The screen of the control: MW 70 opens its windows (man. 6.23).
#pragma once
#include <array>

#include "sim/nct/topic.h"

namespace rung::sim::nct {

class Screen final : public Topic {
public:
  using Topic::Topic;
  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"display"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  void powerOn(nc::PowerOn kind) override;

private:
  bool configured_ = true; // whether the display is connected at power-on
  bool connected_ = true;
  std::array<int32_t, 4> window_{}; // identifier, channel, parameters; 0: none was opened
};

} // namespace rung::sim::nct
