// Signals as a topic left them: while they are so, and nothing else that it goes by has changed, its work would end
// where it is. They are compared as blocks, which costs a fraction of what going through them does.
#pragma once
#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "rtlib/nc/control/nct/signal_memory.h"

namespace rung::sim::nct {

class SeenSignals {
public:
  // All that each of them has: of 48 drives 48 words.
  SeenSignals(std::initializer_list<nc::nct::WordSignal> signals) : signals_(signals) {
    size_t bytes = 0;
    for (const nc::nct::WordSignal& signal : signals_) bytes += signal.bytes();
    seen_.resize(bytes);
  }

  // Allocates nothing, as the next.
  bool areSame(const nc::nct::SignalMemory& memory) const {
    const uint8_t* seen = seen_.data();
    for (const nc::nct::WordSignal& signal : signals_) {
      const std::span<const uint8_t> now = memory.all(signal);
      if (!known_ || std::memcmp(now.data(), seen, now.size()) != 0) return false;
      seen += signal.bytes();
    }
    return true;
  }
  void see(const nc::nct::SignalMemory& memory) {
    uint8_t* seen = seen_.data();
    for (const nc::nct::WordSignal& signal : signals_) {
      std::ranges::copy(memory.all(signal), seen);
      seen += signal.bytes();
    }
    known_ = true;
  }
  // Something else has changed.
  void forget() { known_ = false; }

private:
  std::vector<nc::nct::WordSignal> signals_;
  std::vector<uint8_t> seen_;
  bool known_ = false;
};

} // namespace rung::sim::nct
