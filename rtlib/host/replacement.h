// Another program for an instance that runs: made and looked at outside real time, put in its place between two scans
// (Instance::replace).
#pragma once
#include <cstdint>

#include "rtlib/host/loaded_program.h"
#include "rtlib/host/state_transfer.h"

namespace rung::host {

enum class ReplaceResult : uint8_t {
  Replaced,
  OtherProgram,   // the replacement was not made for the program that runs
  WithinPass,     // of the schedule: later
  RequestsWait,   // of services, and the new program numbers them otherwise: later
  MechanismWaits, // at an instruction that the new program does not have: later
};

class Replacement {
public:
  // `next` is of `running`'s dialect; both outlive this object and the instance's use of them.
  Replacement(const rung_program& running, const Runnable& next);

  const rung_program& next() const { return *loaded_.program; }
  // What becomes of the state.
  const StateTransfer& transfer() const { return there_; }

private:
  friend class Instance;
  LoadedProgram loaded_;
  StateTransfer there_;
  StateTransfer back_;
};

} // namespace rung::host
