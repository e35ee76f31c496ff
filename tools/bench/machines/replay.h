// A PLC program with the control of its dialect, as a host has it that uses the runtime library, and a recorded machine
// in place of pins.
#pragma once
#include <cstdint>

#include "rtlib/run/instance.h"
#include "rung/runtime.hpp"
#include "tools/bench/machines/recording.h"

namespace rung::bench {

class Replay {
public:
  // Starts cold. The image must outlive the object.
  explicit Replay(const rung::Image& image);

  // Writes what the machine wrote before the part. Throws std::runtime_error if the program has no such place.
  void write(const Part& part);
  void run() noexcept { runPart_(instance_.handle()); }
  // Hash of all bytes of all spaces, the clock and the fault.
  uint64_t hash() const;
  // Empties the queues that a host would empty between two parts.
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
