// Determines the places of operations (see memory_use.h).
#include "ir/core/memory_use.h"

#include <algorithm>

#include "ir/core/op_info.h"

namespace rung::ir {
namespace {

uint32_t bytesOf(const Space& space) { return space.units * space.unitBytes; }

} // namespace

bool overlap(const BitRange& a, const BitRange& b) {
  return a.space == b.space && a.first < b.first + b.count && b.first < a.first + a.count;
}

std::optional<Use> useOf(const Module& module, const Op& op) {
  const OpInfo& info = opInfo(op.code);
  if (info.attr != Attr::Place && info.attr != Attr::Window) return std::nullopt;
  const Space& space = module.spaces[op.ref];
  const auto first = static_cast<uint32_t>(op.imm);
  const bool window = info.attr == Attr::Window;
  const uint32_t one = std::max(bitWidth(op.type), window ? space.unitBytes * 8 : 1u);
  // Elements are one unit apart; the last one may extend beyond it.
  const uint64_t all = window && op.count > 1 ? one + uint64_t{op.count - 1} * space.unitBytes * 8 : one;
  const uint64_t room = uint64_t{bytesOf(space)} * 8 - first;
  Use use;
  use.place = {SpaceId{op.ref}, first, static_cast<uint32_t>(std::min(all, room))};
  use.type = op.type;
  use.writes = (info.effects & kWrites) != 0;
  use.computed = window;
  return use;
}

} // namespace rung::ir
