// The tables that a simulated NC keeps, on disk beside the program's retained memory: FILE.nc.a and FILE.nc.b (see
// rtlib/retain/retain.h: written in turn and replaced as a whole, so that a crash leaves the older image).
#pragma once
#include <cstdint>
#include <memory>

#include "rtlib/change/relocation.h"
#include "rtlib/core/queues.h"
#include "rtlib/retain/retain.h"
#include "sim/simulated_nc.h"

namespace rung::sim {

class RetainedTables {
public:
  // The model is configured, and outlives this.
  RetainedTables(SimulatedNc& model, const std::string& file,
                 std::chrono::milliseconds period = std::chrono::milliseconds(200));

  // Before the power-on; false: the NC starts as delivered. As RetainedMemory::load.
  bool load(std::string& report, std::string& error);
  // Scan thread, after every scan: copies at most once a period, never waits and allocates nothing. The tables are the
  // NC's, which continues when the program stops: after a fault too.
  void offer() noexcept;
  // Any thread, without a lock: the last try to save them went wrong.
  bool failing() const noexcept { return saver_ && saver_->failing(); }
  std::string problem() const { return saver_ ? saver_->problem() : std::string(); }
  // After the last scan: what is kept is on disk; "" or why it is not.
  std::string finish();

private:
  SimulatedNc* model_;
  uint32_t size_;
  std::unique_ptr<runtime::RetainStore> store_; // until load has handed it to the saver
  std::chrono::milliseconds period_;
  std::unique_ptr<runtime::RetainSaver> saver_; // null: nothing is kept
};

// What a machine has kept of a program's places and requests, in another program that has taken its place.

class Relocation : public runtime::Relocation {
public:
  using runtime::Relocation::Relocation;

  // RUNG_NONE: the other program does not ask for this service.
  uint32_t service(uint32_t number) const;
  // A request that has been taken and is not yet answered: its service, and where its operand block lies. The service
  // is RUNG_NONE, and unknown, afterwards where the other program does not wait for the answer.
  void renumber(core::ServiceRequest& request) const;
};

} // namespace rung::sim
