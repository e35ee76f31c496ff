// Evaluates one rung from top to bottom (see rung_ranges.h). For an if with a known condition, one region is evaluated;
// otherwise both, and the results are joined. The iterations of a loop are taken together: what it carries or writes
// may have any value.
#include "ir/analysis/rung_ranges.h"

#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

bool isWrite(const Op& op) { return (opInfo(op.code).effects & kWrites) != 0; }

void join(CellRanges& into, const CellRanges& other) {
  for (size_t i = 0; i < into.size(); ++i) into[i] = into[i].joined(other[i]);
}

} // namespace

void RungRanges::run(const Rung& rung, std::span<const Cell> cells, CellRanges& held) {
  rung_ = &rung;
  cells_ = cells;
  held_ = &held;
  values_.clear();
  for (const Type type : rung.values) values_.push_back(wholeRange(type));
  findRegions(rung, regions_);
  for (uint32_t i = 0; i < rung.ops.size(); ++i) i = visit(i);
}

void RungRanges::setResults(const Op& op, std::span<const Range> ranges) {
  for (uint32_t k = 0; k < op.resultCount; ++k) set({op.result.index + k}, ranges[k]);
}

// Returns the last operation that it has evaluated.
uint32_t RungRanges::visit(uint32_t i) {
  const Op& op = rung_->ops[i];
  switch (op.code) {
  case OpCode::If: return openIf(i);
  case OpCode::Else: return turnElse(i);
  case OpCode::EndIf: closeIf(op); return i;
  case OpCode::Loop: openLoop(i); return i;
  case OpCode::EndLoop: closeLoop(); return i;
  case OpCode::Const: set(op.result, {static_cast<uint64_t>(op.imm), static_cast<uint64_t>(op.imm)}); return i;
  case OpCode::Load: set(op.result, load(op)); return i;
  default: break;
  }
  if (isWrite(op))
    store(op);
  else if (isEvaluable(opInfo(op.code)))
    set(op.result, pure(op));
  else if (op.resultCount == 1)
    set(op.result, wholeRange(rung_->values[op.result.index]));
  return i;
}

// ---- regions -----------------------------------------------------------------------------------------------------

std::vector<Range> RungRanges::yieldsOf(const Op& op) const {
  std::vector<Range> yields;
  for (int k = 0; k < op.argCount; ++k) yields.push_back(argOf(op, k));
  return yields;
}

uint32_t RungRanges::openIf(uint32_t i) {
  const Range& cond = argOf(rung_->ops[i], 0);
  open_.push_back({.held = *held_, .yields = {}, .decided = cond.isOne()});
  if (!cond.isOne() || cond.low == 1) return i;
  const uint32_t end = regions_[i].end;
  if (rung_->ops[end].code == OpCode::EndIf) open_.pop_back(); // without an else, and so without results
  return end;
}

uint32_t RungRanges::turnElse(uint32_t i) {
  const Op& op = rung_->ops[i];
  Frame& frame = open_.back();
  if (frame.decided) {
    const std::vector<Range> yields = yieldsOf(op);
    setResults(rung_->ops[regions_[i].end], yields);
    open_.pop_back();
    return regions_[i].end;
  }
  frame.yields = yieldsOf(op);
  std::swap(frame.held, *held_);
  return i;
}

void RungRanges::closeIf(const Op& op) {
  const Frame frame = std::move(open_.back());
  open_.pop_back();
  std::vector<Range> yields = yieldsOf(op);
  if (!frame.decided) {
    join(*held_, frame.held);
    for (size_t k = 0; k < yields.size(); ++k) yields[k] = yields[k].joined(frame.yields[k]);
  }
  setResults(op, yields);
}

// What the loop writes is unknown in all of its iterations and afterwards.
void RungRanges::openLoop(uint32_t i) {
  forgetWrites(i, regions_[i].end);
  open_.push_back({.held = *held_, .yields = {}});
}

void RungRanges::closeLoop() {
  *held_ = std::move(open_.back().held);
  open_.pop_back();
}

void RungRanges::forgetWrites(uint32_t first, uint32_t end) {
  for (uint32_t i = first; i < end; ++i) {
    if (!isWrite(rung_->ops[i])) continue;
    const std::optional<Use> use = useOf(module_, rung_->ops[i]);
    for (size_t c = 0; use && c < cells_.size(); ++c)
      if (overlap(cells_[c].place, use->place)) (*held_)[c] = wholeRange(cells_[c].type);
  }
}

// ---- values and memory -------------------------------------------------------------------------------------------

Range RungRanges::pure(const Op& op) const {
  const Type result = rung_->values[op.result.index];
  Range args[3];
  for (int k = 0; k < op.argCount; ++k) {
    if (typeOf(*rung_, arg(*rung_, op, k)) == Type::F64) return wholeRange(result);
    args[k] = argOf(op, k);
  }
  const Type first = op.argCount == 0 ? op.type : typeOf(*rung_, arg(*rung_, op, 0));
  return result == Type::F64 ? wholeRange(result) : rangeOf(opInfo(op.code), op.type, first, args);
}

Range RungRanges::load(const Op& op) const {
  for (size_t c = 0; c < cells_.size(); ++c)
    if (cells_[c].type == op.type && cells_[c].place.space.index == op.ref &&
        cells_[c].place.first == static_cast<uint64_t>(op.imm))
      return (*held_)[c];
  return wholeRange(op.type);
}

// The part of a window that the index may reach.
BitRange RungRanges::reachOf(const Op& op, BitRange all) const {
  const Range& index = argOf(op, 0);
  const uint64_t high = std::min<uint64_t>(index.high, op.count - 1);
  const uint32_t unit = module_.spaces[op.ref].unitBytes * 8;
  if (index.low > high) return {all.space, all.first, 0};
  const auto first = static_cast<uint32_t>(index.low * unit);
  const uint64_t count = (high - index.low) * unit + std::max(unit, bitWidth(op.type));
  return {all.space, all.first + first, static_cast<uint32_t>(std::min<uint64_t>(count, all.count - first))};
}

void RungRanges::store(const Op& op) {
  const std::optional<Use> use = useOf(module_, op);
  if (!use || (use->computed && op.count == 0)) return;
  const BitRange written = use->computed ? reachOf(op, use->place) : use->place;
  for (size_t c = 0; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    if (!overlap(cell.place, written)) continue;
    const bool same = op.code == OpCode::Store && op.type == cell.type && cell.place == written;
    (*held_)[c] = same ? argOf(op, 0) : wholeRange(cell.type);
  }
}

} // namespace rung::ir
