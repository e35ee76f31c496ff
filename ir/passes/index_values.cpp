// Constants first, then what rungs compute from cells with constants alone (see index_values.h).
#include "ir/passes/index_values.h"

#include <algorithm>

namespace rung::ir {
namespace {

constexpr size_t kMost = 4; // values of a cell

// The cell of a store to a fixed place of an integer.
bool storesCell(const Op& op) { return op.code == OpCode::Store && isInt(op.type); }
Cell cellOf(const Op& op) {
  return {.place = {SpaceId{op.ref}, static_cast<uint32_t>(op.imm), bitWidth(op.type)}, .type = op.type};
}

} // namespace

void findIndexCells(const Rung& rung, std::vector<Cell>& cells) {
  cells.clear();
  std::vector<bool> needed(rung.values.size(), false); // by value: an index is made of it
  const auto need = [&](const Op& op, int operand) { needed[arg(rung, op, operand).index] = true; };
  for (size_t i = rung.ops.size(); i-- > 0;) {
    const Op& op = rung.ops[i];
    if (opInfo(op.code).attr == Attr::Window) {
      need(op, 0);
      if (op.code == OpCode::LoadBitAt || op.code == OpCode::StoreBitAt) need(op, 1);
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
  constexpr int kSteps = 3; // from a cell with constants to what is computed of it, and on
  for (int step = 0; step < kSteps && derive(); ++step) {
  }
}

std::span<const uint64_t> IndexValues::of(const Cell& cell) const {
  const auto known = std::ranges::find(known_, cell, &Known::cell);
  if (known == known_.end() || known->values.size() > kMost) return {};
  return known->values;
}

IndexValues::Known* IndexValues::find(const Cell& cell) {
  const auto known = std::ranges::find(known_, cell, &Known::cell);
  return known == known_.end() ? nullptr : &*known;
}

bool IndexValues::add(Known& known, uint64_t value) {
  if (known.values.size() > kMost || std::ranges::find(known.values, value) != known.values.end()) return false;
  known.values.push_back(value);
  return true;
}

void IndexValues::findCells() {
  std::vector<Cell> cells;
  for (const Routine& routine : module_.routines)
    for (const Rung& rung : routine.rungs) {
      findIndexCells(rung, cells);
      for (const Cell& cell : cells)
        if (find(cell) == nullptr) known_.push_back({.cell = cell, .values = {}});
    }
}

void IndexValues::findConstants() {
  for (const Routine& routine : module_.routines)
    for (const Rung& rung : routine.rungs) {
      std::vector<const Op*> constants(rung.values.size(), nullptr);
      for (const Op& op : rung.ops) {
        if (op.code == OpCode::Const) constants[op.result.index] = &op;
        if (!storesCell(op)) continue;
        const Op* stored = constants[arg(rung, op, 0).index];
        Known* known = stored == nullptr ? nullptr : find(cellOf(op));
        if (known != nullptr) add(*known, static_cast<uint64_t>(stored->imm) & valueMask(op.type));
      }
    }
}

size_t IndexValues::mostValues() const {
  size_t most = 0;
  for (const Known& known : known_) most = std::max(most, of(known.cell).size());
  return most;
}

// One rung after the other, with each cell at its n-th value. Says whether there is something new.
bool IndexValues::derive() {
  std::vector<Cell> cells;
  for (const Known& known : known_) cells.push_back(known.cell);
  RungRanges ranges(module_);
  bool isNew = false;
  for (size_t n = 0, most = mostValues(); n < most; ++n) {
    CellRanges before;
    for (const Cell& cell : cells) {
      const std::span<const uint64_t> values = of(cell);
      before.push_back(n < values.size() ? Range{values[n], values[n]} : wholeRange(cell.type));
    }
    for (const Routine& routine : module_.routines)
      for (const Rung& rung : routine.rungs) {
        if (std::ranges::none_of(rung.ops, [&](const Op& op) { return storesCell(op) && find(cellOf(op)) != nullptr; }))
          continue;
        CellRanges held = before;
        ranges.run(rung, cells, held);
        for (const Op& op : rung.ops) {
          Known* known = storesCell(op) ? find(cellOf(op)) : nullptr;
          if (known == nullptr) continue;
          const Range& stored = ranges.of(arg(rung, op, 0));
          if (stored.isOne()) isNew |= add(*known, stored.low);
        }
      }
  }
  return isNew;
}

} // namespace rung::ir
