// Another program for an instance that runs: made and looked at outside real time, put in its place between two scans
// (Instance::replace).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

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
  const rt::NeededCopies& neededCopies() const { return loaded_.neededCopies; } // of the next one
  // What becomes of the state.
  const StateTransfer& transfer() const { return there_; }
  // That taking over copies: its time is in proportion to them. It copies all of the state where the block of the
  // running program has no room for the next one.
  uint64_t bytes() const { return shared_ ? shared_->there.bytes() + shared_->swappedBytes : there_.bytes(); }

private:
  friend class Instance;
  // Where most of the state stays where it is, the next program takes the block over in which the running one lies.
  // What else is to be there is put into the other block, and swapped with it.
  struct SharedBlock {
    StateTransfer there; // without what stays
    StateTransfer back;
    std::vector<rung_span> swaps;
    uint64_t swappedBytes; // of both blocks
  };
  void planSharedBlock(const rung_program& running);
  bool mayShare(const LoadedProgram& running) const noexcept;
  // The state goes over. `running` is the next program then, and this holds what it was.
  void exchange(LoadedProgram& running) noexcept;

  LoadedProgram loaded_;
  StateTransfer there_;
  StateTransfer back_;
  std::optional<SharedBlock> shared_; // nothing where that would take longer
};

} // namespace rung::host
