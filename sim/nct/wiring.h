// The machine around the links, as far as its inputs only repeat outputs (or other inputs): a valve whose switch
// answers after its time.
//   config follow.INP001.03 OUT010.00          the input is the output
//   config follow.INP001.04 /OUT010.00@100ms   its opposite, 100 ms later; shorter changes do not come through
#pragma once
#include <vector>

#include "sim/nct/topic.h"

namespace rung::sim::nct {

class Wiring final : public Topic {
public:
  using Topic::Topic;
  Handled config(std::string_view key, std::string_view value) override;
  void powerOn(nc::PowerOn kind) override;
  void timeSlice() override;

private:
  struct Place {
    uint32_t word = 0;
    uint32_t bit = 0;
  };
  struct Wire {
    Place input, source;
    bool inverted = false;
    int64_t delayUs = 0;
    bool level = false; // of the source, since sinceUs
    int64_t sinceUs = 0;
  };
  static std::optional<Place> place(std::string_view name);

  std::vector<Wire> wires_;
};

} // namespace rung::sim::nct
