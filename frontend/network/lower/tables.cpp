// Rotation, code conversion and data tables (§7.5, §7.6, §7.11).
#include <algorithm>
#include <array>
#include <string>

#include "frontend/network/lower/functions.h"

namespace rung::frontend::network {
namespace {

using ir::Type;
using ir::ValueId;

// Number of entries of a table that fit before the area's end (P35).
uint32_t entriesFrom(const Lowering& f, const Address& table) { return f.room(table) / f.function.length; }

// Window of consecutive entries of `length` bytes; its index counts bytes.
ir::Window tableWindow(Lowering& f, const Address& table) {
  const uint32_t entries = entriesFrom(f, table);
  return f.window(table, entries * f.function.length, (entries - 1) * f.function.length + 1);
}

ValueId byteIndex(Lowering& f, ValueId entry) { return f.b.mul(entry, f.b.i32(f.function.length)); }

ValueId unsignedWord(Lowering& f, size_t param, Type type) {
  return f.b.zextOrTrunc(type, f.load(f.dataType(), f.param(param).address));
}

// Direction and result of a rotation.
struct Path {
  ValueId reverse; // bit
  ValueId result;
};

Path pathOf(ir::RungBuilder& b, const Rotation& r) {
  const auto wrapped = [&](ValueId x) { return b.remU(x, r.count); };
  const ValueId one = b.constant(Type::I64, 1);
  const ValueId forward = wrapped(b.sub(b.add(r.target, r.count), r.current));
  const ValueId backward = wrapped(b.sub(b.add(r.current, r.count), r.target));
  const ValueId reverse = b.and_(r.shorter, b.ltU(backward, forward)); // P30: a tie goes forward
  const ValueId steps = b.select(reverse, backward, forward);
  const ValueId fewer = b.sub(steps, b.zextOrTrunc(Type::I64, r.before));
  const ValueId number = b.select(b.eq(steps, b.constant(Type::I64, 0)), steps, fewer); // P31
  const ValueId before =
      b.select(reverse, wrapped(b.add(r.target, one)), wrapped(b.sub(b.add(r.target, r.count), one)));
  const ValueId position = b.add(b.select(r.before, before, r.target), r.base);
  return {reverse, b.select(r.asSteps, number, position)};
}

} // namespace

// A count of 0 never satisfies the condition.
ValueId rotate(Lowering& f, const Rotation& r, const std::function<void(ValueId)>& store) {
  ir::RungBuilder& b = f.b;
  const auto turn = [&] {
    const Path path = pathOf(b, r);
    store(path.result);
    return path.reverse;
  };
  return b.choose(b.and_(b.ltU(r.current, r.count), b.ltU(r.target, r.count)), turn, [&] { return f.oldOutput(); });
}

// Conditions CN0, DIR, POS, INC, ACT.
void lowerRotation(Lowering& f) {
  f.latchedOutput(f.act(), {}, [&] {
    ir::RungBuilder& b = f.b;
    const ValueId base = b.zextOrTrunc(Type::I64, f.condition(0));
    const ValueId count = unsignedWord(f, 1, Type::I64);
    const ValueId current = b.sub(unsignedWord(f, 2, Type::I64), base);
    const ValueId target = b.sub(unsignedWord(f, 3, Type::I64), base);
    const Rotation rotation{.count = count,
                            .current = current,
                            .target = target,
                            .base = base,
                            .shorter = f.condition(1),
                            .before = f.condition(2),
                            .asSteps = f.condition(3)};
    return rotate(f, rotation, [&](ValueId result) { f.store(f.param(4).address, b.trunc(f.dataType(), result)); });
  });
}

void lowerCodeTable(Lowering& f) {
  std::string bytes;
  for (int64_t row : f.function.table)
    for (uint32_t i = 0; i < f.function.length; ++i) bytes += static_cast<char>(static_cast<uint64_t>(row) >> (8 * i));
  const auto rows = static_cast<uint32_t>(f.function.table.size());
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    const ValueId index = b.zextOrTrunc(Type::I32, f.load(Type::I8, f.param(2).address));
    const ValueId legal = b.ltU(index, b.i32(rows));
    f.b.when(legal, [&] {
      const ir::Window table = f.constants(bytes, (rows - 1) * f.function.length + 1);
      f.store(f.param(3).address, b.loadAt(f.dataType(), table, byteIndex(f, index)));
    });
    return b.not_(legal);
  });
}

namespace {

// Number of entries compared in one block: a short table does not cost as much as the whole area.
constexpr uint32_t kBlock = 32;

// Whether an entry in the block from `start`, below `limit`, matches; and the index of the first match.
std::array<ValueId, 2> searchBlock(Lowering& f, ValueId start, ValueId limit, ValueId searched) {
  ir::RungBuilder& b = f.b;
  const Address& table = f.param(2).address;
  const ValueId none[] = {b.bit(false), b.i32(0)};
  const auto inside = b.loop(kBlock, none);
  const ValueId entry = b.add(start, inside[0]);
  const ValueId exists = b.ltU(entry, limit);
  const ValueId value = b.loadAt(f.dataType(), tableWindow(f, table), byteIndex(f, b.select(exists, entry, b.i32(0))));
  const ValueId hit = b.and_(b.and_(exists, b.eq(value, searched)), b.not_(inside[1]));
  const ValueId next[] = {b.or_(inside[1], hit), b.select(hit, entry, inside[2])};
  const auto found = b.endLoop(next);
  return {found[0], found[1]};
}

} // namespace

// Finds the first entry that matches. The entry count is given as the operand says: 0 to n for n+1 entries (man.
// l.2022-2026), limited to those that exist (P35).
void lowerSearch(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    const uint32_t exist = entriesFrom(f, f.param(2).address);
    const ValueId entries = unsignedWord(f, 1, Type::I32);
    const ValueId limit = b.select(b.ltU(entries, b.i32(exist)), entries, b.i32(exist));
    const ValueId searched = f.load(f.dataType(), f.param(3).address);
    const ValueId none[] = {b.bit(false), b.i32(0)};
    const auto block = b.loop((exist + kBlock - 1) / kBlock, none);
    const ValueId start = b.mul(block[0], b.i32(kBlock));
    const auto found = b.endLoop(b.choose(
        b.and_(b.ltU(start, limit), b.not_(block[1])), [&] { return searchBlock(f, start, limit, searched); },
        [&] { return std::array{block[1], block[2]}; }));
    f.b.when(found[0], [&] { f.store(f.param(4).address, b.zextOrTrunc(f.dataType(), found[1])); });
    return b.not_(found[0]);
  });
}

// Conditions RW, RST, ACT. Indices below the number of entries are valid (P36), if the entries exist. A format may
// count several entries, which are moved one after the other. What is an input is only read.
void lowerIndexedMove(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    const Address& table = f.param(2).address;
    const uint32_t count = f.function.count;
    const uint32_t entries = entriesFrom(f, table);
    const ValueId index = unsignedWord(f, 4, Type::I32);
    const ValueId exists = b.ltU(index, b.i32(entries < count ? 0 : entries - count + 1));
    const ValueId last = count == 1 ? index : b.add(index, b.i32(count - 1)); // in the area, so it does not wrap
    const ValueId legal = b.and_(b.ltU(last, unsignedWord(f, 1, Type::I32)), exists);
    const ValueId write = f.condition(0);
    const std::optional<bool> writes = f.constantOf(0);
    const auto data = [&](uint32_t i) { return plus(f.param(3).address, i * f.function.length); };
    const auto place = [&](uint32_t i) { return byteIndex(f, i == 0 ? index : b.add(index, b.i32(i))); };
    const auto isInput = [&](size_t i) { return f.language().at(f.param(i).address.area).use == AreaUse::Input; };
    const auto store = [&] {
      for (uint32_t i = 0; i < count; ++i) b.storeAt(tableWindow(f, table), place(i), f.load(f.dataType(), data(i)));
    };
    const auto load = [&] {
      for (uint32_t i = 0; i < count; ++i) f.store(data(i), b.loadAt(f.dataType(), tableWindow(f, table), place(i)));
    };
    if (!isInput(2) && writes != false) b.when(b.and_(legal, write), store);
    if (!isInput(3) && writes != true) b.when(b.and_(legal, b.not_(write)), load);
    return b.not_(legal);
  });
}

} // namespace rung::frontend::network
