// One run of one rung by the interpreter.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ir/interp/interp.h"
#include "ir/shape/memory_layout.h"

namespace rung::ir {

class RungRun {
public:
  // `values` has an entry for each value of the rung, with its bits (see ir/core/eval.h); `carried` one for each
  // operand of any operation. All references must outlive the run.
  RungRun(const MemoryLayout& layout, const Rung& rung, uint32_t number, const std::vector<Region>& regions,
          uint8_t* mem, rung_ctx& ctx, std::span<uint64_t> values, std::span<uint64_t> carried, Counting counting,
          RungObserver* observer)
      : layout_(layout), rung_(rung), number_(number), regions_(regions), mem_(mem), ctx_(ctx), values_(values),
        carried_(carried), counting_(counting), observer_(observer) {}

  // False after a fault, which is in the context.
  bool run();

private:
  size_t step(const Op& op, size_t index);
  uint64_t in(const Op& op, int i) const { return values_[arg(rung_, op, i).index]; }
  void give(const Op& op, uint64_t value) { values_[op.result.index] = value; }
  void giveArgs(const Op& from, const Op& to, uint32_t skip);

  uint64_t readBytes(uint32_t offset, Type type) const;
  void writeBytes(uint32_t offset, Type type, uint64_t value);
  uint64_t readBit(BitLocation at) const;
  void writeBit(BitLocation at, bool value);
  uint32_t slotOffset(const Op& op) const { return layout_.slot(SlotId{op.ref}); }
  void tell(const Op& op, const BitRange& place, SlotId slot, uint64_t value, bool writes) const;
  void tellMemory(const Op& op, uint64_t bit, uint64_t value, bool writes) const;
  uint32_t unitBytes(const Op& op) const { return layout_.module().spaces[op.ref].unitBytes; }

  void load(const Op& op);
  void store(const Op& op);
  void loadAt(const Op& op);
  void storeAt(const Op& op);
  void loadBitAt(const Op& op);
  void storeBitAt(const Op& op);
  void slotLoad(const Op& op);
  void slotStore(const Op& op);

  size_t beginIf(const Op& op, size_t index);
  size_t beginLoop(const Op& op, size_t index);
  size_t endLoop(const Op& op, size_t index);
  void evaluate(const Op& op);
  void message(const Op& op);
  void request(const Op& op);
  void setFault(const Op& op);
  uint64_t clock() const;
  void countRung();

  const MemoryLayout& layout_;
  const Rung& rung_;
  const uint32_t number_;
  const std::vector<Region>& regions_;
  uint8_t* const mem_;
  rung_ctx& ctx_;
  std::span<uint64_t> values_;
  std::span<uint64_t> carried_;
  const Counting counting_;
  RungObserver* const observer_; // null: none
  uint64_t operations_ = 0;      // executed so far
};

} // namespace rung::ir
