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
  Bytes written_;  // bytes that chunks write
  Bytes touched_;  // bytes that chunks or copies read or write
  std::vector<rung_copy> copies_;
  std::vector<core::NeededCopies::Task> tasks_;
  std::vector<rung_copy> leftOut_;
};

// Finds the places that the input copies of a task overwrite before the program reads them. A value that a host writes
// there is lost; written to the source of the copy it lasts.

class Overwritten {
public:
  explicit Overwritten(const rung_program& program) : program_(&program) {} // which outlives this object

  // The place that is copied over `ref`; nothing when a value written to `ref` lasts. Allocates nothing.
  std::optional<Ref> source(const Ref& ref) const;

private:
  const rung_copy* over(uint32_t offset) const;

  const rung_program* program_;
};

// A program for an instance. The members outlive the instance, and the program has passed checkProgram.
struct Runnable {
  const rung_program& program;
  void* engine = nullptr; // rung_ctx::engine of its chunks
  // The memory block, of at least core::Memory::kLeastBlock bytes; null: the instance allocates it.
  uint8_t* memory = nullptr;
  // Names and kinds of the program's services, which outlive the instance's queue of requests; null: its requests have
  // no names.
  const core::ServiceName* services = nullptr;
};

// A program with all the memory that one instance of it needs; replacing a program replaces this object. The
// constructor fills the memory block with the initial contents.
struct LoadedProgram {
  // A memory block that the instance allocates has at least `leastBytes` bytes, so that a longer program fits in it.
  explicit LoadedProgram(const Runnable& runnable, uint32_t leastBytes = 0);
  void clear() noexcept; // resets the memory to its initial contents
  // For rung_ctx::prof.
  rung_prof* counters() noexcept { return profile.empty() ? nullptr : profile.data(); }

  struct FreeBlock {
    size_t align; // 0: the block belongs to the caller
    void operator()(uint8_t* block) const;
  };
  const rung_program* program;
  void* engine;
  const core::ServiceName* services;
  uint32_t blockBytes; // size of the block; the program uses its memory_size
  std::unique_ptr<uint8_t, FreeBlock> block;
  std::vector<rung_prof> profile;     // one for each rung; empty if the program is not instrumented
  std::vector<core::PartState> parts; // one for each task
  std::vector<rung_step> steps;       // storage for the joined steps of a scan
  std::vector<uint8_t> retained;      // storage for a warm start
  Overwritten overwritten;
  // The lists of copies; nothing is left out in a block that belongs to the caller, who may access all of it.
  std::shared_ptr<const CopyLists> copyLists;
  core::NeededCopies neededCopies; // views of copyLists
};

} // namespace rung::runtime
