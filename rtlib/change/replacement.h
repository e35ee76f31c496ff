// Another program for an instance that runs: made and looked at outside real time, put in its place between two scans
// (Instance::replace).
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "rtlib/change/state_transfer.h"
#include "rtlib/run/loaded_program.h"

namespace rung::runtime {

enum class ReplaceResult : uint8_t {
  Replaced,
  OtherProgram,   // the replacement was not made for the program that runs
  WithinPass,     // of the schedule: later
  RequestsWait,   // of services, and the new program numbers them otherwise: later
  MechanismWaits, // at an instruction that the new program does not have: later
};

// What the cells that only one of two programs has contain when it takes over again.
enum class OwnContents : uint8_t {
  Initial, // those that it begins with
  AsLeft,  // those of its last scan
};

class Replacement {
public:
  // `next` is of `running`'s dialect; both outlive this object and the instance's use of them.
  Replacement(const rung_program& running, const Runnable& next, PlaceName nameOf = plainPlaceName);

  const rung_program& next() const { return *loaded_.program; }
  const std::shared_ptr<const CopyLists>& copyLists() const { return loaded_.copyLists; } // of the next one
  // What becomes of the state when the program that this holds takes over. Any thread.
  const StateTransfer& transfer() const noexcept { return way().transfer; }
  // That taking over copies: its time is in proportion to them. It copies all of the state where the block of the
  // running program has no room for the next one. Any thread.
  uint64_t bytes() const noexcept {
    return sharesBlock_ ? way().inSharedBlock.bytes() + 2 * swappedBytes_ : way().transfer.bytes();
  }

private:
  friend class Instance;
  // From one of the two programs to the other.
  struct Way {
    Way(const rung_program& from, const rung_program& to, PlaceName nameOf)
        : transfer(from, to, nameOf), inSharedBlock(transfer) {}
    StateTransfer transfer;
    StateTransfer inSharedBlock;   // without what stays
    std::vector<uint8_t> contents; // that the program begins with, where blocks are swapped
  };
  const Way& way() const noexcept { return ways_[wayBack_.load(std::memory_order_acquire) ? 1 : 0]; }
  // Where most of the state stays where it is, the next program takes the block over in which the running one lies.
  // What else is to be there is put into the other block, and swapped with it.
  void planSharedBlock(const rung_program& running);
  bool mayShare(const LoadedProgram& running) const noexcept;
  void beginAnew(bool shares) noexcept;
  // The state goes over. `running` is the next program then, and this holds what it was.
  void exchange(LoadedProgram& running, OwnContents own) noexcept;

  LoadedProgram loaded_;
  std::array<Way, 2> ways_; // there and back
  std::atomic<bool> wayBack_{false};
  bool hasRun_ = false;      // the program that this holds
  bool sharesBlock_ = false; // where that takes less time
  std::vector<rung_span> swaps_;
  uint64_t swappedBytes_ = 0; // of one block
};

} // namespace rung::runtime
