// Chooses the representation (see representation.h): collects the accesses to each byte, makes copies agree, fills
// gaps.
#include "ir/shape/representation.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "ir/core/op_info.h"
#include "rung/types.hpp"

namespace rung::ir {
namespace {

enum Use : uint8_t { kUntouched = 0, kBits = 1, kWhole = 2 };
using Uses = std::vector<std::vector<uint8_t>>;

// Gaps of up to this many bytes between expanded bytes are expanded, too: fewer ranges, so fewer pieces to copy.
constexpr size_t kGap = 16;

// The accesses to the bytes of one space. Windows are long and many are equal, so they are added once, at the end: the
// time grows with their number and with the space, not with the product.
class SpaceUses {
public:
  explicit SpaceUses(const Space& space)
      : bytes_(static_cast<size_t>(space.units) * space.unitBytes, space.packedOnly ? kWhole : kUntouched) {}

  void markBits(uint64_t byte) {
    if (byte < bytes_.size()) bytes_[byte] = std::max<uint8_t>(bytes_[byte], kBits);
  }
  void markWhole(uint64_t first, uint64_t size) { whole_.push_back({first, first + size}); }

  std::vector<uint8_t> take() {
    std::ranges::sort(whole_);
    uint64_t filled = 0;
    for (const auto& [first, end] : whole_) {
      const uint64_t from = std::max(first, filled);
      filled = std::max(filled, std::min<uint64_t>(end, bytes_.size()));
      for (uint64_t i = from; i < filled; ++i) bytes_[i] = kWhole;
    }
    return std::move(bytes_);
  }

private:
  std::vector<uint8_t> bytes_;
  std::vector<std::pair<uint64_t, uint64_t>> whole_; // begin and end of accesses to bytes
};

void markOp(const Module& module, const Op& op, std::vector<SpaceUses>& uses) {
  const Attr attr = opInfo(op.code).attr;
  if (attr != Attr::Place && attr != Attr::Window) return;
  const uint64_t first = static_cast<uint64_t>(op.imm) / 8;
  SpaceUses& space = uses[op.ref];
  if (attr == Attr::Place)
    return op.type == Type::Bit ? space.markBits(first) : space.markWhole(first, byteWidth(op.type));
  if (op.count == 0) return;
  const uint64_t unit = module.spaces[op.ref].unitBytes;
  const uint64_t last = op.type == Type::Bit ? unit : byteWidth(op.type);
  space.markWhole(first, (op.count - 1) * unit + last);
}

Uses collectUses(const Module& module) {
  std::vector<SpaceUses> uses(module.spaces.begin(), module.spaces.end());
  for (const Routine& routine : module.routines)
    for (const Rung& rung : routine.rungs)
      for (const Op& op : rung.ops) markOp(module, op, uses);
  for (const Symbol& symbol : module.symbols)
    if (symbol.space.valid())
      uses[symbol.space.index].markWhole(symbol.byte, uint64_t{elementBits(symbol.type)} / 8 * symbol.count);
  for (const Continuation& c : module.continuations)
    if (c.space.valid()) uses[c.space.index].markWhole(c.byte, 4);
  for (const Init& init : module.inits) uses[init.space.index].markWhole(init.byte, init.data.size());
  Uses bytes;
  for (SpaceUses& space : uses) bytes.push_back(space.take());
  return bytes;
}

// Calls visit(a, b) for every pair of bytes that a copy connects and that differ. Most copies are long, and agree.
template <class Visit>
void forConnected(const Module& module, Uses& uses, Visit visit) {
  for (const Task& task : module.tasks)
    for (const std::vector<Copy>* copies : {&task.begin, &task.end})
      for (const Copy& copy : *copies) {
        const auto piece = [&](SpaceId space, uint32_t byte) {
          return std::span(uses[space.index]).subspan(byte, copy.from.size);
        };
        const std::span<uint8_t> from = piece(copy.from.space, copy.from.byte);
        const auto connect = [&](std::span<uint8_t> to) {
          if (std::memcmp(from.data(), to.data(), from.size()) == 0) return;
          for (size_t i = 0; i < from.size(); ++i)
            if (from[i] != to[i]) visit(from[i], to[i]);
        };
        connect(piece(copy.to, copy.toByte));
        if (copy.masked) connect(piece(copy.mask, copy.maskByte));
      }
}

// Makes connected bytes equal by giving both the more demanding use; repeated until nothing changes, because copies may
// form chains.
void agree(const Module& module, Uses& uses) {
  bool changed = true;
  while (changed) {
    changed = false;
    forConnected(module, uses, [&](uint8_t& a, uint8_t& b) {
      changed = true;
      a = b = std::max(a, b);
    });
  }
}

void fillGaps(std::vector<uint8_t>& uses) {
  size_t lastBits = uses.size(); // none yet
  for (size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] == kWhole) lastBits = uses.size();
    if (uses[i] != kBits) continue;
    if (lastBits < i && i - lastBits - 1 <= kGap)
      std::fill(uses.begin() + static_cast<ptrdiff_t>(lastBits), uses.begin() + static_cast<ptrdiff_t>(i), kBits);
    lastBits = i;
  }
}

// A gap at the end of a copied piece may have been filled on one side only; it has no accesses, so that is undone.
void undoOneSidedGaps(const Module& module, Uses& uses) {
  bool changed = true;
  while (changed) {
    changed = false;
    forConnected(module, uses, [&](uint8_t& a, uint8_t& b) {
      if ((a == kBits) == (b == kBits)) return;
      changed = true;
      a = b = kUntouched;
    });
  }
}

} // namespace

Representation chooseRepresentation(const Module& module, bool expandBits) {
  Uses uses = collectUses(module);
  if (expandBits) {
    agree(module, uses);
    for (std::vector<uint8_t>& space : uses) fillGaps(space);
    undoOneSidedGaps(module, uses);
  }
  for (std::vector<uint8_t>& space : uses)
    for (uint8_t& use : space) use = expandBits && use == kBits ? RUNG_REPR_BYTE_PER_BIT : RUNG_REPR_PACKED;
  return uses;
}

} // namespace rung::ir
