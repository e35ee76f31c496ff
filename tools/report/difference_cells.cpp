// Names, bits and line numbers of cells.
#include "tools/report/difference_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ir/core/memory_use.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/hash.h"
#include "ir/support/put.h"
#include "rtlib/load/ref.h"
#include "rtlib/text/letters.h"
#include "rung/types.hpp"

namespace rung::report {

namespace {

using namespace ir;

bool isBit(const Symbol& symbol) { return symbol.type == RUNG_TYPE_BIT; }
uint32_t bytesOf(const Symbol& symbol) { return elementBits(symbol.type) / 8 * symbol.count; } // not of bits
uint64_t positionOf(const Symbol& symbol) { return uint64_t{symbol.byte} * 8 + symbol.bit; }

bool isOwn(const Module& module, SpaceId id) {
  if (!id.valid()) return false;
  const uint32_t flags = module.at(id).flags;
  return (flags & RUNG_SPACE_ALLOCATED) != 0 && (flags & RUNG_SPACE_HIDDEN) == 0;
}

// Cells whose places the compiler assigns, by place: a cell that contains others precedes them.
std::vector<const Symbol*> cellsOf(const Version& version) {
  std::vector<const Symbol*> cells;
  for (const Symbol& symbol : version.module.symbols)
    if (isOwn(version.module, symbol.space) && !version.controlNames.contains(text::upper(symbol.name)))
      cells.push_back(&symbol);
  const auto key = [](const Symbol* s) { return std::tuple(s->space.index, positionOf(*s), isBit(*s)); };
  std::ranges::stable_sort(cells, [&](const Symbol* a, const Symbol* b) { return key(a) < key(b); });
  return cells;
}

// ---- names ---------------------------------------------------------------------------------------------------------

// The common properties of cells under two names.
struct Form {
  std::string space;
  std::string previous; // the preceding cell that both versions have under the same name
  uint32_t type = 0;
  uint32_t count = 0;
  uint32_t bit = 0;
  bool hidden = false;
  auto operator<=>(const Form&) const = default;
};

// The use of a cell by rungs, apart from all names: operations and their rungs, sorted.
using Roles = std::vector<uint64_t>;

struct NamedCell {
  std::string name;
  Form form; // without `previous`
  Roles roles;
};

// Hash of the operations of a rung without places and numbers, which depend on the rest of the program.
uint64_t shapeOf(const Rung& rung) {
  std::string shape;
  for (const Op& op : rung.ops) {
    put(shape, "{} {}", static_cast<int>(op.code), static_cast<int>(op.type));
    for (int i = 0; i < op.argCount; ++i) put(shape, " {}", arg(rung, op, i).index);
  }
  return hashBytes(shape);
}

class RoleFinder {
public:
  explicit RoleFinder(const Module& module) {
    for (const Routine& routine : module.routines)
      for (const Rung& rung : routine.rungs)
        if (rung.number != 0) add(module, rung);
  }
  Roles ofPlace(SpaceId space, uint64_t bit) const { return sorted(places_, std::pair(space.index, bit)); }
  Roles ofSlot(SlotId slot) const { return sorted(slots_, slot.index); }

private:
  void add(const Module& module, const Rung& rung) {
    const uint64_t shape = shapeOf(rung);
    for (size_t i = 0; i < rung.ops.size(); ++i) {
      const Op& op = rung.ops[i];
      const uint64_t role = shape + i;
      if (opInfo(op.code).attr == Attr::Slot) slots_[op.ref].push_back(role);
      if (const std::optional<Use> use = useOf(module, op); use && !use->computed)
        places_[{use->place.space.index, use->place.first}].push_back(role);
    }
  }
  static Roles sorted(const auto& roles, const auto& key) {
    const auto at = roles.find(key);
    Roles found = at == roles.end() ? Roles() : at->second;
    std::ranges::sort(found);
    return found;
  }

  std::map<std::pair<uint32_t, uint64_t>, Roles> places_; // by space and first bit
  std::map<uint32_t, Roles> slots_;
};

// Cells, and the states by which mechanisms continue, which have names of cells.
std::vector<NamedCell> namedCellsOf(const Version& version) {
  const Module& module = version.module;
  const RoleFinder roles(module);
  std::vector<NamedCell> cells;
  for (const Symbol* cell : cellsOf(version))
    cells.push_back({cell->name,
                     {.space = module.at(cell->space).name,
                      .type = cell->type,
                      .count = cell->count,
                      .bit = cell->bit,
                      .hidden = (cell->flags & RUNG_SYMBOL_HIDDEN) != 0},
                     roles.ofPlace(cell->space, positionOf(*cell))});
  for (const Continuation& continuation : module.continuations)
    if (continuation.slot.valid())
      cells.push_back(
          {module.slots[continuation.slot.index].key, {.space = "continuations"}, roles.ofSlot(continuation.slot)});
  return cells;
}

using Names = std::unordered_set<std::string>;

Names namesOf(const std::vector<NamedCell>& cells) {
  Names names;
  for (const NamedCell& cell : cells) names.insert(cell.name);
  return names;
}

// The cells whose names the other version does not have, in their order.
std::map<Form, std::vector<const NamedCell*>> othersOf(const std::vector<NamedCell>& cells, const Names& there) {
  std::map<Form, std::vector<const NamedCell*>> others;
  Form previous;
  for (const NamedCell& cell : cells) {
    if (cell.form.space != previous.space) previous = {.space = cell.form.space};
    if (there.contains(cell.name)) {
      previous.previous = cell.name;
      continue;
    }
    Form form = cell.form;
    form.previous = previous.previous;
    others[form].push_back(&cell);
  }
  return others;
}

// Pairs first the cells with which rungs do the same, then the rest in their order.
void pairUp(std::vector<const NamedCell*> before, std::vector<const NamedCell*> after, FormerNames& former) {
  std::map<Roles, std::vector<const NamedCell*>> byRoles; // the first one last
  for (const NamedCell* cell : before | std::views::reverse) byRoles[cell->roles].push_back(cell);
  std::erase_if(after, [&](const NamedCell* cell) {
    const auto at = byRoles.find(cell->roles);
    if (at == byRoles.end() || at->second.empty()) return false;
    former.emplace(cell->name, at->second.back()->name);
    std::erase(before, at->second.back());
    at->second.pop_back();
    return true;
  });
  for (size_t i = 0; i < std::min(before.size(), after.size()); ++i) former.emplace(after[i]->name, before[i]->name);
}

// ---- bytes that are used as a whole -------------------------------------------------------------------------------

class WholeBytes {
public:
  explicit WholeBytes(const Version& version) : module_(version.module), cells_(cellsOf(version)) {
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i)
        add(module_.routines[r].rungs[i], version.given.of(RoutineId{r}, i));
    for (const Task& task : module_.tasks)
      for (const std::vector<Copy>* copies : {&task.begin, &task.end})
        for (const Copy& copy : *copies) {
          add(bitsOf(copy.from));
          add(targetOf(copy));
        }
  }
  bool contains(const Symbol& bit) const { return bytes_.contains({bit.space.index, bit.byte}); }

private:
  // An index may reach all of the variable to whose address it is added.
  void add(const Rung& rung, std::span<const GivenNumber> given) {
    bool bits = false, others = false; // at computed addresses
    for (const Op& op : rung.ops) {
      const std::optional<Use> use = useOf(module_, op);
      if (!use) continue;
      if (use->computed)
        (use->type == Type::Bit ? bits : others) = true;
      else if (use->type != Type::Bit)
        add(use->place);
    }
    if (bits && !others) return;
    for (const GivenNumber& number : given)
      if (number.space.valid() && number.bit == 0)
        add({number.space, number.byte * 8, (endOf(number) - number.byte) * 8});
  }

  // The end of the variable. The byte may be the first one of a table, whose other bytes have separate labels or none.
  uint32_t endOf(const GivenNumber& number) const {
    for (const Symbol* cell : cells_) {
      if (cell->space != number.space || cell->byte < number.byte || isBit(*cell) || bytesOf(*cell) == 1) continue;
      return cell->byte == number.byte ? cell->byte + bytesOf(*cell) : cell->byte;
    }
    const Space& space = module_.at(number.space);
    return std::max(number.byte, space.units * space.unitBytes);
  }

  void add(const BitRange& range) {
    if (!isOwn(module_, range.space) || range.count == 0) return;
    for (uint32_t byte = range.first / 8; byte <= (range.first + range.count - 1) / 8; ++byte)
      bytes_.emplace(range.space.index, byte);
  }

  const Module& module_;
  const std::vector<const Symbol*> cells_;
  std::set<std::pair<uint32_t, uint32_t>> bytes_; // by space
};

// ---- where bits are -----------------------------------------------------------------------------------------------

struct BitPlace {
  std::string text; // "bit 1 of IN1"
  bool isWhole = false;
};

// By former names; relative to variables that both versions have.
std::map<std::string, BitPlace> bitsOf(const Version& version, const FormerNames& former) {
  std::map<std::string, BitPlace> places;
  const WholeBytes whole(version);
  SpaceId space;
  std::string variable; // the last one
  uint32_t begin = 0;
  for (const Symbol* cell : cellsOf(version)) {
    if (cell->space != space) variable.clear();
    space = cell->space;
    const auto known = former.find(cell->name);
    if (known == former.end() || (cell->flags & RUNG_SYMBOL_HIDDEN) != 0) continue;
    if (!isBit(*cell)) {
      // Of several that begin at one place, always the same one is chosen.
      if (!variable.empty() && begin == cell->byte && variable < known->second) continue;
      variable = known->second;
      begin = cell->byte;
      continue;
    }
    const std::string distance = cell->byte != begin ? fmt::format("+{}", cell->byte - begin) : "";
    const std::string of = variable.empty() ? "its byte" : variable + distance;
    places.emplace(known->second, BitPlace{fmt::format("bit {} of {}", cell->bit, of), whole.contains(*cell)});
  }
  return places;
}

// ---- line numbers --------------------------------------------------------------------------------------------------

struct NamedLines {
  std::string name;
  std::vector<uint32_t> lines;
};
using Lines = std::map<std::string, NamedLines>; // by the former name of the cell

class LineCells {
public:
  LineCells(const Version& version, const FormerNames& former) : module_(version.module), given_(version.given) {
    forRungs([&](const Rung& rung, std::span<const GivenNumber> given) { findLines(rung, given); });
    forRungs([&](const Rung& rung, std::span<const GivenNumber> given) {
      if (rung.number != 0) findReads(rung, given);
    });
    for (const auto& [place, cell] : cells_)
      if (cell.isRead) name(place, cell, former);
  }
  const Lines& lines() const { return lines_; }

private:
  struct Cell {
    std::vector<uint32_t> lines;
    bool isRead = false;
  };

  using Place = std::pair<uint32_t, uint32_t>; // space and byte

  // The author knows the control's name. The other one, by the compiler, is unique.
  void name(const Place& place, const Cell& cell, const FormerNames& former) {
    std::string shown, key;
    for (const Symbol& symbol : module_.symbols) {
      if (Place(symbol.space.index, symbol.byte) != place || isBit(symbol)) continue;
      if ((symbol.flags & RUNG_SYMBOL_HIDDEN) == 0) shown = symbol.name;
      if (const auto known = former.find(symbol.name); known != former.end()) key = known->second;
    }
    if (!shown.empty() && !key.empty()) lines_.emplace(key, NamedLines{shown, cell.lines});
  }

  void forRungs(auto visit) {
    for (uint32_t r = 0; r < module_.routines.size(); ++r)
      for (uint32_t i = 0; i < module_.routines[r].rungs.size(); ++i)
        visit(module_.routines[r].rungs[i], given_.of(RoutineId{r}, i));
  }

  void findLines(const Rung& rung, std::span<const GivenNumber> given) {
    std::set<uint32_t> values;
    for (const GivenNumber& number : given)
      if (!number.space.valid()) values.insert(number.value.index);
    if (values.empty()) return;
    std::unordered_map<uint32_t, int64_t> constants;
    for (const Op& op : rung.ops) {
      if (op.code == OpCode::Const && values.contains(op.result.index)) constants.emplace(op.result.index, op.imm);
      if (op.code != OpCode::Store || op.type != Type::I16) continue;
      const auto constant = constants.find(arg(rung, op, 0).index);
      const std::optional<Use> use = useOf(module_, op);
      if (constant == constants.end() || !use || !isOwn(module_, use->place.space)) continue;
      std::vector<uint32_t>& lines = cells_[{use->place.space.index, use->place.first / 8}].lines;
      const auto line = static_cast<uint16_t>(constant->second);
      if (line != 0 && std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
    }
  }

  void findReads(const Rung& rung, std::span<const GivenNumber> given) {
    const auto read = [&](const BitRange& range) {
      for (auto& [place, cell] : cells_) cell.isRead |= overlap(range, {SpaceId{place.first}, place.second * 8, 16});
    };
    for (const Op& op : rung.ops)
      if (const std::optional<Use> use = useOf(module_, op); use && !use->writes && !use->computed) read(use->place);
    for (const GivenNumber& number : given)
      if (number.space.valid()) read({number.space, number.byte * 8, 8});
  }

  const Module& module_;
  const GivenNumbers& given_;
  std::map<Place, Cell> cells_;
  Lines lines_;
};

} // namespace

FormerNames formerNames(const Version& before, const Version& after) {
  const std::vector<NamedCell> old = namedCellsOf(before), now = namedCellsOf(after);
  const Names oldNames = namesOf(old), newNames = namesOf(now);
  FormerNames former;
  for (const std::string& name : newNames)
    if (oldNames.contains(name)) former.emplace(name, name);
  const auto gone = othersOf(old, newNames);
  for (const auto& [form, cells] : othersOf(now, oldNames))
    if (const auto at = gone.find(form); at != gone.end()) pairUp(at->second, cells, former);
  return former;
}

FormerNames ownNames(const FormerNames& former) {
  FormerNames own;
  for (const auto& [name, old] : former) own.emplace(old, old);
  return own;
}

std::vector<NameChange> compareBits(const Version& before, const Version& after, const FormerNames& former) {
  std::map<std::string, std::string> nameNow;
  for (const auto& [name, old] : former) nameNow.emplace(old, name);
  const std::map<std::string, BitPlace> old = bitsOf(before, ownNames(former)), now = bitsOf(after, former);
  std::vector<NameChange> changes;
  for (const auto& [name, place] : now) {
    const auto at = old.find(name);
    if (at == old.end() || at->second.text == place.text || !(at->second.isWhole || place.isWhole)) continue;
    changes.push_back({ChangeKind::Changed, nameNow.at(name), at->second.text, place.text});
  }
  return changes;
}

std::vector<LineChange> compareLines(const Version& before, const Version& after, const FormerNames& former) {
  const LineCells old(before, ownNames(former)), now(after, former);
  std::vector<LineChange> changes;
  for (const auto& [key, cell] : now.lines())
    if (const auto at = old.lines().find(key); at != old.lines().end() && at->second.lines != cell.lines)
      changes.push_back({cell.name, at->second.lines, cell.lines});
  return changes;
}

// Initial contents.

namespace {

using runtime::Ref;
using runtime::RefKind;

std::vector<uint8_t> startOf(const rung_program& program) {
  std::vector<uint8_t> memory(program.memory_size, 0);
  for (const rung_init& init : std::span(program.inits, program.init_count))
    std::copy_n(init.data, init.size, memory.begin() + init.offset);
  return memory;
}

std::string shown(const core::Memory& memory, const Ref& ref) {
  switch (ref.kind) {
  case RefKind::Text: return fmt::format("'{}'", runtime::readText(memory, ref));
  case RefKind::Real: return fmt::format("{}", runtime::readReal(memory, ref));
  case RefKind::Int:
    if (ref.width > 8) return fmt::format("{}", runtime::readSigned(memory, ref));
    [[fallthrough]]; // a byte may be part of any data
  case RefKind::Bit:
  case RefKind::Constant: return fmt::format("{}", runtime::readRaw(memory, ref));
  }
  return {};
}

void add(const core::Memory& memory, const rung_symbol& symbol, Contents& contents) {
  const Ref whole = runtime::refOf(symbol);
  if (whole.kind == RefKind::Text || whole.count <= 1) {
    contents.emplace(std::pair(symbol.name, 0), shown(memory, whole));
    return;
  }
  for (uint32_t i = 0; i < whole.count; ++i)
    if (const auto element = runtime::element(whole, i); element && runtime::readRaw(memory, *element) != 0)
      contents.emplace(std::pair(fmt::format("{}[{}]", symbol.name, i), i), shown(memory, *element));
}

} // namespace

Contents initialContents(const rung_program& program) {
  std::vector<uint8_t> start = startOf(program);
  const core::Memory memory(program, start.data());
  Contents contents;
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    if ((symbol.flags & (RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST)) != 0 || symbol.space >= program.space_count) continue;
    if ((program.spaces[symbol.space].flags & RUNG_SPACE_ALLOCATED) != 0) add(memory, symbol, contents);
  }
  return contents;
}

std::string zeroLike(const std::string& text) { return text.starts_with('\'') ? "''" : "0"; }

} // namespace rung::report
