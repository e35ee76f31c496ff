// Forced bits: after every operation that may write a forced bit, the bit is set to its forced value again, before
// anything can read it. A store whose bits are all forced stores the forced values instead.
#include "ir/transforms/force.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "ir/core/memory_use.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {
namespace {

std::pair<uint32_t, uint32_t> placeOf(const rung_forced_byte& forced) { return {forced.space, forced.byte}; }

class Forcer {
public:
  Forcer(const Module& module, std::span<const rung_forced_byte> forced) : module_(module), forced_(forced) {}

  void run(Rung& rung) {
    if (!std::ranges::any_of(rung.ops, [&](const Op& op) { return !reachedBy(op).empty(); })) return;
    rewriter_.start(rung);
    for (const Op& op : rung.ops) write(op);
    rewriter_.finish(rung);
  }

private:
  // Forced bytes that the operation may write.
  std::span<const rung_forced_byte> reachedBy(const Op& op) {
    if ((opInfo(op.code).effects & kWrites) == 0) return {};
    const std::optional<Use> use = useOf(module_, op);
    if (!use) return {};
    written_ = use->place;
    const std::pair first(written_.space.index, written_.first / 8);
    const std::pair last(written_.space.index, (written_.first + written_.count - 1) / 8);
    return {std::ranges::lower_bound(forced_, first, {}, placeOf),
            std::ranges::upper_bound(forced_, last, {}, placeOf)};
  }

  void write(const Op& op) {
    const std::span<const rung_forced_byte> reached = reachedBy(op);
    if (op.code == OpCode::Store && covers(reached)) return store(op, op.type, written_.first, bitsOf(reached));
    rewriter_.copy(op);
    for (const rung_forced_byte& byte : reached) {
      const uint32_t bits = byte.mask & writtenBits(byte.byte);
      if (bits == 0xFF && op.type != Type::Bit) {
        store(op, Type::I8, byte.byte * 8, byte.value);
        continue;
      }
      for (uint32_t bit = 0; bit < 8; ++bit)
        if ((bits >> bit & 1) != 0) store(op, Type::Bit, byte.byte * 8 + bit, byte.value >> bit & 1);
    }
  }

  // The bits of a byte that the operation may write.
  uint32_t writtenBits(uint32_t byte) const {
    uint32_t bits = 0;
    for (uint32_t bit = 0; bit < 8; ++bit)
      if (byte * 8 + bit - written_.first < written_.count) bits |= 1u << bit;
    return bits;
  }
  // Whether all bits that the operation writes are forced.
  bool covers(std::span<const rung_forced_byte> reached) const {
    int bits = 0;
    for (const rung_forced_byte& byte : reached) bits += std::popcount(byte.mask & writtenBits(byte.byte));
    return bits == static_cast<int>(written_.count);
  }
  // The value that it then writes.
  uint64_t bitsOf(std::span<const rung_forced_byte> reached) const {
    uint64_t bits = 0;
    for (const rung_forced_byte& byte : reached) {
      const uint64_t value = byte.value & writtenBits(byte.byte);
      const uint32_t first = byte.byte * 8;
      bits |= first >= written_.first ? value << (first - written_.first) : value >> (written_.first - first);
    }
    return bits;
  }

  void store(const Op& op, Type type, uint32_t firstBit, uint64_t bits) {
    const ValueId value = rewriter_.putConstant(op, type, bits);
    Op& stored = rewriter_.put(op, OpCode::Store, type, {value});
    stored.ref = written_.space.index;
    stored.imm = firstBit;
  }

  const Module& module_;
  std::span<const rung_forced_byte> forced_;
  RungRewriter rewriter_;
  BitRange written_; // of the last operation queried
};

} // namespace

void forceBits(Module& module, std::span<const rung_forced_byte> forced) {
  Forcer forcer(module, forced);
  for (Routine& routine : module.routines)
    for (Rung& rung : routine.rungs) forcer.run(rung);
}

} // namespace rung::ir
