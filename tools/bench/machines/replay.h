// A PLC program with the control of its dialect, as a host has it that uses the runtime library, and a recorded machine
// in place of pins.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "rtlib/record/recording_writer.h"
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
  // From now on what the machine writes is recorded in a folder, as inputs of a host that writes all places of the
  // recording before each part. `recorded` packs what has come since the last call; returns their state so far.
  void record(const Recording& recording, const std::string& folder);
  runtime::RecordingState recorded();
  // Empties the queues that a host would empty between two parts.
  void drain();
  const runtime::Instance& inside() const { return inside_; }

private:
  uint64_t hashOfAll() const;
  uint32_t spaceOf(const std::string& name) const;

  rung::Instance instance_;
  runtime::Instance& inside_;
  std::unique_ptr<runtime::RecordingWriter> writer_;
  int32_t (*runPart_)(rung_instance*);
};

} // namespace rung::bench
