// Memory areas (see areas.h).
#include "frontend/dialects/technol/lower/areas.h"

#include <algorithm>

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

constexpr uint32_t kChunk = 8;

namespace {

ValueId least(ir::RungBuilder& b, ValueId x, ValueId y) { return b.select(b.ltU(x, y), x, y); }

} // namespace

Area fixedArea(Emitter& emitter, ir::SpaceId space, uint32_t bytes, uint32_t first) {
  return {.space = space,
          .bytes = bytes,
          .fixed = true,
          .first = first,
          .at = emitter.address(Type::I32, first, {.space = space, .byte = first})};
}

Area areaAt(Memory& memory, const MemoryAccess& access) {
  const ir::SpaceId space = access.place.space;
  const uint32_t bytes = memory.bytesOf(space);
  if (!access.indexed) return fixedArea(memory.emitter(), space, bytes, access.place.byte);
  return {.space = space, .bytes = bytes, .fixed = false, .first = 0, .at = access.index};
}

Area areaOf(Memory& memory, const Operand& operand) { return areaAt(memory, memory.reach(operand)); }

ValueId loadByte(ir::RungBuilder& b, const Area& area, ValueId i, Type type) {
  const ir::Window window{.space = area.space, .byte = 0, .count = area.bytes - ir::byteWidth(type) + 1};
  return b.loadAt(type, window, b.add(area.at, i));
}

void storeByte(ir::RungBuilder& b, const Area& area, ValueId i, ValueId value) {
  const uint32_t width = ir::byteWidth(b.typeOf(value));
  const ir::Window window{.space = area.space, .byte = 0, .count = area.bytes - width + 1};
  b.storeAt(window, b.add(area.at, i), value);
}

Area shifted(ir::RungBuilder& b, Area area, ValueId by) {
  area.at = b.add(area.at, by);
  area.fixed = false;
  return area;
}

Length fixedCount(ir::RungBuilder& b, uint32_t count) { return {.fixed = true, .most = count, .value = b.i32(count)}; }

Length countOf(Memory& memory, const Operand& operand) {
  ir::RungBuilder& b = memory.emitter().b();
  if (operand.isConstant()) return fixedCount(b, static_cast<uint32_t>(operand.value));
  const uint32_t most = operand.type == Type::I8 ? 0xFF : 0xFFFF;
  return {.fixed = false, .most = most, .value = b.zextOrTrunc(Type::I32, memory.value(operand))};
}

Length smaller(ir::RungBuilder& b, const Length& x, const Length& y) {
  if (x.fixed && y.fixed) return x.most < y.most ? x : y;
  return {.fixed = false, .most = std::min(x.most, y.most), .value = least(b, x.value, y.value)};
}

namespace {

// Copies or clears one `type` per pass at i * its width + `offset`, starting with the last one if `backward`.
void copyPasses(ir::RungBuilder& b, const Area& to, const Area& from, uint32_t passes, Type type, uint32_t offset,
                bool backward) {
  if (passes == 0) return;
  ValueId i = b.loop(passes)[0];
  if (backward) i = b.sub(b.i32(passes - 1), i);
  i = b.add(b.mul(i, b.i32(ir::byteWidth(type))), b.i32(offset));
  storeByte(b, to, i, loadByte(b, from, i, type));
  b.endLoop();
}

void clearPasses(ir::RungBuilder& b, const Area& area, uint32_t passes, Type type, uint32_t offset) {
  if (passes == 0) return;
  const ValueId i = b.loop(passes)[0];
  storeByte(b, area, b.add(b.mul(i, b.i32(ir::byteWidth(type))), b.i32(offset)), b.constant(type, 0));
  b.endLoop();
}

// Copies a fixed number of bytes between fixed areas, eight bytes per pass.
void copyFixed(Emitter& emitter, const Area& to, const Area& from, uint32_t count) {
  ir::RungBuilder& b = emitter.b();
  const bool backward = to.space == from.space && to.first > from.first && !emitter.isCompared();
  const uint32_t chunks = count / kChunk, rest = count % kChunk;
  if (!backward) copyPasses(b, to, from, chunks, Type::I64, 0, false);
  copyPasses(b, to, from, rest, Type::I8, chunks * kChunk, backward);
  if (backward) copyPasses(b, to, from, chunks, Type::I64, 0, true);
}

// Emits body(i) for each i below a count that is known only at run time.
void eachBelow(ir::RungBuilder& b, const Length& count, auto body) {
  const bool blocks = count.most > 2 * kBlock;
  ValueId start;
  if (blocks) {
    start = b.mul(b.loop((count.most + kBlock - 1) / kBlock)[0], b.i32(kBlock));
    b.if_(b.ltU(start, count.value));
  }
  ValueId i = b.loop(blocks ? kBlock : count.most)[0];
  if (blocks) i = b.add(start, i);
  b.when(b.ltU(i, count.value), [&] { body(i); });
  b.endLoop();
  if (!blocks) return;
  b.endIf();
  b.endLoop();
}

} // namespace

void copy(Emitter& emitter, const Area& to, const Area& from, const Length& count) {
  if (count.most == 0) return;
  if (count.fixed && to.fixed && from.fixed) return copyFixed(emitter, to, from, count.most);
  ir::RungBuilder& b = emitter.b();
  const ValueId backward = to.space == from.space ? b.ltU(from.at, to.at) : b.bit(false);
  const ValueId last = b.sub(count.value, b.i32(1));
  eachBelow(b, count, [&](ValueId pass) {
    const ValueId i = b.select(backward, b.sub(last, pass), pass);
    storeByte(b, to, i, loadByte(b, from, i));
  });
}

void clear(ir::RungBuilder& b, const Area& area, const Length& count) {
  if (count.most == 0) return;
  if (count.fixed) {
    clearPasses(b, area, count.most / kChunk, Type::I64, 0);
    clearPasses(b, area, count.most % kChunk, Type::I8, count.most / kChunk * kChunk);
    return;
  }
  eachBelow(b, count, [&](ValueId i) { storeByte(b, area, i, b.constant(Type::I8, 0)); });
}

void clearRange(Memory& memory, ir::SpaceId space, uint32_t first, uint32_t end) {
  Emitter& emitter = memory.emitter();
  for (; first < end; first += std::min(end - first, kMostCleared)) {
    ir::RungBuilder& b = emitter.b();
    const Area area = fixedArea(emitter, space, memory.bytesOf(space), first);
    clear(b, area, fixedCount(b, std::min(end - first, kMostCleared)));
    emitter.out().cut();
  }
}

Length inside(Emitter& emitter, const Area& area, const Length& count) {
  ir::RungBuilder& b = emitter.b();
  const uint32_t exist = area.bytes - area.first;
  if (area.fixed && count.fixed) return count.most <= exist || emitter.isCompared() ? count : fixedCount(b, exist);
  emitter.protect(b.ltU(emitter.given(Type::I32, area.bytes), b.add(area.at, count.value)));
  return count;
}

} // namespace rung::frontend::technol
