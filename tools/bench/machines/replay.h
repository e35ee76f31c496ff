// A PLC program with the control of its dialect, as a host of the runtime's library has it, and a recorded machine in
// the place of pins.
#pragma once
#include <cstdint>

#include "rtlib/run/instance.h"
#include "rung/runtime.hpp"
#include "tools/bench/machines/recording.h"

namespace rung::bench {

class Replay {
public:
  // Switched on cold. The image outlives it.
  explicit Replay(const rung::Image& image);

  // What the machine has written before a part. Throws std::runtime_error where the program has no such place.
  void write(const Part& part);
  void run() noexcept { runPart_(instance_.handle()); }
  // Of all bytes of all spaces, the clock and the fault.
  uint64_t hash() const;
  // Takes what a host would take between two parts.
  void drain();
  const runtime::Instance& inside() const { return inside_; }

private:
  uint64_t hashOfAll() const;
  uint32_t spaceOf(const std::string& name) const;

  rung::Instance instance_;
  runtime::Instance& inside_;
  int32_t (*runPart_)(rung_instance*);
};

} // namespace rung::bench
