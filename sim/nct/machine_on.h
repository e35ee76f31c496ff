// The machine's main switch: P_MONREQ switches the output MON on unless N_MONDIS disables it; N_MONST is its state
// (man. l.8014-8040). N_MONDIS is set by the hardware.
#pragma once
#include "sim/nct/topic.h"

namespace rung::sim::nct {

class MachineOn final : public Topic {
public:
  using Topic::Topic;
  void cycle() override {
    const SignalMemory& signals = links().signals;
    signals.set(on_, signals.get(request_) && !signals.get(disabled_));
  }

private:
  BitSignal request_{"P_MONREQ"};
  BitSignal disabled_{"N_MONDIS"};
  BitSignal on_{"N_MONST"};
};

} // namespace rung::sim::nct
