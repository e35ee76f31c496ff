// Makes the plan: a list of copies from the tables of two programs (see state_transfer.h).
#include "rtlib/change/state_transfer.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "rtlib/change/forcing.h"
#include "rtlib/change/rung_alignment.h"
#include "rtlib/core/memory.h"
#include "rtlib/load/program_info.h"
#include "rtlib/run/loaded_program.h"
#include "rung/types.hpp"

namespace rung::runtime {
namespace {

constexpr uint32_t kInitial = RUNG_NONE; // a bit starts with its initial contents

// Whether the symbol has a place of its own.
bool hasPlace(const rung_symbol& symbol) { return (symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_AREA)) == 0; }

// Numbers all bits of all spaces of a program consecutively.
class BitNumbers {
public:
  explicit BitNumbers(const rung_program& program) : memory_(program, nullptr) {
    for (uint32_t i = 0; i < program.space_count; ++i) {
      const uint64_t end = count_ + uint64_t{8} * program.spaces[i].byte_count;
      if (end >= kInitial) throw std::length_error("the spaces of a program have 512 MB or more");
      first_.push_back(count_);
      count_ = static_cast<uint32_t>(end);
    }
  }
  uint32_t count() const { return count_; }
  uint32_t first(uint32_t space) const { return first_[space]; }
  uint32_t first(const rung_symbol& symbol) const { return first_[symbol.space] + 8 * symbol.byte + symbol.bit; }
  // The place of a bit in the memory block: its byte, the bit in the byte, and whether it occupies the byte alone.
  struct Location {
    uint32_t offset;
    uint8_t bit;
    bool expanded;
  };
  Location locate(uint32_t number) const {
    const auto space =
        static_cast<uint32_t>(std::upper_bound(first_.begin(), first_.end(), number) - first_.begin()) - 1;
    const uint32_t byte = (number - first_[space]) / 8;
    const auto bit = static_cast<uint8_t>(number % 8);
    const rung_range& range = *memory_.rangeOf(space, byte);
    const uint32_t into = byte - range.first_byte;
    if (range.repr == RUNG_REPR_BYTE_PER_BIT) return {range.offset + 8 * into + bit, 0, true};
    return {range.offset + into, bit, false};
  }

private:
  core::Memory memory_; // for its ranges; it has no block
  std::vector<uint32_t> first_;
  uint32_t count_ = 0;
};

// Bits of the bytes of a program's memory block.
using Marks = std::vector<uint8_t>;

void mark(Marks& marks, uint32_t offset, uint32_t size, uint32_t bits = 255) {
  for (uint32_t i = offset; i < offset + size; ++i) marks[i] = static_cast<uint8_t>(marks[i] | bits);
}

// The bits that chunks may write, and those to which they are copied.
Marks writtenBits(const rung_program& program) {
  Marks written(program.memory_size);
  for (uint32_t i = 0; i < program.write_count; ++i)
    mark(written, program.writes[i].offset, program.writes[i].size, program.writes[i].mask);
  for (uint32_t i = 0; i < program.copy_count; ++i)
    for (uint32_t b = 0; b < program.copies[i].size; ++b)
      mark(written, program.copies[i].to + b, 1, written[program.copies[i].from + b]);
  return written;
}

// Outputs, and the bits that are copied to them.
Marks outputBits(const rung_program& program) {
  Marks outputs(program.memory_size);
  constexpr uint32_t kBoth = RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT;
  for (uint32_t s = 0; s < program.space_count; ++s) {
    const rung_space& space = program.spaces[s];
    for (uint32_t r = 0; (space.flags & kBoth) == RUNG_SPACE_OUTPUT && r < space.range_count; ++r)
      mark(outputs, space.ranges[r].offset,
           space.ranges[r].byte_count * (space.ranges[r].repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1));
  }
  for (uint32_t i = 0; i < program.safe_count; ++i)
    mark(outputs, program.safe_spans[i].offset, program.safe_spans[i].size);
  for (uint32_t i = 0; i < program.copy_count; ++i)
    for (uint32_t b = 0; b < program.copies[i].size; ++b)
      mark(outputs, program.copies[i].from + b, 1, outputs[program.copies[i].to + b]);
  return outputs;
}

} // namespace

class TransferPlanner {
public:
  TransferPlanner(StateTransfer& plan, const rung_program& from, const rung_program& to, const Naming& naming)
      : plan_(plan), from_(from), to_(to), nameOf_(naming.nameOf), oldSymbols_(from, naming), newSymbols_(to, naming),
        old_(from), new_(to), overwritten_(to), source_(new_.count(), kInitial), stays_(new_.count(), false),
        isNamed_(new_.count(), false) {
    for (uint32_t s = 0; s < from.space_count; ++s) sameSpaces_.push_back(findSpace(to, from.spaces[s].name));
  }

  void run() {
    rungs_ = alignRungs(rungMarks(from_), rungMarks(to_));
    matchHidden();
    keepAddresses();
    matchNames();
    findGone();
    vacate();
    for (const Match& match : matches_)
      if (match.former == nullptr) placeNew(*match.symbol);
    for (const Match& match : matches_)
      if (match.former != nullptr) placeFormer(*match.symbol, *match.former);
    releaseOutputs();
    for (const auto& [cell, name] : gone_) plan_.changes_.push_back({ChangeKind::Removed, false, name, {}});
    reportUnretained();
    std::ranges::sort(plan_.changes_, {}, &StateChange::name);
    addMoves();
    addSlots();
    addContinuations();
    plan_.countBytes();
    plan_.rungs_ = changedRungs(rungMarks(from_), rungMarks(to_), rungs_);
  }

private:
  using MoveKind = StateTransfer::MoveKind;

  using Cell = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t, uint32_t>; // space, byte, bit, type, count

  // A name of the new program, and the corresponding name of the old one; null: it is new.
  struct Match {
    const rung_symbol* symbol;
    const rung_symbol* former;
  };

  static uint32_t extent(const rung_symbol& symbol) { return elementBits(symbol.type) * symbol.count; }
  // The number of bits that instructions access by the name, within its space.
  static uint32_t reach(const rung_program& program, const rung_symbol& symbol) {
    if (symbol.type == RUNG_TYPE_BIT) return extent(symbol);
    const uint64_t room = 8 * (uint64_t{program.spaces[symbol.space].byte_count} - symbol.byte);
    return static_cast<uint32_t>(std::min(room, std::max(uint64_t{extent(symbol)}, uint64_t{8} * symbol.reach)));
  }

  bool samePlace(const rung_symbol& former, const rung_symbol& symbol) const {
    return sameSpaces_[former.space] == symbol.space && former.byte == symbol.byte && former.bit == symbol.bit;
  }
  bool sameCell(const rung_symbol& former, const rung_symbol& symbol) const {
    return samePlace(former, symbol) && former.type == symbol.type && former.count == symbol.count;
  }

  void keepAddresses() {
    for (uint32_t s = 0; s < from_.space_count; ++s) {
      const uint32_t space = sameSpaces_[s];
      if (space == RUNG_NONE || isAllocated(from_.spaces[s]) || isAllocated(to_.spaces[space])) continue;
      const uint32_t bits = 8 * std::min(from_.spaces[s].byte_count, to_.spaces[space].byte_count);
      for (uint32_t i = 0; i < bits; ++i) source_[new_.first(space) + i] = old_.first(s) + i;
    }
  }

  void matchNames() {
    for (uint32_t i = 0; i < to_.symbol_count; ++i)
      for (uint32_t b = 0; hasPlace(to_.symbols[i]) && b < extent(to_.symbols[i]); ++b)
        isNamed_[new_.first(to_.symbols[i]) + b] = true;
    for (uint32_t i = 0; i < to_.symbol_count; ++i) {
      const rung_symbol& symbol = to_.symbols[i];
      if (!hasPlace(symbol)) continue;
      const rung_symbol* former = formerOf(symbol);
      if (former != nullptr && !hasPlace(*former)) former = nullptr;
      matches_.push_back({&symbol, former});
      if (former == nullptr || !sameCell(*former, symbol)) continue;
      ++plan_.keptCells_;
      (void)keep(symbol, *former);
      for (uint32_t b = 0; b < extent(symbol); ++b) stays_[new_.first(symbol) + b] = true;
    }
  }

  // State that instructions keep in hidden names follows their rungs, not these names.
  void matchHidden() {
    std::vector<const rung_symbol*> former, now;
    const std::vector<InstructionState> before = hiddenOf(from_, former);
    const std::vector<InstructionState> after = hiddenOf(to_, now);
    const std::vector<uint32_t> matched = matchState(before, after, rungs_);
    for (const rung_symbol* symbol : former) hiddenThere_[symbol] = false;
    for (size_t i = 0; i < now.size(); ++i) {
      const rung_symbol* of = matched[i] == RUNG_NONE ? nullptr : former[matched[i]];
      hiddenFormer_[now[i]] = of;
      if (of == nullptr) continue;
      hiddenThere_[of] = true;
      newKeys_[of->name] = now[i]->name;
    }
  }
  static std::vector<InstructionState> hiddenOf(const rung_program& program, std::vector<const rung_symbol*>& symbols) {
    std::vector<InstructionState> states;
    for (uint32_t i = 0; i < program.symbol_count; ++i) {
      const rung_symbol& symbol = program.symbols[i];
      if ((symbol.flags & RUNG_SYMBOL_HIDDEN) == 0 || !hasPlace(symbol)) continue;
      symbols.push_back(&symbol);
      states.push_back({symbol.name, symbol.rung});
    }
    return states;
  }

  const rung_symbol* formerOf(const rung_symbol& symbol) const {
    const auto hidden = hiddenFormer_.find(&symbol);
    return hidden != hiddenFormer_.end() ? hidden->second : oldSymbols_.find(symbol.name);
  }
  // Whether the new program has the name, too.
  bool isThere(const rung_symbol& former) const {
    if (const auto hidden = hiddenThere_.find(&former); hidden != hiddenThere_.end()) return hidden->second;
    const rung_symbol* symbol = newSymbols_.find(former.name);
    return symbol != nullptr && hasPlace(*symbol);
  }

  // Finds the names that the new program does not have, and their addresses in it if it has the space.
  void findGone() {
    named_.assign(old_.count(), false);
    for (uint32_t i = 0; i < from_.symbol_count; ++i) {
      const rung_symbol& former = from_.symbols[i];
      if (!hasPlace(former)) continue;
      for (uint32_t b = 0; b < extent(former); ++b) named_[old_.first(former) + b] = true;
      if (isThere(former)) continue;
      gone_.emplace(Cell{sameSpaces_[former.space], former.byte, former.bit, former.type, former.count}, former.name);
    }
  }

  // The former places of names that have moved or changed their type start anew.
  void vacate() {
    for (const Match& match : matches_) {
      if (match.former == nullptr || sameCell(*match.former, *match.symbol)) continue;
      const uint32_t space = sameSpaces_[match.former->space];
      if (space == RUNG_NONE || isInput(space, *match.former)) continue;
      const uint32_t begin = 8 * match.former->byte + match.former->bit;
      const uint32_t end = std::min(begin + reach(from_, *match.former), 8 * to_.spaces[space].byte_count);
      for (uint32_t b = begin; b < end; ++b) start(new_.first(space) + b);
    }
  }

  static bool isAllocated(const rung_space& space) { return (space.flags & RUNG_SPACE_ALLOCATED) != 0; }
  // Whether the machine or the NC writes this cell, in this space of the new program. If the program writes the space,
  // too, the inputs are the cells that a task copies over.
  bool isInput(uint32_t space, const rung_symbol& cell) const {
    const uint32_t flags = to_.spaces[space].flags;
    if ((flags & RUNG_SPACE_INPUT) == 0) return false;
    if ((flags & RUNG_SPACE_OUTPUT) == 0) return true;
    Ref ref = refOf(cell);
    ref.space = space;
    return overwritten_.source(ref).has_value();
  }
  bool isInput(const rung_symbol& symbol) const { return isInput(symbol.space, symbol); }

  void start(uint32_t bit) {
    if (!stays_[bit]) source_[bit] = kInitial;
  }
  void start(const rung_symbol& symbol) {
    for (uint32_t b = 0; b < extent(symbol); ++b) start(new_.first(symbol) + b);
  }

  void placeFormer(const rung_symbol& symbol, const rung_symbol& former) {
    if (sameCell(former, symbol) || isInput(symbol)) return;
    start(symbol);
    if (former.type != symbol.type) return report(ChangeKind::Retyped, symbol);
    report(keep(symbol, former) ? ChangeKind::Moved : ChangeKind::Cut, symbol);
  }

  // Moves the contents of a name: of an array as much as fits; of a cell all bytes that instructions of the old program
  // access by its name. Bytes at the place of a name that has stayed belong to that name: if the cell begins there,
  // nothing is moved, else only the bytes outside it. False: some bytes of a cell are lost.
  bool keep(const rung_symbol& symbol, const rung_symbol& former) {
    const bool wide = symbol.count == 1 && former.count == 1 && !isAllocated(to_.spaces[symbol.space]);
    const uint32_t wanted = wide ? reach(from_, former) : extent(former);
    const uint32_t room = wide ? 8 * (to_.spaces[symbol.space].byte_count - symbol.byte) : extent(symbol);
    bool whole = !wide || wanted <= room;
    for (uint32_t b = 0; wide && b < std::min(wanted, extent(symbol)); ++b)
      if (stays_[new_.first(symbol) + b]) return false;
    for (uint32_t b = 0; b < std::min(wanted, room); ++b) {
      const uint32_t to = new_.first(symbol) + b;
      const bool isOwn = b < extent(symbol);
      const bool isFree = isOwn ? !stays_[to] : !isNamed_[to];
      if (isFree) source_[to] = old_.first(former) + b;
      whole = whole && isFree;
    }
    return whole;
  }

  void placeNew(const rung_symbol& symbol) {
    if (isInput(symbol)) return;
    const bool fixed = !isAllocated(to_.spaces[symbol.space]);
    if (const auto former = gone_.find({symbol.space, symbol.byte, symbol.bit, symbol.type, symbol.count});
        fixed && former != gone_.end()) {
      report(ChangeKind::Renamed, symbol, former->second);
      gone_.erase(former);
      return;
    }
    const uint32_t first = new_.first(symbol);
    bool named = false; // other names were here, some of which have moved
    for (uint32_t b = first; b < first + extent(symbol); ++b)
      named = named || (!stays_[b] && (source_[b] == kInitial || named_[source_[b]]));
    if (!named) return; // the cell had no name, or also has another one
    start(symbol);
    report(ChangeKind::New, symbol);
  }

  // ---- outputs -----------------------------------------------------------------------------------------------------

  void releaseOutputs() {
    const Marks written = writtenBits(from_);
    const Marks writes = writtenBits(to_);
    const Marks outputs = outputBits(to_);
    Marks released(to_.memory_size);
    for (uint32_t b = 0; b < new_.count(); ++b) {
      if (source_[b] == kInitial) continue;
      const BitNumbers::Location now = new_.locate(b);
      if (!isMarked(outputs, now) || isMarked(writes, now) || !isMarked(written, old_.locate(source_[b]))) continue;
      source_[b] = kInitial;
      mark(released, now.offset, 1, 1u << now.bit);
    }
    reportNamed(released);
    for (uint32_t space = 0; space < to_.space_count; ++space)
      if (!isHidden(space)) reportUnnamed(space, released);
  }

  static bool isMarked(const Marks& marks, const BitNumbers::Location& place) {
    return (marks[place.offset] >> place.bit & 1) != 0;
  }

  // Removes the bit, and those that are copied to or from it, so that only one is reported. False: it was not marked.
  bool take(uint32_t bit, Marks& released) const {
    const BitNumbers::Location place = new_.locate(bit);
    if (!isMarked(released, place)) return false;
    const auto clear = [&](uint32_t offset) { released[offset] &= static_cast<uint8_t>(~(1u << place.bit)); };
    clear(place.offset);
    forCopiesOf(to_, place.offset, clear);
    return true;
  }

  // Reports each bit by its narrowest name.
  void reportNamed(Marks& released) {
    std::vector<const rung_symbol*> symbols;
    for (const Match& match : matches_)
      if (!isHidden(match.symbol->space)) symbols.push_back(match.symbol);
    std::ranges::stable_sort(symbols, {}, [](const rung_symbol* symbol) { return extent(*symbol); });
    for (const rung_symbol* symbol : symbols) {
      bool any = false;
      for (uint32_t b = 0; b < extent(*symbol); ++b) any = take(new_.first(*symbol) + b, released) || any;
      if (any) report(ChangeKind::Released, *symbol);
    }
  }

  // Reports cells without a name: all bits of an address together, or single bits.
  void reportUnnamed(uint32_t space, Marks& released) {
    const uint32_t unit = to_.spaces[space].unit_bytes;
    for (uint32_t byte = 0; byte + unit <= to_.spaces[space].byte_count; byte += unit) {
      std::vector<uint32_t> bits;
      for (uint32_t b = 0; b < 8 * unit; ++b)
        if (take(new_.first(space) + 8 * byte + b, released)) bits.push_back(b);
      if (bits.size() == size_t{8} * unit)
        report(ChangeKind::Released, nameOf_(to_, intRef(space, byte, 8 * unit)));
      else
        for (const uint32_t b : bits) report(ChangeKind::Released, nameOf_(to_, bitRef(space, byte, b)));
    }
  }
  bool isHidden(uint32_t space) const { return (to_.spaces[space].flags & RUNG_SPACE_HIDDEN) != 0; }
  void report(ChangeKind kind, std::string name) { plan_.changes_.push_back({kind, false, std::move(name), {}}); }

  void report(ChangeKind kind, const rung_symbol& symbol, std::string formerName = {}) {
    plan_.changes_.push_back({kind, false, symbol.name, std::move(formerName)});
  }

  // ---- retained memory ---------------------------------------------------------------------------------------------

  // By byte of all spaces, numbered as bits.
  static std::vector<bool> retainedBytes(const rung_program& program, const BitNumbers& bits) {
    Marks retained(program.memory_size);
    for (uint32_t i = 0; i < program.retain_count; ++i)
      mark(retained, program.retains[i].offset, program.retains[i].size);
    std::vector<bool> bytes(bits.count() / 8);
    for (uint32_t i = 0; i < bytes.size(); ++i) bytes[i] = retained[bits.locate(8 * i).offset] != 0;
    return bytes;
  }

  // Bytes of the compiler's choice are reported by their names alone.
  void reportUnretained() {
    const std::vector<bool> before = retainedBytes(from_, old_), now = retainedBytes(to_, new_);
    std::vector<bool> taken(old_.count());
    for (uint32_t b = 0; b < new_.count(); ++b)
      if (source_[b] != kInitial && now[b / 8]) taken[source_[b]] = true;
    for (uint32_t s = 0; s < from_.space_count; ++s) {
      const uint32_t space = sameSpaces_[s], bytes = from_.spaces[s].byte_count;
      if (isAllocated(from_.spaces[s]) || (from_.spaces[s].flags & RUNG_SPACE_HIDDEN) != 0) continue;
      const auto isLost = [&](uint32_t byte) {
        const uint32_t first = old_.first(s) + 8 * byte;
        const bool isThere =
            space != RUNG_NONE && byte < to_.spaces[space].byte_count && now[new_.first(space) / 8 + byte];
        const auto bits = taken.begin() + first;
        return before[first / 8] && !isThere && std::find(bits, bits + 8, false) != bits + 8;
      };
      for (uint32_t byte = 0; byte < bytes; ++byte) {
        const uint32_t first = byte;
        while (byte < bytes && isLost(byte)) ++byte;
        if (byte != first) reportArea(s, first, byte - 1);
      }
    }
  }
  void reportArea(uint32_t space, uint32_t first, uint32_t last) {
    std::string name = nameOf_(from_, intRef(space, first, 8));
    if (last != first) name += " to " + nameOf_(from_, intRef(space, last, 8));
    report(ChangeKind::Removed, std::move(name));
  }

  // ---- the moves ---------------------------------------------------------------------------------------------------

  // Makes as few moves as possible: adjacent bytes that stay adjacent are one move.
  void addMoves() {
    for (uint32_t number = 0; number < new_.count(); number += 8) {
      if (!addByte(number))
        for (uint32_t b = number; b < number + 8; ++b)
          if (source_[b] != kInitial) addBit(source_[b], b);
    }
  }

  bool addByte(uint32_t number) {
    const uint32_t source = source_[number];
    if (source == kInitial || source % 8 != 0) return false;
    for (uint32_t b = 1; b < 8; ++b)
      if (source_[number + b] != source + b) return false;
    const BitNumbers::Location from = old_.locate(source);
    const BitNumbers::Location to = new_.locate(number);
    if (from.expanded == to.expanded)
      addCopy(from.offset, to.offset, from.expanded ? 8 : 1);
    else
      add({.kind = to.expanded ? MoveKind::Unpack : MoveKind::Pack, .from = from.offset, .to = to.offset, .count = 1});
    return true;
  }

  void addBit(uint32_t source, uint32_t number) {
    const BitNumbers::Location from = old_.locate(source);
    const BitNumbers::Location to = new_.locate(number);
    if (from.expanded && to.expanded) return addCopy(from.offset, to.offset, 1);
    add({MoveKind::Bit, from.bit, to.bit, from.offset, to.offset, 1});
  }

  void addCopy(uint32_t from, uint32_t to, uint32_t bytes) { add({.from = from, .to = to, .count = bytes}); }

  // Adds the move, or extends the last one if it continues that.
  void add(const StateTransfer::Move& move) {
    if (!plan_.moves_.empty() && move.kind != MoveKind::Bit) {
      StateTransfer::Move& last = plan_.moves_.back();
      const uint32_t fromStep = last.count * (last.kind == MoveKind::Pack ? 8 : 1);
      const uint32_t toStep = last.count * (last.kind == MoveKind::Unpack ? 8 : 1);
      if (last.kind == move.kind && last.from + fromStep == move.from && last.to + toStep == move.to) {
        last.count += move.count;
        return;
      }
    }
    plan_.moves_.push_back(move);
  }

  void addSlots() {
    const std::vector<uint32_t> former = matchState(slotsOf(from_), slotsOf(to_), rungs_);
    std::vector<bool> isThere(from_.slot_count, false);
    std::vector<StateTransfer::Move> found;
    for (uint32_t n = 0; n < to_.slot_count; ++n) {
      const rung_slot& slot = to_.slots[n];
      if (former[n] == RUNG_NONE) {
        report(ChangeKind::New, slot);
        continue;
      }
      const rung_slot& before = from_.slots[former[n]];
      isThere[former[n]] = true;
      newKeys_[before.key] = slot.key;
      if (before.type != slot.type) {
        report(ChangeKind::Retyped, slot);
        continue;
      }
      ++plan_.keptSlots_;
      found.push_back({.from = before.offset, .to = slot.offset, .count = slotBytes(slot)});
    }
    for (uint32_t o = 0; o < from_.slot_count; ++o)
      if (!isThere[o]) remove(from_.slots[o]);
    std::ranges::sort(found, {}, &StateTransfer::Move::to);
    for (const StateTransfer::Move& move : found) add(move);
  }

  static std::vector<InstructionState> slotsOf(const rung_program& program) {
    std::vector<InstructionState> states;
    for (uint32_t i = 0; i < program.slot_count; ++i) states.push_back({program.slots[i].key, program.slots[i].rung});
    return states;
  }

  // Each rung as drawn counts once, by its first part.

  void remove(const rung_slot& former) {
    report(ChangeKind::Removed, former);
    const std::string_view key = former.key;
    const size_t shared = key.rfind('@');
    if (shared == std::string_view::npos || shared == 0) return;
    const std::span slots(to_.slots, to_.slot_count);
    const auto held = std::ranges::lower_bound(slots, key.substr(shared), {},
                                               [](const rung_slot& slot) { return std::string_view(slot.key); });
    if (held == slots.end() || key.substr(shared) != held->key) return;
    plan_.holders_.push_back(
        {.slot = former.offset, .slotBytes = slotBytes(former), .held = held->offset, .heldBytes = slotBytes(*held)});
  }

  // The cells of continuations are moved like slots and named cells; then their numbers are replaced.
  void addContinuations() {
    for (uint32_t i = 0; i < from_.continuation_count; ++i) {
      const rung_continuation& former = from_.continuations[i];
      const rung_continuation* end = to_.continuations + to_.continuation_count;
      const auto key = newKeys_.find(former.key);
      const std::string_view wanted = key == newKeys_.end() ? former.key : key->second;
      const rung_continuation* now =
          std::find_if(to_.continuations, end, [&](const rung_continuation& c) { return wanted == c.key; });
      plan_.points_.push_back({.key = former.key,
                               .from = former.offset,
                               .to = now == end ? RUNG_NONE : now->offset,
                               .first = static_cast<uint32_t>(plan_.numbers_.size()),
                               .count = former.point_count});
      for (uint32_t p = 0; p < former.point_count; ++p) {
        plan_.numbers_.push_back(now == end ? RUNG_NONE : numberOf(*now, former.points[p]));
        if (plan_.numbers_.back() == RUNG_NONE && now != end)
          plan_.changes_.push_back({ChangeKind::Removed, true, std::string(former.key) + ": " + former.points[p], {}});
      }
    }
  }

  static uint32_t numberOf(const rung_continuation& c, const char* point) {
    for (uint32_t i = 0; i < c.point_count; ++i)
      if (std::strcmp(c.points[i], point) == 0) return i;
    return RUNG_NONE;
  }

  void report(ChangeKind kind, const rung_slot& slot) { plan_.changes_.push_back({kind, true, slot.key, {}}); }

  StateTransfer& plan_;
  const rung_program& from_;
  const rung_program& to_;
  const PlaceName nameOf_;
  const SymbolsByName oldSymbols_;
  const SymbolsByName newSymbols_;
  BitNumbers old_;
  BitNumbers new_;
  Overwritten overwritten_;          // in the new program
  std::vector<uint32_t> sameSpaces_; // by space of the old program: the new one's space of this name, or RUNG_NONE
  std::vector<uint32_t> source_;     // by bit of the new program: the bit of the old one, or kInitial
  std::vector<bool> stays_;          // by bit of the new program: it has a name that has stayed
  std::vector<bool> isNamed_;        // by bit of the new program: it belongs to a name's cell
  std::vector<bool> named_;          // by bit of the old program: it had a name
  std::vector<Match> matches_;
  std::multimap<Cell, std::string> gone_; // names that the new program does not have, by their cell in it
  std::vector<RungPair> rungs_;
  std::map<const rung_symbol*, const rung_symbol*> hiddenFormer_; // by symbol of the new program; null: it is new
  std::map<const rung_symbol*, bool> hiddenThere_;                // by symbol of the old one: the new one has it
  std::map<std::string_view, std::string_view> newKeys_;          // new keys of instructions' state, by old key
};

StateTransfer::StateTransfer(const rung_program& from, const rung_program& to, const Naming& naming) : from_(&from) {
  TransferPlanner(*this, from, to, naming).run();
}

} // namespace rung::runtime
