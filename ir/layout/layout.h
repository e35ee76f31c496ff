// What every engine obeys: where a program's memory lies, and how its rungs are cut into chunks. The two know nothing
// of each other; whoever needs one of them takes that one.
#pragma once
#include <utility>

#include "ir/chunks/cut.h"
#include "ir/layout/memory_layout.h"

namespace rung::ir {

struct LayoutOptions {
  CutOptions cut;
  bool expandBits = true; // false: everything is packed
};

class Layout {
public:
  // `module` has passed the verifier in mode Final and outlives the layout.
  Layout(const Module& module, const LayoutOptions& options)
      : memory_(module, options.expandBits), cut_(module, options.cut) {}

  // The same memory and the same chunks for another form of the module, whose rungs have the same ways out, or fewer.
  Layout over(const Module& module) const { return {memory_.over(module), cut_.over(module)}; }

  const Module& module() const { return cut_.module(); }
  const MemoryLayout& memory() const { return memory_; }
  const Cut& cut() const { return cut_; }

private:
  Layout(MemoryLayout memory, Cut cut) : memory_(std::move(memory)), cut_(std::move(cut)) {}

  MemoryLayout memory_;
  Cut cut_;
};

} // namespace rung::ir
