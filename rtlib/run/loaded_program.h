// The lists of core::NeededCopies for one program, computed from its tables. The constructor allocates.
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
  // `whole`: the copies leave nothing out.
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

// Finds the places that the input copies of a task overwrite before the program reads them. A value that a host writes
// there is lost; written to the source of the copy it lasts.

class Overwritten {
public:
  explicit Overwritten(const rung_program& program) : program_(&program) {} // which outlives it

  // The place that is copied over `ref`; nothing when a value written to `ref` lasts. Allocates nothing.
  std::optional<Ref> source(const Ref& ref) const;

private:
  const rung_copy* over(uint32_t offset) const;

  const rung_program* program_;
};

// LoadedProgram: a program together with the memory that one instance of it needs; replacing a program replaces this.

// What an instance runs. The members outlive the instance, and the program has passed checkProgram.
struct Runnable {
  const rung_program& program;
  void* engine = nullptr; // rung_ctx::engine of its chunks
  uint8_t* memory =
      nullptr; // the memory block, of core::Memory::kLeastBlock bytes at least; null: of the instance's own
  // Names and numbers of the program's services, which outlive the instance's queue of requests; null: it makes none.
  const core::ServiceName* services = nullptr;
};

// A program with all the memory that one instance of it needs. Its memory block holds the initial contents.
struct LoadedProgram {
  // If the memory block belongs to the instance, it has `leastBytes` or more, so that a program that has grown fits
  // into it.
  explicit LoadedProgram(const Runnable& runnable, uint32_t leastBytes = 0);
  void clear() noexcept; // memory as the program's tables say
  // For rung_ctx::prof.
  rung_prof* counters() noexcept { return profile.empty() ? nullptr : profile.data(); }

  struct FreeBlock {
    size_t align; // 0: the block belongs to the caller
    void operator()(uint8_t* block) const;
  };
  const rung_program* program;
  void* engine;
  const core::ServiceName* services;
  uint32_t blockBytes; // the block has so many, of which the program needs its memory_size
  std::unique_ptr<uint8_t, FreeBlock> block;
  std::vector<rung_prof> profile;     // one a rung; empty when the program is not instrumented
  std::vector<core::PartState> parts; // one a task
  std::vector<rung_step> steps;       // room for the steps of a scan
  std::vector<uint8_t> retained;      // room for a warm start
  Overwritten overwritten;
  // The lists for copies; they leave nothing out in a block of the caller's, because the caller may look at all of it.
  std::shared_ptr<const CopyLists> copyLists;
  core::NeededCopies neededCopies; // views of copyLists
};

} // namespace rung::runtime
