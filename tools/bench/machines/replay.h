// A PLC program with the control of its dialect, as a host has it that uses the runtime library, and a recorded machine
// in place of pins.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

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
  // From now on what the machine writes is recorded in a folder: bytes that only it writes as those of bound variables,
  // the others as values that a client writes. `recorded` packs what has come since the last call; returns their state
  // so far.
  void record(const Recording& recording, const std::string& folder);
  runtime::RecordingState recorded();
  void addProgram(uint64_t hash, const std::string& ir); // to the folder
  void endRecord();
  // Empties the queues that a host would empty between two parts.
  void drain();
  const runtime::Instance& inside() const { return inside_; }

private:
  std::vector<uint8_t> ownBytes(const Recording& recording) const;
  template <class Each>
  void eachByte(const Part& part, Each each) const;
  uint64_t hashOfAll() const;
  uint32_t spaceOf(const std::string& name) const;

  const rung::Image& image_;
  rung::Instance instance_;
  runtime::Instance& inside_;
  std::vector<uint8_t> own_; // by offset in the block: written by the machine alone
  std::unique_ptr<runtime::RecordingWriter> writer_;
  int32_t (*runPart_)(rung_instance*);
};

} // namespace rung::bench
