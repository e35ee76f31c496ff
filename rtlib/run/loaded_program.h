// The lists of core::NeededCopies for one program, made of its tables. Allocates when it is made.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rtlib/core/memory.h"
#include "rtlib/core/queues.h"
#include "rtlib/core/runner.h"
#include "rtlib/load/ref.h"
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

// Places that the input copies of a task overwrite before the program reads them: what a host writes there is lost, and
// lasts where the copy comes from.

class Overwritten {
public:
  explicit Overwritten(const rung_program& program) : program_(&program) {} // which outlives it

  // The place that is copied over `ref`; nothing when a value written to `ref` lasts. Allocates nothing.
  std::optional<Ref> source(const Ref& ref) const;

private:
  const rung_copy* over(uint32_t offset) const;

  const rung_program* program_;
};

// A program beside the memory that one instance of it needs: what another program replaces.

// What an instance runs. All outlive it; the program has passed checkProgram.
struct Runnable {
  const rung_program& program;
  void* engine = nullptr; // what the chunks find in rung_ctx::engine
  uint8_t* memory =
      nullptr; // the memory block, of core::Memory::kLeastBlock bytes at least; null: of the instance's own
  // What its services are, for as long as the instance's queue of requests; null: nobody asks.
  const core::ServiceName* services = nullptr;
};

// A program with all the memory that one instance of it needs; its memory block holds the initial contents.
struct LoadedProgram {
  // The memory block, where it is the instance's own, has `leastBytes` or more, and room for a program that has grown.
  explicit LoadedProgram(const Runnable& runnable, uint32_t leastBytes = 0);
  void clear() noexcept; // memory as the program's tables say
  // For rung_ctx::prof.
  rung_prof* counters() noexcept { return profile.empty() ? nullptr : profile.data(); }

  struct FreeBlock {
    size_t align; // 0: of somebody else
    void operator()(uint8_t* block) const;
  };
  const rung_program* program;
  void* engine;
  const core::ServiceName* services;
  uint32_t blockBytes; // the block has so many, of which the program needs its memory_size
  std::unique_ptr<uint8_t, FreeBlock> block;
  std::vector<rung_prof> profile;     // one a rung; empty when the program is not instrumented
  std::vector<core::PartState> parts; // one a task
  std::vector<rung_step> steps;       // room for those of a pass
  std::vector<uint8_t> retained;      // room for a warm start
  Overwritten overwritten;
  // Whole in a block of somebody else, who may look at all of it.
  std::shared_ptr<const CopyLists> copyLists;
  core::NeededCopies neededCopies; // in these
};

} // namespace rung::runtime
