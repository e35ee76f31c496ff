// Accesses to the dialect's memory (see memory.h).
#include "frontend/dialects/nct/lower/memory.h"

#include <algorithm>

#include "ir/support/check.h"

namespace rung::frontend::nct {

using ir::Type;
using ir::ValueId;

void WrittenRange::add(uint32_t begin, uint32_t beyond) {
  first = std::min(first, begin);
  end = std::max(end, beyond);
}

ValueId Memory::both(ValueId a, ValueId b) {
  if (!a.valid()) return b;
  return b.valid() ? b_.and_(a, b) : a;
}

ValueId Memory::loadRegister(uint32_t word) {
  return b_.load(Type::I32, {.space = spaces_.m, .byte = word * 4, .bit = 0});
}

// A single unsigned comparison of the distance from the first word checks both ends: the sum wraps, and no wrapped sum
// falls into 0000 to 9999. The window of a write excludes the reserved word, although its address is valid.
void Memory::compute(Place& place, const Address& address, AccessBound bound, uint32_t words) {
  place.fixed = false;
  if (address.indexRegister == kNoRegister) { // only the bit number is computed
    place.window = {.space = place.space, .byte = address.word * 4, .count = 1};
    place.index = b_.i32(0);
    place.wordNo = b_.i32(address.word);
    return;
  }
  uint32_t first = 0;
  uint32_t end = kWords;
  switch (bound) {
  case AccessBound::Read: break;
  case AccessBound::Write: first = kFlagsWord + 1; break;
  case AccessBound::User: first = config_.plcNvram; break;
  }
  if (address.immediate) { // only the NC area has a time-slice copy (l.544)
    first = kFirstNcWord;
    end = config_.plcNvram;
  }
  const ValueId offset = loadRegister(address.indexRegister);
  const uint32_t start = first == kReserved ? kReserved + 1 : first;
  const uint32_t count = end - start - (words - 1);
  place.window = {.space = place.space, .byte = start * 4, .count = count};
  const auto from = [&](uint32_t word) { return b_.add(offset, b_.i32(static_cast<int64_t>(address.word) - word)); };
  place.index = from(start);
  place.wordNo = start == 0 ? place.index : b_.add(place.index, b_.i32(start));
  place.valid =
      start == first ? b_.ltU(place.index, b_.i32(count)) : b_.ltU(from(first), b_.i32(count + start - first));
}

Place Memory::place(const Address& address, AccessBound bound, uint32_t words) {
  Place place;
  place.space = address.immediate ? spaces_.ts : spaces_.m;
  place.word = address.word;
  place.bit = address.bit;
  if (address.isFixed()) return place;
  compute(place, address, bound, words);
  return place;
}

Place Memory::word(const Address& address, AccessBound bound) { return place(address, bound, 1); }

std::optional<ir::Place> Memory::fixedWord(const Address& address) const {
  if (!address.isFixed()) return std::nullopt;
  return ir::Place{.space = address.immediate ? spaces_.ts : spaces_.m, .byte = address.word * 4};
}

Place Memory::bit(const Address& address, AccessBound bound) {
  Place p = place(address, bound, 1);
  if (p.fixed) return p;
  if (address.bitRegister == kNoRegister) {
    p.bitNo = b_.i32(address.bit);
    return p;
  }
  p.bitNo = loadRegister(address.bitRegister);
  p.valid = both(p.valid, b_.ltU(p.bitNo, b_.i32(32)));
  return p;
}

Place Memory::twoWords(const Address& address, AccessBound bound) {
  Place p = place(address, bound, 2);
  if (p.fixed) return p;
  const ValueId odd = b_.zextOrTrunc(Type::Bit, loadRegister(address.indexRegister));
  p.valid = both(p.valid, b_.not_(odd));
  return p;
}

bool Memory::dropped(const Place& place) const {
  return place.space == spaces_.m && (place.fixed || place.window.count == 1) && place.word == kReserved;
}

// Only outputs are copied to the time-slice memory (l.548): the NC owns the inputs, and values written to them are lost
// at the next synchronisation.
bool Memory::masked(const Place& place) const {
  if (place.space != spaces_.m) return false;
  if (!place.fixed && place.window.count != 1) return true; // an index may reach any word
  return place.word >= config_.firstOutput && place.word < config_.plcNvram;
}

// Mask window of a computed place, indexed by word number. Bits of inputs may be set in it, but no code reads them.
ir::Window Memory::maskWindow(const Place& place) {
  if (place.window.count == 1)
    written_.add(place.word, place.word + 1);
  else
    written_.add(config_.firstOutput, config_.plcNvram);
  return {.space = spaces_.written, .byte = 0, .count = config_.plcNvram};
}

ValueId Memory::loadWord(const Place& place) {
  if (place.fixed) return b_.load(Type::I32, {.space = place.space, .byte = place.word * 4, .bit = 0});
  return b_.loadAt(Type::I32, place.window, place.index);
}

void Memory::storeWord(const Place& place, ValueId value) {
  if (dropped(place)) return;
  if (place.fixed)
    b_.store({.space = place.space, .byte = place.word * 4, .bit = 0}, value);
  else
    b_.storeAt(place.window, place.index, value);
  if (!masked(place)) return;
  const ValueId ones = b_.i32(-1);
  if (place.fixed) {
    b_.store({.space = spaces_.written, .byte = place.word * 4, .bit = 0}, ones);
    written_.add(place.word, place.word + 1);
  } else if (place.window.byte < config_.plcNvram * 4) {
    b_.storeAt(maskWindow(place), place.wordNo, ones);
  }
}

ValueId Memory::loadBit(const Place& place) {
  if (place.fixed)
    return b_.load(Type::Bit, {.space = place.space, .byte = place.word * 4 + place.bit / 8, .bit = place.bit % 8});
  return b_.loadBitAt(place.window, place.index, place.bitNo);
}

void Memory::storeBit(const Place& place, ValueId value) {
  if (dropped(place)) return;
  const ir::Place bit{.space = place.space, .byte = place.word * 4 + place.bit / 8, .bit = place.bit % 8};
  if (place.fixed)
    b_.store(bit, value);
  else
    b_.storeBitAt(place.window, place.index, place.bitNo, value);
  if (!masked(place)) return;
  const ValueId one = b_.bit(true);
  if (place.fixed) {
    b_.store({.space = spaces_.written, .byte = bit.byte, .bit = bit.bit}, one);
    written_.add(place.word, place.word + 1);
  } else if (place.window.byte < config_.plcNvram * 4) {
    b_.storeBitAt(maskWindow(place), place.wordNo, place.bitNo, one);
  }
}

// A fixed bit is a load, a logic operation and a store; the mask records a bit only if it was really written. The
// select expresses that the bit is written without being read (ir::RungUse::keeps).
void Memory::forceBit(const Place& place, ValueId cond, bool value) {
  if (dropped(place)) return;
  if (!place.fixed) {
    b_.when(cond, [&] { storeBit(place, b_.bit(value)); });
    return;
  }
  ir::Place bit{.space = place.space, .byte = place.word * 4 + place.bit / 8, .bit = place.bit % 8};
  const ValueId old = b_.load(Type::Bit, bit);
  b_.store(bit, b_.select(value ? cond : b_.not_(cond), value ? b_.bit(true) : old, value ? old : b_.bit(false)));
  if (!masked(place)) return;
  bit.space = spaces_.written;
  b_.store(bit, b_.or_(b_.load(Type::Bit, bit), cond));
  written_.add(place.word, place.word + 1);
}

ValueId Memory::loadDouble(const Place& place, Type type) {
  if (place.fixed) return b_.load(type, {.space = place.space, .byte = place.word * 4, .bit = 0});
  return b_.loadAt(type, place.window, place.index);
}

ValueId Memory::upperWord(ValueId value) {
  const ValueId bits = b_.typeOf(value) == Type::F64 ? b_.fToBits(value) : value;
  return b_.zextOrTrunc(Type::I32, b_.shrU(bits, b_.i32(32)));
}

void Memory::storeDouble(const Place& place, ValueId value) {
  RUNG_CHECK(place.space == spaces_.m, "doubles have no immediate form");
  const Place next{.space = spaces_.m, .word = kReserved + 1};
  if (dropped(place)) return storeWord(next, upperWord(value));
  if (place.fixed) {
    b_.store({.space = place.space, .byte = place.word * 4, .bit = 0}, value);
    for (uint32_t word = place.word; word < place.word + 2; ++word) {
      if (word < config_.firstOutput || word >= config_.plcNvram) continue;
      b_.store({.space = spaces_.written, .byte = word * 4, .bit = 0}, b_.i32(-1));
      written_.add(word, word + 1);
    }
    return;
  }
  b_.storeAt(place.window, place.index, value);
  if (place.window.byte == next.word * 4) { // a double that begins at the reserved word: only its upper half is stored
    b_.when(b_.eq(place.index, b_.i32(-1)), [&] { storeWord(next, upperWord(value)); });
  }
  if (place.window.byte >= config_.plcNvram * 4) return;
  const ir::Window mask = maskWindow(place);
  b_.storeAt(mask, place.wordNo, b_.i32(-1));
  b_.storeAt(mask, b_.add(place.wordNo, b_.i32(1)), b_.i32(-1));
}

ValueId Memory::integer(const Operand& operand, ValueId& valid) {
  if (operand.form == Form::Constant) return b_.i32(operand.constant.integer);
  const Place p = word(operand.address, AccessBound::Read);
  valid = both(valid, p.valid);
  return loadWord(p);
}

ValueId Memory::real(const Operand& operand, ValueId& valid) {
  if (operand.form == Form::Constant) return b_.real(operand.constant.real);
  const Place p = twoWords(operand.address, AccessBound::Read);
  valid = both(valid, p.valid);
  return loadDouble(p, Type::F64);
}

// With two fixed ends in order the window is exactly the range; otherwise it is the whole memory.
WordRange Memory::range(const Place& first, const Place& last) {
  WordRange range;
  const auto number = [&](const Place& p) { return p.fixed ? b_.i32(p.word) : p.wordNo; };
  if (first.fixed && last.fixed && first.word <= last.word) {
    range.mostWords = last.word - first.word + 1;
    range.window = {.space = spaces_.m, .byte = first.word * 4, .count = range.mostWords};
    range.length = b_.i32(range.mostWords);
    return range;
  }
  range.mostWords = first.fixed && last.fixed ? 0 : kWords;
  range.window = {.space = spaces_.m, .byte = 0, .count = kWords};
  range.first = number(first);
  range.length = b_.add(b_.sub(number(last), range.first), b_.i32(1));
  return range;
}

ValueId Memory::loadIn(const WordRange& range, ValueId i) {
  return b_.loadAt(Type::I32, range.window, range.first.valid() ? b_.add(range.first, i) : i);
}

// The mask's window begins with that of the range and ends with the NC area.
void Memory::storeIn(const WordRange& range, ValueId i, ValueId value) {
  ValueId index = range.first.valid() ? b_.add(range.first, i) : i;
  uint32_t begin = range.window.byte / 4;
  const uint32_t end = begin + range.window.count;
  if (begin <= kReserved) { // excludes FLAGS and the reserved word
    index = b_.sub(index, b_.i32(kReserved + 1 - begin));
    begin = kReserved + 1;
  }
  if (end <= begin) return;
  b_.storeAt({.space = range.window.space, .byte = begin * 4, .count = end - begin}, index, value);
  if (begin >= config_.plcNvram) return;
  const uint32_t count = std::min(end, config_.plcNvram) - begin;
  b_.storeAt({.space = spaces_.written, .byte = begin * 4, .count = count}, index, b_.i32(-1));
  if (begin + count > config_.firstOutput) written_.add(std::max(begin, config_.firstOutput), begin + count);
}

ValueId Memory::loadScratch(ValueId index) {
  return b_.loadAt(Type::I32, {.space = spaces_.scratch, .byte = 0, .count = kWords}, index);
}

void Memory::storeScratch(ValueId index, ValueId value) {
  b_.storeAt({.space = spaces_.scratch, .byte = 0, .count = kWords}, index, value);
}

ir::Place Memory::placeOf(Flag flag) const { return {.space = spaces_.m, .byte = kFlagsWord * 4, .bit = flag}; }

void Memory::setFlag(Flag flag, ValueId value) { b_.store(placeOf(flag), value.valid() ? value : b_.bit(false)); }

void Memory::raiseErrorFlag(ValueId cond) {
  b_.store(placeOf(kFlagEr), b_.select(cond, b_.bit(true), b_.load(Type::Bit, placeOf(kFlagEr))));
}

ValueId Memory::bitAddress(const Place& place) {
  const ValueId word = b_.mul(place.wordNo, b_.i32(32));
  return place.bitNo.valid() ? b_.add(word, place.bitNo) : word;
}

} // namespace rung::frontend::nct
