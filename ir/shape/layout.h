// What every engine obeys: where a program's memory lies, and how its rungs are cut into chunks. The two know nothing
// of each other; code that needs only one of them includes that one.
#pragma once
#include <utility>

#include "ir/shape/memory_layout.h"
#include "ir/shape/partition.h"

namespace rung::ir {

struct LayoutOptions {
  PartitionOptions partition;
  bool expandBits = true; // false: everything is packed
};

// Memory, chunks, longest paths and access tables follow from the shape of a program: its module before anything is
// optimised in a rung (runPasses). The code is a form of the shape, optimised or not, with forced cells or without: its
// rungs have no exit and no access that those of the shape do not have.
class Layout {
public:
  // `shape` has passed the verifier and outlives the layout. The code is the shape itself.
  Layout(const Module& shape, const LayoutOptions& options)
      : memory_(shape, options.expandBits), shape_(shape, options.partition), code_(shape_) {}

  // The same memory and the same chunks, for the code of `module`, which outlives the result. A rung with an exit that
  // the shape does not have stops the process.
  Layout over(const Module& module) const { return {memory_, shape_, shape_.over(module)}; }

  const Module& module() const { return code_.module(); }
  const MemoryLayout& memory() const { return memory_; }
  const Partition& partition() const { return code_; } // of the code: what engines run
  const Partition& shape() const { return shape_; }    // of the shape: what tables are made from

private:
  Layout(MemoryLayout memory, Partition shape, Partition code)
      : memory_(std::move(memory)), shape_(std::move(shape)), code_(std::move(code)) {}

  MemoryLayout memory_;
  Partition shape_;
  Partition code_;
};

} // namespace rung::ir
