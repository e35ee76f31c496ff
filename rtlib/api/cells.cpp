// Finds the places of names, in every program that an instance has or may get (see cells.h).
#include "rtlib/api/cells.h"

#include <algorithm>

#include "rtlib/run/loaded_program.h"

namespace rung::api {

rung_type typeOf(const runtime::Ref& ref) {
  switch (ref.kind) {
  case runtime::RefKind::Bit: return RUNG_TYPE_BIT;
  case runtime::RefKind::Real: return RUNG_TYPE_F64;
  case runtime::RefKind::Text: return RUNG_TYPE_TEXT;
  case runtime::RefKind::Constant: return RUNG_TYPE_I64;
  case runtime::RefKind::Int: break;
  }
  return ref.width == 8    ? RUNG_TYPE_I8
         : ref.width == 16 ? RUNG_TYPE_I16
         : ref.width == 32 ? RUNG_TYPE_I32
                           : RUNG_TYPE_I64;
}

namespace {

std::optional<runtime::Ref> realOf(const rung_program& program, const runtime::Ref& ref) {
  return ref.kind == runtime::RefKind::Real ? std::optional(ref) : runtime::asReal(core::Memory(program, nullptr), ref);
}

// The form in which a host holds a value of this type.
int formOf(rung_type type) { return type == RUNG_TYPE_F64 ? 1 : type == RUNG_TYPE_TEXT ? 2 : 0; }

} // namespace

LocatedCell locateCell(const Environment& environment, const rung_program& program, const CellName& name,
                       const rung_type* as) {
  LocatedCell cell;
  cell.writes = (name.access & RUNG_WRITE) != 0;
  std::optional<runtime::Ref> ref =
      cell.writes ? environment.writePlace(program, name.name) : environment.readPlace(program, name.name);
  if (!ref) return cell;
  if ((name.access & RUNG_REAL) != 0) ref = realOf(program, *ref);
  cell.state = CellState::Retyped;
  if (!ref) return cell;
  cell.ref = *ref;
  cell.type = typeOf(*ref);
  cell.place = runtime::locate(core::Memory(program, nullptr), *ref);
  cell.state = CellState::Good;
  if (as != nullptr && formOf(*as) != formOf(cell.type)) cell.state = CellState::Retyped;
  if (!cell.writes) return cell;
  if (ref->kind == runtime::RefKind::Constant) cell.state = CellState::Constant;
  if (runtime::Overwritten(program).source(*ref)) cell.state = CellState::Overwritten;
  if (environment.control().writesItself(program, *ref)) cell.state = CellState::Controls;
  return cell;
}

namespace {

// Whether any element is left out.
bool isLeftOut(const rung_program& program, const core::NeededCopies& copies, const runtime::Ref& ref) {
  if (copies.leftOut.empty() || ref.kind == runtime::RefKind::Constant) return false;
  constexpr uint32_t kExpanded = 8; // bytes of the block per byte of an expanded space
  const core::Memory memory(program, nullptr);
  const uint32_t bytes = (ref.bit + ref.width * ref.count + 7) / 8;
  for (uint32_t i = 0; i < bytes; ++i)
    if (const core::Place place = memory.locateBit(ref.space, ref.byte + i, 0);
        !place.outside() && copies.leavesOut(place.offset(), kExpanded))
      return true;
  return false;
}

} // namespace

void CellTable::set(rung_cell number, const LocatedCell& cell) {
  if (cell.state == CellState::Good && isLeftOut(*program_, copies_, cell.ref)) seesLeftOut_ = true;
  std::unique_ptr<Block>& block = blocks_[number / kBlock];
  if (block == nullptr) block = std::make_unique<Block>();
  (*block)[number % kBlock] = cell;
}

void CellTable::add(const LocatedCell& cell) {
  const uint32_t number = count_.load(std::memory_order_relaxed);
  set(number, cell);
  count_.store(number + 1, std::memory_order_release);
}

// False: all numbers are in use.
bool CellNames::takeNumber(rung_cell& cell) {
  if (!free_.empty()) {
    cell = free_.back();
    free_.pop_back();
    return true;
  }
  if (entries_.size() == CellTable::kMostCells) return false;
  cell = static_cast<rung_cell>(entries_.size());
  entries_.emplace_back();
  for (CellTable* table : tables_) table->add({});
  return true;
}

bool CellNames::find(const Environment& environment, const rung_program& program, const CellName& name,
                     CellState& state, rung_cell& cell) {
  const std::lock_guard lock(mutex_);
  if (const auto known = numbers_.find(name); known != numbers_.end()) {
    cell = known->second;
    state = locateCell(environment, program, name, &entries_[cell].type).state;
    if (state == CellState::Good) ++entries_[cell].users;
    return true;
  }
  const LocatedCell found = locateCell(environment, program, name);
  state = found.state;
  if (state != CellState::Good) return true;
  if (!takeNumber(cell)) return false;
  numbers_.emplace(name, cell);
  entries_[cell] = {name, found.type, 1};
  for (CellTable* table : tables_)
    table->set(cell,
               &table->program() == &program ? found : locateCell(environment, table->program(), name, &found.type));
  return true;
}

bool CellNames::hold(rung_cell cell) {
  const std::lock_guard lock(mutex_);
  return isUsed(cell) && ++entries_[cell].users != 0;
}

bool CellNames::release(rung_cell cell) {
  const std::lock_guard lock(mutex_);
  if (!isUsed(cell)) return false;
  if (--entries_[cell].users != 0) return true;
  numbers_.erase(entries_[cell].name);
  free_.push_back(cell);
  for (CellTable* table : tables_) table->set(cell, {.state = CellState::Released});
  return true;
}

std::optional<LocatedCell> CellNames::locate(const Environment& environment, const rung_program& program,
                                             rung_cell cell) {
  const std::lock_guard lock(mutex_);
  if (!isUsed(cell)) return std::nullopt;
  return locateCell(environment, program, entries_[cell].name, &entries_[cell].type);
}

std::optional<rung_type> CellNames::typeOf(rung_cell cell) {
  const std::lock_guard lock(mutex_);
  return isUsed(cell) ? std::optional(entries_[cell].type) : std::nullopt;
}

std::string CellNames::nameOf(rung_cell cell) {
  const std::lock_guard lock(mutex_);
  return entries_[cell].name.name;
}

void CellNames::join(const Environment& environment, CellTable& table) {
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_)
    table.add(entry.users != 0 ? locateCell(environment, table.program(), entry.name, &entry.type) : LocatedCell{});
  tables_.push_back(&table);
}

void CellNames::leave(CellTable& table) {
  const std::lock_guard lock(mutex_);
  std::erase(tables_, &table);
}

} // namespace rung::api
