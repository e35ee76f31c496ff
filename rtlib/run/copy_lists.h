// The lists of core::NeededCopies for one program, made of its tables. Allocates when it is made.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rtlib/core/needed_copies.h"
#include "rung/program.h"

namespace rung::runtime {

class CopyLists {
public:
  // `whole`: nothing is left out.
  CopyLists(const rung_program& program, bool whole);

  core::NeededCopies views() const noexcept { return {.copies = copies_, .tasks = tasks_, .leftOut = leftOut_}; }

private:
  using Bytes = std::vector<bool>; // of the memory block

  void findTouched(const rung_program& program);
  core::NeededCopies::Range add(std::span<const rung_copy> copies);
  void addWhole(const rung_copy& copy);
  void addMasked(const rung_copy& copy);

  uint32_t least_; // bytes: shorter copies stay whole
  Bytes written_;  // by chunks
  Bytes touched_;  // or read, by chunks or copies
  std::vector<rung_copy> copies_;
  std::vector<core::NeededCopies::Task> tasks_;
  std::vector<rung_copy> leftOut_;
};

} // namespace rung::runtime
