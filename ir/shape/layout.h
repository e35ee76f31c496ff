// The layout that every engine follows: the places of a program's memory, and the partition of its rungs into chunks.
// The two are independent; code that needs only one of them includes that one.
#pragma once
#include <utility>

#include "ir/shape/memory_layout.h"
#include "ir/shape/partition.h"

namespace rung::ir {

struct LayoutOptions {
  PartitionOptions partition;
  bool expandBits = true; // false: everything is packed
};

// Memory, chunks, longest paths and access tables follow from the shape of a program: its module before the
// optimisation of single rungs (runPasses). The code is a variant of the shape, optimised or not, with forced cells or
// without: its rungs have no exit and no access that those of the shape do not have.
class Layout {
public:
  // `shape` has passed the verifier and must outlive the layout. The code is the shape itself.
  Layout(const Module& shape, const LayoutOptions& options)
      : memory_(shape, options.expandBits), shape_(shape, options.partition), code_(shape_) {}

  // The same memory and chunks for the code of `module`, which must outlive the result. A rung with an exit that the
  // shape does not have stops the process.
  Layout over(const Module& module) const { return {memory_, shape_, shape_.over(module)}; }

  const Module& module() const { return code_.module(); }
  const MemoryLayout& memory() const { return memory_; }
  const Partition& partition() const { return code_; } // of the code that engines run
  const Partition& shape() const { return shape_; }    // of the shape, from which tables are made

private:
  Layout(MemoryLayout memory, Partition shape, Partition code)
      : memory_(std::move(memory)), shape_(std::move(shape)), code_(std::move(code)) {}

  MemoryLayout memory_;
  Partition shape_;
  Partition code_;
};

} // namespace rung::ir
