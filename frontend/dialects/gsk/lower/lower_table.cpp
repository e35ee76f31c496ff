// Rotation, code conversion and data tables (§7.5, §7.6, §7.11).
#include <algorithm>
#include <array>
#include <string>

#include "frontend/dialects/gsk/lower/lower.h"

namespace rung::frontend::gsk {
namespace {

using ir::Type;
using ir::ValueId;

// Number of entries of a table in D that fit before the area's end (P35).
uint32_t entriesFrom(const network::Address& table, uint32_t length) {
  return (kLanguage.at(table.area).bytes - table.byte) / length;
}

// Window of consecutive entries of `length` bytes; its index counts bytes.
ir::Window tableWindow(Lowering& f, const network::Address& table) {
  const uint32_t entries = entriesFrom(table, f.function.length);
  return f.window(table, entries * f.function.length, (entries - 1) * f.function.length + 1);
}

ValueId byteIndex(Lowering& f, ValueId entry) { return f.b.mul(entry, f.b.i32(f.function.length)); }

ValueId unsignedWord(Lowering& f, size_t param, Type type) {
  return f.b.zextOrTrunc(type, f.load(f.dataType(), f.param(param).address));
}

// Direction and result of a rotation, positions counted from 0 (§7.5).
struct Path {
  ValueId reverse; // bit
  ValueId result;
};

Path pathOf(Lowering& f, ValueId count, ValueId current, ValueId target, ValueId base) {
  ir::RungBuilder& b = f.b;
  const auto wrapped = [&](ValueId x) { return b.remU(x, count); };
  const ValueId one = b.constant(Type::I64, 1);
  const ValueId forward = wrapped(b.sub(b.add(target, count), current));
  const ValueId backward = wrapped(b.sub(b.add(current, count), target));
  const ValueId reverse = b.and_(f.condition(1), b.ltU(backward, forward)); // P30: a tie goes forward
  const ValueId pos = f.condition(2);
  const ValueId steps = b.select(reverse, backward, forward);
  const ValueId fewer = b.sub(steps, b.zextOrTrunc(Type::I64, pos));
  const ValueId number = b.select(b.eq(steps, b.constant(Type::I64, 0)), steps, fewer); // P31
  const ValueId before = b.select(reverse, wrapped(b.add(target, one)), wrapped(b.sub(b.add(target, count), one)));
  const ValueId position = b.add(b.select(pos, before, target), base);
  return {reverse, b.select(f.condition(3), number, position)};
}

} // namespace

// Conditions CN0, DIR, POS, INC, ACT. A position outside the table changes nothing (P31).
void lowerRotation(Lowering& f) {
  f.latchedOutput(f.act(), {}, [&] {
    ir::RungBuilder& b = f.b;
    const ValueId base = b.zextOrTrunc(Type::I64, f.condition(0));
    const ValueId count = unsignedWord(f, 1, Type::I64);
    const ValueId current = b.sub(unsignedWord(f, 2, Type::I64), base);
    const ValueId target = b.sub(unsignedWord(f, 3, Type::I64), base);
    const auto turn = [&] {
      const Path path = pathOf(f, count, current, target, base);
      f.store(f.param(4).address, b.trunc(f.dataType(), path.result));
      return path.reverse;
    };
    // A count of 0 never satisfies the condition.
    return b.choose(b.and_(b.ltU(current, count), b.ltU(target, count)), turn, [&] { return f.oldOutput(); });
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
  const network::Address& table = f.param(2).address;
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
    const uint32_t exist = entriesFrom(f.param(2).address, f.function.length);
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

// Conditions RW, RST, ACT. Indices below the number of entries are valid (P36), if the entries exist.
void lowerIndexedMove(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    const network::Address& table = f.param(2).address;
    const network::Address& data = f.param(3).address;
    const ValueId index = unsignedWord(f, 4, Type::I32);
    const ValueId exists = b.ltU(index, b.i32(entriesFrom(table, f.function.length)));
    const ValueId legal = b.and_(b.ltU(index, unsignedWord(f, 1, Type::I32)), exists);
    const ValueId write = f.condition(0);
    f.b.when(b.and_(legal, write),
             [&] { b.storeAt(tableWindow(f, table), byteIndex(f, index), f.load(f.dataType(), data)); });
    f.b.when(b.and_(legal, b.not_(write)),
             [&] { f.store(data, b.loadAt(f.dataType(), tableWindow(f, table), byteIndex(f, index))); });
    return b.not_(legal);
  });
}

} // namespace rung::frontend::gsk
