// MW 40: a part program, by its number, for execution in automatic mode (man. 6.21).
#pragma once
#include "sim/nct/topic.h"

namespace rung::sim::nct {

class ProgramSelection final : public Topic {
public:
  using Topic::Topic;
  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;

private:
  BitSignal start_{"CN_START"};
  BitSignal stop_{"CN_STOP"};
};

} // namespace rung::sim::nct
