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

Area fixedArea(Memory& m, ir::SpaceId space, uint32_t bytes, uint32_t first) {
  return {.space = space,
          .bytes = bytes,
          .fixed = true,
          .first = first,
          .at = m.address(Type::I32, first, {.space = space, .byte = first})};
}

Area areaOf(Memory& m, const Operand& operand) {
  const MemoryAccess access = m.reach(operand);
  const uint32_t bytes = m.bytesOf(operand.place.space);
  if (!access.indexed) return fixedArea(m, access.place.space, bytes, access.place.byte);
  return {.space = operand.place.space, .bytes = bytes, .fixed = false, .first = 0, .at = access.index};
}

ValueId loadByte(Memory& m, const Area& area, ValueId i, Type type) {
  const ir::Window window{.space = area.space, .byte = 0, .count = area.bytes - ir::byteWidth(type) + 1};
  return m.b().loadAt(type, window, m.b().add(area.at, i));
}

void storeByte(Memory& m, const Area& area, ValueId i, ValueId value) {
  const uint32_t width = ir::byteWidth(m.b().typeOf(value));
  const ir::Window window{.space = area.space, .byte = 0, .count = area.bytes - width + 1};
  m.b().storeAt(window, m.b().add(area.at, i), value);
}

Area shifted(Memory& m, Area area, ValueId by) {
  area.at = m.b().add(area.at, by);
  area.fixed = false;
  return area;
}

Length fixedCount(Memory& m, uint32_t count) { return {.fixed = true, .most = count, .value = m.b().i32(count)}; }

Length countOf(Memory& m, const Operand& operand) {
  if (operand.isConstant()) return fixedCount(m, static_cast<uint32_t>(operand.value));
  const uint32_t most = operand.type == Type::I8 ? 0xFF : 0xFFFF;
  return {.fixed = false, .most = most, .value = m.b().zextOrTrunc(Type::I32, m.value(operand))};
}

Length smaller(Memory& m, const Length& a, const Length& b) {
  if (a.fixed && b.fixed) return a.most < b.most ? a : b;
  return {.fixed = false, .most = std::min(a.most, b.most), .value = least(m.b(), a.value, b.value)};
}

namespace {

// One pass copies or clears `type` at i * its width + `offset`, from the last one on if `backward`.
void copyPasses(Memory& m, const Area& to, const Area& from, uint32_t passes, Type type, uint32_t offset,
                bool backward) {
  if (passes == 0) return;
  ir::RungBuilder& b = m.b();
  ValueId i = b.loop(passes)[0];
  if (backward) i = b.sub(b.i32(passes - 1), i);
  i = b.add(b.mul(i, b.i32(ir::byteWidth(type))), b.i32(offset));
  storeByte(m, to, i, loadByte(m, from, i, type));
  b.endLoop();
}

void clearPasses(Memory& m, const Area& area, uint32_t passes, Type type, uint32_t offset) {
  if (passes == 0) return;
  ir::RungBuilder& b = m.b();
  const ValueId i = b.loop(passes)[0];
  storeByte(m, area, b.add(b.mul(i, b.i32(ir::byteWidth(type))), b.i32(offset)), b.constant(type, 0));
  b.endLoop();
}

// Areas and count are constants: eight bytes a pass.
void copyFixed(Memory& m, const Area& to, const Area& from, uint32_t count) {
  const bool backward = to.space == from.space && to.first > from.first && !m.isCompared();
  const uint32_t chunks = count / kChunk, rest = count % kChunk;
  if (!backward) copyPasses(m, to, from, chunks, Type::I64, 0, false);
  copyPasses(m, to, from, rest, Type::I8, chunks * kChunk, backward);
  if (backward) copyPasses(m, to, from, chunks, Type::I64, 0, true);
}

// body(i) for each i below a count that the program knows.
void eachBelow(Memory& m, const Length& count, auto body) {
  ir::RungBuilder& b = m.b();
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

void copy(Memory& m, const Area& to, const Area& from, const Length& count) {
  if (count.most == 0) return;
  if (count.fixed && to.fixed && from.fixed) return copyFixed(m, to, from, count.most);
  ir::RungBuilder& b = m.b();
  const ValueId backward = to.space == from.space ? b.ltU(from.at, to.at) : b.bit(false);
  const ValueId last = b.sub(count.value, b.i32(1));
  eachBelow(m, count, [&](ValueId pass) {
    const ValueId i = b.select(backward, b.sub(last, pass), pass);
    storeByte(m, to, i, loadByte(m, from, i));
  });
}

void clear(Memory& m, const Area& area, const Length& count) {
  if (count.most == 0) return;
  if (count.fixed) {
    clearPasses(m, area, count.most / kChunk, Type::I64, 0);
    clearPasses(m, area, count.most % kChunk, Type::I8, count.most / kChunk * kChunk);
    return;
  }
  eachBelow(m, count, [&](ValueId i) { storeByte(m, area, i, m.b().constant(Type::I8, 0)); });
}

void clearRange(Memory& m, ir::SpaceId space, uint32_t first, uint32_t end) {
  for (; first < end; first += std::min(end - first, kMostCleared)) {
    clear(m, fixedArea(m, space, m.bytesOf(space), first), fixedCount(m, std::min(end - first, kMostCleared)));
    m.out().cut();
  }
}

Length inside(Memory& m, const Area& area, const Length& count) {
  if (area.fixed && count.fixed)
    return count.most <= area.bytes - area.first || m.isCompared() ? count : fixedCount(m, area.bytes - area.first);
  ir::RungBuilder& b = m.b();
  m.protect(b.ltU(m.given(Type::I32, area.bytes), b.add(area.at, count.value)));
  return count;
}

} // namespace rung::frontend::technol
