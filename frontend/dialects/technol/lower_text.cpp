// Memory and texts (man. ch. 3.15, 3.18): loops over bytes whose bounds are known when the program is compiled.
#include <algorithm>
#include <cstdio>

#include "frontend/dialects/technol/lower.h"
#include "frontend/dialects/technol/lowering.h"
#include "ir/support/hash.h"

namespace rung::frontend::technol {

using ir::OpCode;
using ir::Type;
using ir::ValueId;

namespace {

constexpr uint32_t kChunk = 8;
// A rung makes a limited number of passes; long ones get a rung of their own.
constexpr uint32_t kManyPasses = 4096;
constexpr uint32_t kLongestText = 0xFFFF;

// Bytes of a space from `at` on; where `fixed`, that is the constant `first`.
struct Area {
  ir::SpaceId space;
  uint32_t bytes = 0; // of the whole space
  bool fixed = true;
  uint32_t first = 0;
  ValueId at;
};

ValueId least(ir::RungBuilder& b, ValueId x, ValueId y) { return b.select(b.ltU(x, y), x, y); }

Area fixedArea(Lowering& l, ir::SpaceId space, uint32_t bytes, uint32_t first) {
  return {.space = space, .bytes = bytes, .fixed = true, .first = first, .at = l.b().i32(first)};
}

Area areaOf(Lowering& l, const Operand& operand) {
  const Access access = l.reach(operand);
  const uint32_t bytes = l.bytesOf(operand.place.space);
  if (!access.indexed) return fixedArea(l, access.place.space, bytes, access.place.byte);
  return {.space = operand.place.space, .bytes = bytes, .fixed = false, .first = 0, .at = access.index};
}

ValueId loadByte(Lowering& l, const Area& area, ValueId i, Type type = Type::I8) {
  const ir::Window window{.space = area.space, .byte = 0, .count = area.bytes - ir::byteWidth(type) + 1};
  return l.b().loadAt(type, window, l.b().add(area.at, i));
}

void storeByte(Lowering& l, const Area& area, ValueId i, ValueId value) {
  const uint32_t width = ir::byteWidth(l.b().typeOf(value));
  const ir::Window window{.space = area.space, .byte = 0, .count = area.bytes - width + 1};
  l.b().storeAt(window, l.b().add(area.at, i), value);
}

Area shifted(Lowering& l, Area area, ValueId by) {
  area.at = l.b().add(area.at, by);
  area.fixed = false;
  return area;
}

// A text, or the characters between apostrophes. `room`: characters it holds from the address on, at most `most`.
struct Text {
  Area area;
  uint32_t most = 0;
  ValueId room;
  bool literal = false;
};

// A number of bytes: a constant, or a cell with at most `most`.
struct Length {
  bool fixed = true;
  uint32_t most = 0;
  ValueId value;
};

Length fixedCount(Lowering& l, uint32_t count) { return {.fixed = true, .most = count, .value = l.b().i32(count)}; }

Length countOf(Lowering& l, const Operand& operand) {
  if (operand.isConstant()) return fixedCount(l, static_cast<uint32_t>(operand.value));
  const uint32_t most = operand.type == Type::I8 ? 0xFF : 0xFFFF;
  return {.fixed = false, .most = most, .value = l.b().zextOrTrunc(Type::I32, l.value(operand))};
}

Length smaller(Lowering& l, const Length& a, const Length& b) {
  if (a.fixed && b.fixed) return a.most < b.most ? a : b;
  return {.fixed = false, .most = std::min(a.most, b.most), .value = least(l.b(), a.value, b.value)};
}

Length roomOf(const Text& text) { return {.fixed = text.area.fixed, .most = text.most, .value = text.room}; }

// A text whose address lies behind its end is the program's mistake; with BX it shows when the program runs.
bool textOf(Lowering& l, const Operand& operand, Text& text) {
  ir::RungBuilder& b = l.b();
  if (operand.form == Operand::Form::Text) {
    text.literal = true;
    text.most = static_cast<uint32_t>(operand.text.size());
    text.room = b.i32(text.most);
    text.area = text.most == 0 ? Area{.space = {}, .bytes = 0, .fixed = true, .first = 0, .at = b.i32(0)}
                               : fixedArea(l, l.constantBytes(operand.text), text.most, 0);
    return true;
  }
  if (operand.size > kLongestText + 1) {
    l.program().diagnostics.report(Diag::TooLarge, operand.range) << "characters in a text" << kLongestText;
    return false;
  }
  if (operand.size == 0) {
    l.program().diagnostics.report(Diag::AddressOutOfRange, operand.range)
        << OperandParser::spell(operand) << "the text";
    return false;
  }
  text.area = areaOf(l, operand);
  text.most = operand.size - 1;
  text.room = b.i32(text.most);
  if (!operand.indexed) return true;
  const ValueId last = b.i32(operand.value + text.most);
  l.protect(b.ltU(last, text.area.at));
  text.room = b.sub(last, text.area.at);
  return true;
}

// Characters in front of the terminator; a text without one has as many as it holds.
Length lengthOf(Lowering& l, const Text& text) {
  ir::RungBuilder& b = l.b();
  if (text.literal || text.most == 0) return fixedCount(l, text.most);
  const ValueId none[] = {b.i32(0), b.bit(true)};
  const auto pass = b.loop(text.most, none);
  const ValueId inside = b.and_(pass[2], b.ltU(pass[0], text.room));
  const ValueId at = b.select(inside, pass[0], b.i32(0));
  const ValueId goes = b.and_(inside, b.ne(loadByte(l, text.area, at), b.constant(Type::I8, 0)));
  const ValueId next[] = {b.select(goes, b.add(pass[0], b.i32(1)), pass[1]), goes};
  return {.fixed = false, .most = text.most, .value = b.endLoop(next)[0]};
}

// One pass copies or clears `type` at i * its width + `offset`, from the last one on if `backward`.
void copyPasses(Lowering& l, const Area& to, const Area& from, uint32_t passes, Type type, uint32_t offset,
                bool backward) {
  if (passes == 0) return;
  ir::RungBuilder& b = l.b();
  ValueId i = b.loop(passes)[0];
  if (backward) i = b.sub(b.i32(passes - 1), i);
  i = b.add(b.mul(i, b.i32(ir::byteWidth(type))), b.i32(offset));
  storeByte(l, to, i, loadByte(l, from, i, type));
  b.endLoop();
}

void clearPasses(Lowering& l, const Area& area, uint32_t passes, Type type, uint32_t offset) {
  if (passes == 0) return;
  ir::RungBuilder& b = l.b();
  const ValueId i = b.loop(passes)[0];
  storeByte(l, area, b.add(b.mul(i, b.i32(ir::byteWidth(type))), b.i32(offset)), b.constant(type, 0));
  b.endLoop();
}

// Areas and count are constants: eight bytes a pass.
void copyFixed(Lowering& l, const Area& to, const Area& from, uint32_t count) {
  const bool backward = to.space == from.space && to.first > from.first;
  const uint32_t chunks = count / kChunk, rest = count % kChunk;
  if (!backward) copyPasses(l, to, from, chunks, Type::I64, 0, false);
  copyPasses(l, to, from, rest, Type::I8, chunks * kChunk, backward);
  if (backward) copyPasses(l, to, from, chunks, Type::I64, 0, true);
}

// Copies as if all of the source were read first. The caller has checked both areas.
void copy(Lowering& l, const Area& to, const Area& from, const Length& count) {
  if (count.most == 0) return;
  if (count.fixed && to.fixed && from.fixed) return copyFixed(l, to, from, count.most);
  ir::RungBuilder& b = l.b();
  const ValueId backward = to.space == from.space ? b.ltU(from.at, to.at) : b.bit(false);
  const ValueId last = b.sub(count.value, b.i32(1));
  const ValueId pass = b.loop(count.most)[0];
  b.if_(b.ltU(pass, count.value));
  const ValueId i = b.select(backward, b.sub(last, pass), pass);
  storeByte(l, to, i, loadByte(l, from, i));
  b.endIf();
  b.endLoop();
}

void clear(Lowering& l, const Area& area, const Length& count) {
  if (count.most == 0) return;
  if (count.fixed) {
    clearPasses(l, area, count.most / kChunk, Type::I64, 0);
    clearPasses(l, area, count.most % kChunk, Type::I8, count.most / kChunk * kChunk);
    return;
  }
  ir::RungBuilder& b = l.b();
  const ValueId pass = b.loop(count.most)[0];
  b.if_(b.ltU(pass, count.value));
  storeByte(l, area, pass, b.constant(Type::I8, 0));
  b.endIf();
  b.endLoop();
}

// The bytes of `count` that lie in the space. Where area and count are constants the rest is reported: an error where
// it would be written; read, it is 0 (an example of the manual reads behind its variable, l.13543). Else it is checked
// when the program runs.
Length inside(Lowering& l, const Operand& operand, const Area& area, const Length& count, bool written) {
  if (area.fixed && count.fixed) {
    const uint32_t exist = area.bytes - area.first;
    if (count.most <= exist) return count;
    l.program()
            .diagnostics.report(Diag::AddressOutOfRange, operand.range)
            .severity(written ? Severity::Error : Severity::Warning)
        << OperandParser::spell(operand) + "+" + std::to_string(count.most - 1)
        << (area.space == kInterfaceSpace ? "the interface" : "the program's data");
    return fixedCount(l, exist);
  }
  ir::RungBuilder& b = l.b();
  l.protect(b.ltU(b.i32(area.bytes), b.add(area.at, count.value)));
  return count;
}

// Long texts have a rung of their own.
void inOwnRung(Lowering& l, std::span<const Operand> o, auto body) {
  bool isLong = false;
  for (const Operand& operand : o) {
    const bool isText = operand.form == Operand::Form::Cell && operand.type == Type::None;
    isLong = isLong || (isText && operand.size > kManyPasses);
  }
  if (isLong) l.out().cut();
  body();
  if (isLong) l.out().cut();
}

void storeTerminator(Lowering& l, const Area& area, ValueId at, ValueId cond) {
  l.b().if_(cond);
  storeByte(l, area, at, l.b().constant(Type::I8, 0));
  l.b().endIf();
}

// Two areas compared byte by byte; behind `room` of a side its bytes count as 0. A common 0 ends texts.
void compare(Lowering& l, const Area& left, ValueId leftRoom, const Area& right, ValueId rightRoom, const Length& count,
             bool texts) {
  ir::RungBuilder& b = l.b();
  if (count.most == 0) return l.r().setRlo(b.bit(true));
  const ValueId zero = b.constant(Type::I8, 0);
  const ValueId begin[] = {b.bit(true), b.bit(true)}; // equal so far, not ended
  const auto pass = b.loop(count.most, begin);
  const auto byteOf = [&](const Area& area, ValueId room) {
    if (area.bytes == 0) return zero;
    const ValueId inside = b.ltU(pass[0], room);
    return b.select(inside, loadByte(l, area, b.select(inside, pass[0], b.i32(0))), zero);
  };
  const ValueId x = byteOf(left, leftRoom), y = byteOf(right, rightRoom);
  const ValueId counts = b.and_(pass[2], b.ltU(pass[0], count.value));
  const ValueId equal = b.and_(pass[1], b.or_(b.not_(counts), b.eq(x, y)));
  const ValueId next[] = {equal, texts ? b.and_(counts, b.ne(x, zero)) : counts};
  l.r().setRlo(b.endLoop(next)[0]);
}

// Copies what is there and clears what is not.
void copyInside(Lowering& l, const Operand& source, const Area& to, const Area& from, const Length& count) {
  const Length exist = inside(l, source, from, count, false);
  copy(l, to, from, exist);
  if (exist.most < count.most) clear(l, shifted(l, to, exist.value), fixedCount(l, count.most - exist.most));
}

} // namespace

// The source comes first (man. l.1484, l.13540; one example has it the other way round).
void lowerMoveMemory(Lowering& l, std::span<const Operand> o, int) {
  const bool isLong = !o[2].isConstant() || o[2].value > kManyPasses;
  if (isLong) l.out().cut();
  const Length count = countOf(l, o[2]);
  const Area from = areaOf(l, o[0]), to = areaOf(l, o[1]);
  const Length written = inside(l, o[1], to, count, true);
  copyInside(l, o[0], to, from, written);
  if (isLong) l.out().cut();
}

// From the first address up to the second, which is not cleared.
void lowerClear(Lowering& l, std::span<const Operand> o, int) {
  const bool keywords[] = {o[0].form == Operand::Form::Keyword, o[1].form == Operand::Form::Keyword};
  if (keywords[0] && keywords[1]) return l.clearAll(o[0].value == 0);
  const auto wrong = [&](const Operand& operand, std::string_view is, std::string_view wanted) {
    l.program().diagnostics.report(Diag::WrongOperandKind, operand.range)
        << OperandParser::spell(operand) << is << wanted;
  };
  if (keywords[0]) return wrong(o[1], "an address", "ALL");
  if (keywords[1]) return wrong(o[1], "a keyword", "an address");
  if (o[0].place.space != o[1].place.space) return wrong(o[1], "in another memory", "an address behind the first");
  l.out().cut();
  const Area begin = areaOf(l, o[0]), end = areaOf(l, o[1]);
  ir::RungBuilder& b = l.b();
  if (begin.fixed && end.fixed) {
    if (end.first < begin.first) return wrong(o[1], "in front of the first", "an address behind the first");
    clear(l, begin, fixedCount(l, end.first - begin.first));
  } else {
    l.protect(b.ltU(end.at, begin.at));
    clear(l, begin, {.fixed = false, .most = std::min(begin.bytes, 0x10000u), .value = b.sub(end.at, begin.at)});
  }
  l.out().cut();
}

// Ends with the terminator, which is copied too, where the target is full, or behind `num` characters (man.
// l.1720-1744). A source without a terminator has as many characters as it holds.
void lowerCopyText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, o, [&] {
    Text to, from;
    if (!textOf(l, o[0], to) || !textOf(l, o[1], from)) return;
    ir::RungBuilder& b = l.b();
    const Length length = lengthOf(l, from);
    Length copied = smaller(l, length, roomOf(to));
    ValueId ends = b.leU(length.value, to.room);
    if (o[2].given()) {
      const Length limit = countOf(l, o[2]);
      ends = b.and_(ends, b.ltU(length.value, limit.value));
      copied = smaller(l, copied, limit);
    }
    copy(l, to.area, from.area, copied);
    storeTerminator(l, to.area, length.value, ends);
  });
}

// The joined text is cut where the target is full (man. l.1746).
void lowerAddText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, o, [&] {
    Text to, from;
    if (!textOf(l, o[0], to) || !textOf(l, o[1], from)) return;
    ir::RungBuilder& b = l.b();
    const Length used = lengthOf(l, to), length = lengthOf(l, from);
    const Length room{.fixed = false, .most = to.most, .value = b.sub(to.room, used.value)};
    const Length added = smaller(l, length, room);
    copy(l, shifted(l, to.area, used.value), from.area, added);
    storeTerminator(l, to.area, b.add(used.value, added.value), b.ne(added.value, b.i32(0)));
  });
}

// As many digits as the text has characters, the last ones of the number (man. l.1826).
void lowerNumberToText(Lowering& l, std::span<const Operand> o, int bcd) {
  constexpr uint32_t kMostDigits = 10;
  Text text;
  if (!textOf(l, o[0], text)) return;
  if (o[0].indexed || text.most < 1 || text.most > kMostDigits) {
    l.program().diagnostics.report(Diag::OperandRange, o[0].range)
        << (o[0].indexed ? std::string("+BX") : std::to_string(text.most) + " characters") << "1 to 10 characters";
    return;
  }
  ir::RungBuilder& b = l.b();
  ValueId rest = b.zextOrTrunc(Type::I64, l.r().dr(o[1].given() ? Type::I32 : Type::I16));
  const ValueId base = b.constant(Type::I64, bcd ? 16 : 10);
  for (uint32_t i = text.most; i-- > 0;) {
    const ValueId digit = b.zextOrTrunc(Type::I8, b.binary(OpCode::RemU, rest, base));
    b.store({.space = text.area.space, .byte = text.area.first + i}, b.add(digit, b.constant(Type::I8, '0')));
    rest = b.binary(OpCode::DivU, rest, base);
  }
  b.store({.space = text.area.space, .byte = text.area.first + text.most}, b.constant(Type::I8, 0));
}

// Up to a difference, a common terminator or `num` characters; the second text with its terminator (man. l.1860-1870).
void lowerCompareText(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, o, [&] {
    Text left, right;
    if (!textOf(l, o[0], left) || !textOf(l, o[1], right)) return;
    const Length whole = fixedCount(l, right.most + 1);
    const Length count = o[2].given() ? smaller(l, whole, countOf(l, o[2])) : whole;
    compare(l, left.area, left.room, right.area, right.room, count, true);
  });
}

// Terminators are bytes as any other; without `num` until the target is full (man. l.1911-1925).
void lowerCopyBytes(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, o, [&] {
    Text to, from;
    if (!textOf(l, o[0], to) || !textOf(l, o[1], from)) return;
    const Length count = o[2].given() ? smaller(l, roomOf(to), countOf(l, o[2])) : roomOf(to);
    copyInside(l, o[1], to.area, from.area, count);
  });
}

// Without `num` as many bytes as the second text holds (man. l.1943-1953).
void lowerCompareBytes(Lowering& l, std::span<const Operand> o, int) {
  inOwnRung(l, o, [&] {
    Text left, right;
    if (!textOf(l, o[0], left) || !textOf(l, o[1], right)) return;
    const Length count = o[2].given() ? countOf(l, o[2]) : roomOf(right);
    const Length there = inside(l, o[0], left.area, count, false), here = inside(l, o[1], right.area, count, false);
    compare(l, left.area, there.value, right.area, here.value, count, false);
  });
}

// ---- CLEAR GLOBAL, CLEAR INTERNAL
// ------------------------------------------------------------------------------------

void Lowering::clearAll(bool global) {
  ir::RoutineId& routine = clears_[global ? 0 : 1];
  if (!routine.valid()) routine = newRoutine(global ? "@CLEAR GLOBAL" : "@CLEAR INTERNAL");
  out_->call(routine);
}

namespace {

// Which bytes of the program's data are declared in DATA_LOCAL.
std::vector<bool> localBytes(const Program& program) {
  std::vector<bool> local(program.dataBytes);
  for (const Symbol& symbol : program.symbols.all()) {
    if (!symbol.local || !symbol.space.valid() || symbol.space != kDataSpace) continue;
    if (symbol.kind != SymbolKind::Cell && symbol.kind != SymbolKind::Bit) continue;
    const uint32_t size = std::max(1u, symbol.size);
    for (uint32_t i = 0; i < size && symbol.byte + i < local.size(); ++i) local[symbol.byte + i] = true;
  }
  return local;
}

} // namespace

void Lowering::clearData(bool local) {
  const std::vector<bool> isLocal = localBytes(program_);
  for (uint32_t first = 0; first < isLocal.size();) {
    uint32_t end = first;
    while (end < isLocal.size() && isLocal[end] == isLocal[first] && end - first < (1u << 20)) ++end;
    if (isLocal[first] == local) {
      clear(*this, fixedArea(*this, kDataSpace, program_.dataBytes, first), fixedCount(*this, end - first));
      out_->cut();
    }
    first = end;
  }
}

// Texts get the contents again that they have when the machine is switched on (man. l.1533-1536).
void Lowering::fillTexts() {
  for (const ir::Init& init : program_.inits) {
    if (init.space != kDataSpace) continue;
    const std::string_view text(reinterpret_cast<const char*>(init.data.data()), init.data.size());
    const auto size = static_cast<uint32_t>(text.size());
    copy(*this, fixedArea(*this, kDataSpace, program_.dataBytes, init.byte),
         fixedArea(*this, constantBytes(text), size, 0), fixedCount(*this, size));
    out_->cut();
  }
}

void Lowering::clearSlots(std::span<const ir::SlotId> slots) {
  constexpr size_t kStoresPerRung = 64;
  for (size_t i = 0; i < slots.size(); ++i) {
    if (i % kStoresPerRung == 0) out_->cut();
    b().slotStore(slots[i], b().constant(module_.at(slots[i]).type, 0));
  }
}

// GLOBAL: the data of all files, mechanisms and timers. INTERNAL: the data of DATA_LOCAL and the cells that
// instructions made for themselves (man. l.1533-1539).
void Lowering::makeClears() {
  for (const bool global : {true, false}) {
    if (!clears_[global ? 0 : 1].valid()) continue;
    out_ = newBuilder(clears_[global ? 0 : 1]);
    clearData(!global);
    if (global) {
      fillTexts();
      for (uint32_t i = 0; i < program_.mechanisms.size(); ++i) {
        initMechanism(i);
        if (i % 16 == 15) out_->cut();
      }
    }
    clearSlots(global ? timers_ : automatic_);
    out_->finish();
  }
}

// A hidden space of its own, named by its contents, so that a program that is exchanged while it runs finds its own.
ir::SpaceId Lowering::constantBytes(std::string_view bytes) {
  char number[17];
  std::snprintf(number, sizeof number, "%016llx", static_cast<unsigned long long>(hashBytes(bytes)));
  const std::string name = "@T" + std::string(number) + "." + std::to_string(bytes.size());
  const auto [at, isNew] = constants_.emplace(name, ir::SpaceId{static_cast<uint32_t>(module_.spaces.size())});
  if (isNew) {
    module_.spaces.push_back(
        {.name = name, .unitBytes = 1, .units = static_cast<uint32_t>(bytes.size()), .flags = RUNG_SPACE_HIDDEN});
    module_.inits.push_back({.space = at->second, .byte = 0, .data = {bytes.begin(), bytes.end()}});
  }
  return at->second;
}

} // namespace rung::frontend::technol
