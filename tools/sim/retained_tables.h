// The tables that a simulated NC keeps, on disk beside the program's retained memory: FILE.nc.a and FILE.nc.b (see
// rtlib/host/retain.h: written in turn and replaced as a whole, so that a crash leaves the older image).
#pragma once
#include <memory>

#include "rtlib/host/retain.h"
#include "tools/sim/simulated_nc.h"

namespace rung::sim {

class RetainedTables {
public:
  // The model is configured, and outlives this.
  RetainedTables(SimulatedNc& model, const std::string& file,
                 std::chrono::milliseconds period = std::chrono::milliseconds(200));

  // Before the power-on; false: the NC starts as delivered. As RetainedMemory::load.
  bool load(std::string& report, std::string& error);
  // Scan thread, after every scan: copies at most once a period, never waits and allocates nothing.
  void offer() noexcept;
  // After the last scan: what is kept is on disk; "" or what has gone wrong since the start.
  std::string finish();

private:
  SimulatedNc* model_;
  uint32_t size_;
  host::RetainStore store_; // until load has handed it to the saver
  std::chrono::milliseconds period_;
  std::unique_ptr<host::RetainSaver> saver_; // null: nothing is kept
};

} // namespace rung::sim
