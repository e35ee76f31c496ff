// A program beside the memory that one instance of it needs: what another program replaces.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "rtlib/core/runner.h"
#include "rtlib/run/copy_lists.h"
#include "rtlib/run/overwritten.h"

namespace rung::runtime {

// What an instance runs. All outlive it; the program has passed checkProgram.
struct Runnable {
  const rung_program& program;
  void* engine = nullptr; // what the chunks find in rung_ctx::engine
  uint8_t* memory =
      nullptr; // the memory block, of core::Memory::kLeastBlock bytes at least; null: of the instance's own
  // Names for its services, which outlive the instance's queue of requests; null: the program's own.
  const char* const* services = nullptr;
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
  const char* const* services; // names
  uint32_t blockBytes;         // the block has so many, of which the program needs its memory_size
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
