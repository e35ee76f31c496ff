// The retained tables of a simulated NC on disk, beside the program's retained memory: FILE.nc.a and FILE.nc.b (see
// rtlib/retain/retain.h: written alternately and replaced as a whole, so that a crash leaves the older image).
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
  // The model is already configured, and must outlive this object.
  RetainedTables(SimulatedNc& model, const std::string& file,
                 std::chrono::milliseconds period = std::chrono::milliseconds(200));

  // To be called before power-on; false: the NC starts as delivered. Reports and errors as in RetainedMemory::load.
  bool load(std::string& report, std::string& error);
  // Scan thread, after every scan: copies at most once per period, never waits and allocates nothing. The tables belong
  // to the NC, which also continues when a fault has stopped the program.
  void offer() noexcept;
  // Any thread, without a lock: whether the last attempt to save the tables failed.
  bool failing() const noexcept { return saver_ && saver_->failing(); }
  std::string problem() const { return saver_ ? saver_->problem() : std::string(); }
  // To be called after the last scan: writes the tables to disk; returns "", or the error.
  std::string finish();

private:
  SimulatedNc* model_;
  uint32_t size_;
  std::unique_ptr<runtime::RetainStore> store_; // until load has passed it to the saver
  std::chrono::milliseconds period_;
  std::unique_ptr<runtime::RetainSaver> saver_; // null: nothing is retained
};

// Maps a machine's references to places and requests of a program to those of the program that replaces it.

class Relocation : public runtime::Relocation {
public:
  using runtime::Relocation::Relocation;

  // RUNG_NONE: the other program does not request this service.
  uint32_t service(uint32_t number) const;
  // Maps a request in progress: its service and the place of its operand block. The service becomes RUNG_NONE, which is
  // unknown, if the other program does not wait for the answer.
  void renumber(core::ServiceRequest& request) const;
};

} // namespace rung::sim
