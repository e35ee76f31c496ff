// A program that is to replace the program of a running instance: prepared and inspected outside real time, activated
// between two scans (Instance::replace).
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
  WithinScan,     // a scan has not ended: try again later
  RequestsWait,   // service requests wait, and the new program numbers services differently: try again later
  MechanismWaits, // a mechanism waits at an instruction that the new program does not have: try again later
};

// The contents of cells that only one of two programs has, when that program takes over again.
enum class OwnContents : uint8_t {
  Initial, // the initial contents
  AsLeft,  // the contents after its last scan
};

class Replacement {
public:
  // `next` has the dialect of `running`; both outlive this object and the instance's use of them.
  Replacement(const rung_program& running, const Runnable& next, const Naming& naming = {});

  const rung_program& next() const { return *loaded_.program; }
  const std::shared_ptr<const CopyLists>& copyLists() const { return loaded_.copyLists; } // of the next program
  // What happens to the state when the program held here takes over. Any thread.
  const StateTransfer& transfer() const noexcept { return direction().transfer; }
  // The number of bytes that taking over copies; its time is proportional to it. All of the state is copied if the
  // block of the running program has no room for the next one. Any thread.
  uint64_t bytes() const noexcept {
    return sharesBlock_ ? direction().inSharedBlock.bytes() + 2 * swappedBytes_ : direction().transfer.bytes();
  }

private:
  friend class Instance;
  // The change from one of the two programs to the other.
  struct Direction {
    Direction(const rung_program& from, const rung_program& to, const Naming& naming)
        : transfer(from, to, naming), inSharedBlock(transfer) {}
    StateTransfer transfer;
    StateTransfer inSharedBlock;   // without the bytes that keep their place
    std::vector<uint8_t> contents; // initial contents of the program, if blocks are swapped
  };
  const Direction& direction() const noexcept { return directions_[isReturn_.load(std::memory_order_acquire) ? 1 : 0]; }
  // If most of the state keeps its place, the next program takes over the memory block of the running one. The
  // remaining contents are prepared in a second block, and the two are swapped.
  void planSharedBlock(const rung_program& running);
  bool mayShare(const LoadedProgram& running) const noexcept;
  void beginAnew(bool shares) noexcept;
  // Moves the state. Afterwards `running` is the next program, and this object holds the former one.
  void exchange(LoadedProgram& running, OwnContents own) noexcept;

  LoadedProgram loaded_;
  std::array<Direction, 2> directions_; // to the next program, and back
  std::atomic<bool> isReturn_{false};
  bool hasRun_ = false;      // the program held here
  bool sharesBlock_ = false; // both programs use one memory block, because that takes less time
  std::vector<rung_span> swaps_;
  uint64_t swappedBytes_ = 0; // of one block
};

} // namespace rung::runtime
