// The reference interpreter: the meaning of each operation, written as plainly as possible. It runs on the same memory
// block, tables and chunks as compiled code, so every other engine can be compared with it byte for byte.
//
// Its chunks need it in the context of each instance: a host makes instances of the engine, not of its program.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "ir/core/memory_use.h"
#include "ir/core/regions.h"
#include "ir/image/program_image.h"
#include "ir/shape/layout.h"
#include "ir/shape/partition.h"
#include "rtlib/load/engine.h"

namespace rung::ir {

// An access of an operation to memory or to a slot.
struct Access {
  uint32_t rung = 0;      // over all routines
  uint32_t operation = 0; // index in the rung
  BitRange place;         // of a slot: in no space
  SlotId slot;            // invalid: memory
  uint64_t value = 0;     // read or written
  bool writes = false;
};

// Observes runs of rungs, e.g. to measure coverage. Called on the thread that runs the program.
class RungObserver {
public:
  virtual ~RungObserver() = default;
  // Called after the rung with this number (over all routines) has run; `values` holds the bits of its values, 0 in
  // regions that were not entered. No values: it stopped the program with a fault.
  virtual void rungRan(uint32_t number, std::span<const uint64_t> values) = 0;
  // Called after each access of a rung, in their order, before its rungRan.
  virtual void accessed(const Access& /*access*/) {}
};

// What the profile counters of an instrumented module count.
enum class Counting : uint8_t {
  Ticks,
  // Executed operations: all but constants, notes and the ends of branches, and one for a transfer. An exact measure,
  // the same in every run.
  Operations,
};

class InterpEngine final : public runtime::Engine {
public:
  // The layout and its module must outlive the engine.
  InterpEngine(const Layout& layout, uint64_t codeHash, Counting counting = Counting::Ticks);

  const rung_program& program() const override { return image_.program(); }
  std::string_view name() const override { return "interp"; }
  void* context() override { return this; }
  // Runs a chunk, for code that replaces the program's functions.
  uint32_t runChunk(uint8_t* mem, rung_ctx& ctx, uint32_t chunk) const;
  // Whether running some rung allocates heap memory for its values.
  bool allocates() const;
  // Null: no observer. The instances of an observed engine must not run at the same time.
  void setObserver(std::unique_ptr<RungObserver> observer) { observer_ = std::move(observer); }

private:
  static uint32_t chunkFunction(uint8_t* mem, rung_ctx* ctx, uint32_t chunk);

  const Layout& layout_;
  Counting counting_;
  ProgramImage image_;
  std::vector<rung_chunk_fn> functions_; // by chunk, all the same function
  std::unique_ptr<RungObserver> observer_;
  std::vector<Exit> exits_; // by rung number
  // By rung number and operation: the other end of a region (if: its else or endif; else: its endif; loop and endloop:
  // each other). Empty for a rung without regions.
  std::vector<std::vector<Region>> regions_;
  size_t mostValues_ = 0; // of any rung
  size_t mostArgs_ = 0;   // of any operation
};

} // namespace rung::ir
