// What happens to the program of a simulated host, recorded in files of a folder, and played by the interpreter.
#pragma once
#include <cstdint>
#include <string>

#include "ir/support/temporary_folder.h"
#include "rtlib/api/host_player.h"
#include "tests/host-sim/programs.h"

namespace rung::host_sim {

class MemoryDisk;

class Recorded {
public:
  explicit Recorded(const Programs& programs) : programs_(programs) {}

  // Of an instance, which ends with it. Nothing is appended while the disk is full.
  void begin(rung_instance& instance, const MemoryDisk& disk);
  void look(rung_instance& instance);
  // When no instance is recorded any more: "", or what went otherwise than it was recorded.
  std::string play() const;

private:
  const Programs& programs_;
  TemporaryFolder folder_;
};

} // namespace rung::host_sim
