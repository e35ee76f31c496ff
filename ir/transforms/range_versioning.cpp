// Range versioning: an index that a program computes from a cell has one of a few values in nearly every scan, but may
// have any. A rung that accesses places by such indices tests once what the cells hold, and gets a version for each
// case: for the numbers that the program stores there (index_values.h), where places are practically fixed; otherwise
// for small numbers. In a version, comparisons of indices with the ends of windows are known, windows are as small as
// the ranges of the indices, so that stores through them do not invalidate other loads, and indices are masked where
// that has no effect, so that every compiler sees that they are within the window. The last version is the unchanged
// rung.
#include <algorithm>
#include <bit>

#include "ir/analysis/index_values.h"
#include "ir/analysis/rung_ranges.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {
namespace {

constexpr uint64_t kLimits[] = {64, 32, 16, 8}; // limits of small numbers
constexpr size_t kMaxCells = 3;                 // most cells of a rung
constexpr uint32_t kLeastGain = 4;              // known windows and comparisons: fewer cost more than they save
constexpr uint32_t kLeastGainFixed = 2;         // if all indices are known

bool isCompare(const Op& op) {
  return opInfo(op.code).result == Constraint::Bit && op.type != Type::Bit && isEvaluable(opInfo(op.code));
}

bool mayBeKnown(const Op& op) { return isWindow(op) || isCompare(op); }

class RangeVersioning {
public:
  explicit RangeVersioning(const Module& module) : module_(module), values_(module), ranges_(module) {}

  // Whether the rung has got versions.
  bool run(Rung& rung) {
    rung_ = &rung;
    findIndexCells(rung, cells_);
    if (cells_.empty() || cells_.size() > kMaxCells) return false;
    findWays();
    if (versions_.empty()) return false;
    split(rung);
    return true;
  }

private:
  void findWays() {
    versions_.clear();
    const auto all = static_cast<uint32_t>(std::ranges::count_if(rung_->ops, mayBeKnown));
    if (all < kLeastGainFixed) return;
    const uint32_t before = known(wholeCells());
    for (size_t n = 0; hasValues(n); ++n) {
      CellRanges version = valuesOf(n);
      if (known(version) >= before + kLeastGainFixed) versions_.push_back(std::move(version));
    }
    if (!versions_.empty()) return;
    uint32_t most = before + kLeastGain - 1;
    for (const uint64_t limit : kLimits) {
      if (most >= all) return;
      const CellRanges version = below(limit);
      const uint32_t now = known(version);
      if (now <= most) continue;
      most = now;
      versions_.assign(1, version);
    }
  }

  // Number of windows and comparisons that are known if the cells are in these ranges.
  uint32_t known(CellRanges held) {
    ranges_.run(*rung_, cells_, held);
    uint32_t count = 0;
    for (const Op& op : rung_->ops) {
      if (isWindow(op) && ranges_.of(arg(*rung_, op, 0)).high < op.count) ++count;
      if (isCompare(op) && ranges_.of(op.result).isOne()) ++count;
    }
    return count;
  }

  CellRanges wholeCells() const {
    CellRanges held;
    for (const Cell& cell : cells_) held.push_back(wholeRange(cell.type));
    return held;
  }
  CellRanges below(uint64_t limit) const {
    CellRanges held = wholeCells();
    for (Range& range : held) range.high = std::min(limit - 1, range.high);
    return held;
  }
  // Whether there is an n-th version; a cell with one value has it in all of them.
  bool hasValues(size_t n) const {
    const auto hasN = [&](const Cell& cell) { return values_.of(cell).size() > n; };
    const auto hasSome = [&](const Cell& cell) { return !values_.of(cell).empty(); };
    return std::ranges::any_of(cells_, hasN) && std::ranges::all_of(cells_, hasSome);
  }
  CellRanges valuesOf(size_t n) const {
    CellRanges held;
    for (const Cell& cell : cells_) {
      const std::span<const uint64_t> values = values_.of(cell);
      const uint64_t value = values[std::min(n, values.size() - 1)];
      held.push_back({value, value});
    }
    return held;
  }

  // ---- the rung with its versions

  void split(Rung& rung) {
    const Op first = rung.ops.front();
    writer_.start(rung);
    for (const CellRanges& version : versions_) {
      CellRanges held = version;
      ranges_.run(rung, cells_, held);
      writer_.openIf(first, question(first, version), &version == &versions_.back() ? kMostly : kEven);
      for (const Op& op : rung.ops)
        if (!becomesConstant(op) && !shrinks(op) && op.code != OpCode::Note) writer_.copy(op);
      writer_.turnElse(first, leaving());
    }
    for (const Op& op : rung.ops) writer_.copy(op); // the unchanged rung, the only version that keeps its notes
    for (size_t n = 0; n < versions_.size(); ++n) writer_.closeIf(first, leaving(), transferValues());
    writer_.finish(rung);
  }

  // Whether the cells are in the ranges of a version.
  ValueId question(const Op& at, const CellRanges& version) {
    ValueId all;
    for (size_t c = 0; c < cells_.size(); ++c) {
      const Cell& cell = cells_[c];
      Op& load = writer_.putBefore(at, OpCode::Load, cell.type, {});
      load.ref = cell.place.space.index;
      load.imm = cell.place.first;
      const ValueId value = load.result;
      const OpCode compare = version[c].isOne() ? OpCode::Eq : OpCode::LeU;
      const ValueId bound = writer_.putConstant(at, cell.type, version[c].high);
      const ValueId holds = writer_.putBefore(at, compare, cell.type, {value, bound}).result;
      all = all.valid() ? writer_.putBefore(at, OpCode::And, Type::Bit, {all, holds}).result : holds;
    }
    return all;
  }

  // The values that the rung's transfer uses.
  std::vector<ValueId> transferValues() const {
    std::vector<ValueId> values;
    for (const ValueId value : {rung_->transfer.cond, rung_->transfer.value})
      if (value.valid()) values.push_back(value);
    return values;
  }
  std::vector<ValueId> leaving() const {
    std::vector<ValueId> now;
    for (const ValueId value : transferValues()) now.push_back(writer_.mapped(value));
    return now;
  }

  bool becomesConstant(const Op& op) {
    if (op.resultCount != 1 || op.code == OpCode::Const) return false;
    if (op.code != OpCode::Load && !isEvaluable(opInfo(op.code))) return false;
    const Range& range = ranges_.of(op.result);
    const Type type = typeOf(*rung_, op.result);
    if (!range.isOne() || type == Type::F64) return false;
    writer_.replace(op.result, writer_.putConstant(op, type, range.low));
    return true;
  }

  bool shrinks(const Op& op) {
    if (!isWindow(op)) return false;
    const Range& index = ranges_.of(arg(*rung_, op, 0));
    if (index.isOne() || index.high >= op.count) return false;       // folding makes it a fixed place
    const uint64_t most = std::bit_ceil(index.high - index.low + 1); // number of elements that a mask lets through
    const ValueId base = constant(op, 0 - index.low);
    const ValueId number = writer_.putBefore(op, OpCode::Add, Type::I32, {writer_.mappedArg(op, 0), base}).result;
    const ValueId element = writer_.putBefore(op, OpCode::And, Type::I32, {number, constant(op, most - 1)}).result;
    const uint32_t unitBits = module_.spaces[op.ref].unitBytes * 8;
    const ValueId bit = isOfBit(op) ? bitNumber(op, unitBits) : ValueId{};
    Op& written = writer_.copy(op);
    writer_.setArg(written, 0, element);
    if (isOfBit(op)) writer_.setArg(written, 1, bit);
    written.imm += static_cast<int64_t>(index.low * unitBits);
    written.count = static_cast<uint32_t>(std::min(most, op.count - index.low));
    return true;
  }

  ValueId bitNumber(const Op& op, uint32_t unitBits) {
    const Range& bit = ranges_.of(arg(*rung_, op, 1));
    const ValueId number = writer_.mappedArg(op, 1);
    if (bit.isOne() || bit.high >= unitBits) return number;
    return writer_.putBefore(op, OpCode::And, Type::I32, {number, constant(op, std::bit_ceil(bit.high + 1) - 1)})
        .result;
  }

  ValueId constant(const Op& op, uint64_t bits) {
    return writer_.putConstant(op, Type::I32, bits & valueMask(Type::I32));
  }

  const Module& module_;
  IndexValues values_;
  const Rung* rung_ = nullptr;
  RungRewriter writer_;
  std::vector<Cell> cells_;
  RungRanges ranges_;
  std::vector<CellRanges> versions_;
};

} // namespace

void versionRanges(Module& module, Settled& settled) {
  RangeVersioning guard(module);
  settled.eachOpen(module, kNothingSettled, [&](Rung& rung, uint32_t, uint8_t before) {
    return guard.run(rung) ? uint8_t{kNothingSettled} : before;
  });
}

} // namespace rung::ir
