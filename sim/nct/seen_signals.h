// The signals as a topic last left them: while they and the topic's other inputs are unchanged, its work would not
// change anything. Comparing them as blocks is much cheaper than evaluating them.
#pragma once
#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "rtlib/nc/control/nct/signal_memory.h"

namespace rung::sim::nct {

class SeenSignals {
public:
  // Includes all elements of each signal: for 48 drives, 48 words.
  SeenSignals(std::initializer_list<nc::nct::WordSignal> signals) : signals_(signals) {
    size_t bytes = 0;
    for (const nc::nct::WordSignal& signal : signals_) bytes += signal.bytes();
    seen_.resize(bytes);
  }

  // Allocates nothing, like `see`.
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
  // Another input has changed.
  void forget() { known_ = false; }

private:
  std::vector<nc::nct::WordSignal> signals_;
  std::vector<uint8_t> seen_;
  bool known_ = false;
};

} // namespace rung::sim::nct
