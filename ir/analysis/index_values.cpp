// Finds constants, then the values that rungs compute from cells with constants only (see index_values.h).
#include "ir/analysis/index_values.h"

#include <algorithm>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

constexpr size_t kMost = 4; // most values of a cell

// The cell of a store to a fixed place of an integer.
bool storesCell(const Op& op) { return op.code == OpCode::Store && isInt(op.type); }
Cell cellOf(const Op& op) {
  return {.place = {SpaceId{op.ref}, static_cast<uint32_t>(op.imm), bitWidth(op.type)}, .type = op.type};
}

uint64_t keyOf(const Cell& cell) {
  return uint64_t{cell.place.space.index} << 40 | uint64_t{cell.place.first} << 8 | static_cast<uint64_t>(cell.type);
}

bool add(std::vector<uint64_t>& values, uint64_t value) {
  if (values.size() > kMost || std::ranges::find(values, value) != values.end()) return false;
  values.push_back(value);
  return true;
}

} // namespace

void findIndexCells(const Rung& rung, std::vector<Cell>& cells) {
  cells.clear();
  if (std::ranges::none_of(rung.ops, isWindow)) return;
  std::vector<bool> needed(rung.values.size(), false); // by value: whether an index depends on it
  const auto need = [&](const Op& op, int operand) { needed[arg(rung, op, operand).index] = true; };
  for (size_t i = rung.ops.size(); i-- > 0;) {
    const Op& op = rung.ops[i];
    if (isWindow(op)) {
      need(op, 0);
      if (isOfBit(op)) need(op, 1);
    }
    if (op.resultCount != 1 || !needed[op.result.index]) continue;
    if (op.code == OpCode::Load && isInt(op.type) && std::ranges::find(cells, cellOf(op)) == cells.end())
      cells.push_back(cellOf(op));
    if (isPure(opInfo(op.code)))
      for (int k = 0; k < op.argCount; ++k) need(op, k);
  }
}

IndexValues::IndexValues(const Module& module) : module_(module) {
  findCells();
  findConstants();
  constexpr int kSteps = 3; // of computation, from a cell with constants to other cells
  for (int step = 0; step < kSteps && derive(); ++step) {
  }
}

std::span<const uint64_t> IndexValues::of(const Cell& cell) const {
  const auto known = values_.find(keyOf(cell));
  if (known == values_.end() || known->second.size() > kMost) return {};
  return known->second;
}

std::vector<uint64_t>* IndexValues::find(const Cell& cell) {
  const auto known = values_.find(keyOf(cell));
  return known == values_.end() ? nullptr : &known->second;
}

void IndexValues::findCells() {
  std::vector<Cell> cells;
  for (const Routine& routine : module_.routines)
    for (const Rung& rung : routine.rungs) {
      findIndexCells(rung, cells);
      for (const Cell& cell : cells) values_.try_emplace(keyOf(cell));
    }
}

void IndexValues::findConstants() {
  const auto stores = [&](const Op& op) { return storesCell(op) && find(cellOf(op)) != nullptr; };
  for (const Routine& routine : module_.routines)
    for (const Rung& rung : routine.rungs)
      if (std::ranges::any_of(rung.ops, stores)) storing_.push_back(&rung);
  for (const Rung* rung : storing_) findConstants(*rung);
}

void IndexValues::findConstants(const Rung& rung) {
  std::vector<const Op*> constants(rung.values.size(), nullptr);
  for (const Op& op : rung.ops) {
    if (op.code == OpCode::Const) constants[op.result.index] = &op;
    if (!storesCell(op)) continue;
    const Op* stored = constants[arg(rung, op, 0).index];
    std::vector<uint64_t>* values = stored == nullptr ? nullptr : find(cellOf(op));
    if (values != nullptr) add(*values, static_cast<uint64_t>(stored->imm) & valueMask(op.type));
  }
}

// Whether it has found new values.
bool IndexValues::derive() {
  RungRanges ranges(module_);
  bool isNew = false;
  for (size_t n = 0; n < kMost; ++n)
    for (const Rung* rung : storing_) isNew |= deriveFrom(*rung, n, ranges);
  return isNew;
}

// Evaluates one rung, with each cell at its n-th value.
bool IndexValues::deriveFrom(const Rung& rung, size_t n, RungRanges& ranges) {
  std::vector<Cell> cells;
  CellRanges held;
  bool stores = false;
  bool knows = false;
  for (const Op& op : rung.ops) {
    if (!isInt(op.type) || (op.code != OpCode::Load && op.code != OpCode::Store)) continue;
    const Cell cell = cellOf(op);
    if (find(cell) == nullptr) continue;
    stores |= op.code == OpCode::Store;
    if (std::ranges::find(cells, cell) != cells.end()) continue;
    const std::span<const uint64_t> values = of(cell);
    knows |= n < values.size();
    cells.push_back(cell);
    held.push_back(n < values.size() ? Range{values[n], values[n]} : wholeRange(cell.type));
  }
  if (!stores || !knows) return false;
  ranges.run(rung, cells, held);
  bool isNew = false;
  for (const Op& op : rung.ops) {
    std::vector<uint64_t>* values = storesCell(op) ? find(cellOf(op)) : nullptr;
    const Range stored = values == nullptr ? Range{0, 1} : ranges.of(arg(rung, op, 0));
    if (values != nullptr && stored.isOne()) isNew |= add(*values, stored.low);
  }
  return isNew;
}

} // namespace rung::ir
