// Tracks when memory was written (see write_times.h).
#include "ir/analysis/write_times.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

constexpr uint64_t kFree = ~0ull;
constexpr uint64_t kSlots = RUNG_NONE - 1; // in place of a space

bool isFixed(const Op& op) {
  return op.code == OpCode::Load || op.code == OpCode::Store || op.code == OpCode::SlotLoad ||
         op.code == OpCode::SlotStore;
}

} // namespace

WriteTimes::Place WriteTimes::placeOf(const Op& op) {
  if (opInfo(op.code).attr == Attr::Slot) return {(kSlots << 32) | op.ref, 1, -1};
  const auto offset = static_cast<uint64_t>(op.imm);
  const uint64_t first = (uint64_t{op.ref} << 32) | offset / 8;
  if (op.type == Type::Bit) return {first, 1, static_cast<int>(offset % 8)};
  return {first, byteWidth(op.type), -1};
}

void WriteTimes::start(const Rung& rung) {
  size_t written = 0;
  for (const Op& op : rung.ops)
    if (op.code == OpCode::Store || op.code == OpCode::SlotStore) written += placeOf(op).bytes;
  bytes_.assign(std::bit_ceil(2 * written + 1), {kFree, 0, 0, {}});
  ++rung_;
  all_ = 0;
}

WriteTimes::Byte* WriteTimes::findByte(uint64_t key) {
  const size_t mask = bytes_.size() - 1;
  size_t at = ((key * 0x9E3779B97F4A7C15ull) >> 32) & mask;
  while (bytes_[at].key != kFree && bytes_[at].key != key) at = (at + 1) & mask;
  return &bytes_[at];
}

WriteTimes::SpaceWrites& WriteTimes::writesTo(uint32_t space) {
  SpaceWrites& writes = spaces_[space];
  if (writes.rung != rung_) writes = {.rung = rung_};
  return writes;
}

void WriteTimes::write(const Op& op, uint32_t time) {
  if (opInfo(op.code).attr != Attr::Slot) writesTo(op.ref).any = time;
  if (!isFixed(op)) return writeWindow(op, time);
  const Place place = placeOf(op);
  for (uint32_t i = 0; i < place.bytes; ++i) {
    Byte& byte = *findByte(place.firstByte + i);
    byte.key = place.firstByte + i;
    if (place.bit < 0)
      byte.whole = time;
    else
      byte.bit[place.bit] = byte.anyBit = time;
  }
}

void WriteTimes::writeWindow(const Op& op, uint32_t time) {
  const uint64_t begin = static_cast<uint64_t>(op.imm) / 8;
  const uint64_t unit = module_.spaces[op.ref].unitBytes;
  const uint64_t end = begin + (uint64_t{op.count} - 1) * unit + std::max<uint64_t>(unit, byteWidth(op.type));
  SpaceWrites& writes = writesTo(op.ref);
  const std::span known(writes.window, writes.windows);
  // Joined with an overlapping or adjacent range, or with the last one if there is no room for another.
  auto with = std::ranges::find_if(known, [&](const WindowWrites& w) { return begin <= w.end && w.begin <= end; });
  if (with == known.end() && writes.windows < std::size(writes.window)) {
    writes.window[writes.windows++] = {time, begin, end};
    return;
  }
  if (with == known.end()) --with;
  *with = {time, std::min(with->begin, begin), std::max(with->end, end)};
}

// Considers writes through windows, and for a load through a window all writes.
bool WriteTimes::spaceUnchanged(const Op& op, uint32_t time) const {
  const SpaceWrites& writes = spaces_[op.ref];
  if (writes.rung != rung_) return true;
  if (!isFixed(op)) return writes.any <= time;
  const uint64_t first = static_cast<uint64_t>(op.imm) / 8;
  const uint64_t end = first + std::max(1u, byteWidth(op.type));
  return std::ranges::none_of(std::span(writes.window, writes.windows),
                              [&](const WindowWrites& w) { return w.time > time && w.begin < end && first < w.end; });
}

bool WriteTimes::unchanged(const Op& op, uint32_t time) const {
  if (all_ > time) return false;
  if (opInfo(op.code).attr != Attr::Slot && !spaceUnchanged(op, time)) return false;
  if (!isFixed(op)) return true;
  const Place place = placeOf(op);
  for (uint32_t i = 0; i < place.bytes; ++i) {
    const Byte& byte = *findByte(place.firstByte + i);
    if (byte.key == kFree) continue;
    if (std::max(byte.whole, place.bit < 0 ? byte.anyBit : byte.bit[place.bit]) > time) return false;
  }
  return true;
}

} // namespace rung::ir
