// When a rung last wrote which memory, and so whether a value that a place held at some time is still valid. Times are
// numbers of operations, counted from 1. Fixed places are tracked bit by bit, windows as a few ranges per space.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

class WriteTimes {
public:
  explicit WriteTimes(const Module& module) : module_(module), spaces_(module.spaces.size()) {}

  void start(const Rung& rung);
  // `op` writes: a store of any kind.
  void write(const Op& op, uint32_t time);
  // Any memory may have been written.
  void writeAll(uint32_t time) { all_ = time; }
  // Whether the place that `op` (a load or store of any kind) accesses has not been written since `time`.
  bool unchanged(const Op& op, uint32_t time) const;

private:
  struct Place {
    uint64_t firstByte; // with the number of the space; slots count as a separate space
    uint32_t bytes;
    int bit; // -1: whole bytes
  };
  struct Byte {
    uint64_t key;
    uint32_t whole;
    uint32_t anyBit;
    uint32_t bit[8];
  };
  // The last write through windows within these bytes.
  struct WindowWrites {
    uint32_t time = 0;
    uint64_t begin = 0;
    uint64_t end = 0;
  };
  // Writes through windows; invalid if `rung` is not the current one.
  struct SpaceWrites {
    uint32_t rung = 0;
    uint32_t any = 0; // of any kind
    uint32_t windows = 0;
    WindowWrites window[8];
  };

  static Place placeOf(const Op& op);
  Byte* findByte(uint64_t key);
  const Byte* findByte(uint64_t key) const { return const_cast<WriteTimes*>(this)->findByte(key); }
  SpaceWrites& writesTo(uint32_t space);
  bool spaceUnchanged(const Op& op, uint32_t time) const;
  void writeWindow(const Op& op, uint32_t time);

  const Module& module_;
  std::vector<Byte> bytes_; // open addressing, a power of two, at most half full
  std::vector<SpaceWrites> spaces_;
  uint32_t rung_ = 0;
  uint32_t all_ = 0;
};

} // namespace rung::ir
