// Guards: an index that a program computes from a cell is small in nearly every scan, but may be anything. A rung that
// accesses several places by such indices asks once whether all of these cells hold small numbers, and has two ways
// then. On the one comparisons of the indices with the ends of windows are known; windows are as small as the indices,
// so that stores through them leave alone what is loaded elsewhere; and indices are masked where that changes nothing,
// so that every compiler sees that they lie inside. The other way is the rung as it was.
#include <algorithm>
#include <bit>
#include <optional>

#include "ir/passes/passes.h"
#include "ir/passes/rewriter.h"
#include "ir/passes/rung_ranges.h"

namespace rung::ir {
namespace {

constexpr uint64_t kLimits[] = {64, 32, 16, 8}; // what counts as small
constexpr uint64_t kNoLimit = 0;
constexpr size_t kMaxCells = 3;    // of a rung
constexpr uint32_t kLeastGain = 4; // windows and comparisons: less costs more than it saves

bool isWindow(const Op& op) { return opInfo(op.code).attr == Attr::Window; }
bool isOfBit(const Op& op) { return op.code == OpCode::LoadBitAt || op.code == OpCode::StoreBitAt; }
bool isCompare(const Op& op) {
  return opInfo(op.code).result == Constraint::Bit && op.type != Type::Bit && isEvaluable(opInfo(op.code));
}

class Guard {
public:
  explicit Guard(const Module& module) : module_(module) {}

  void run(Rung& rung) {
    rung_ = &rung;
    if (!findCells() || isGuarded()) return;
    const uint32_t before = known(kNoLimit);
    uint64_t limit = 0;
    uint32_t most = before + kLeastGain - 1;
    for (const uint64_t small : kLimits)
      if (const uint32_t now = known(small); now > most) {
        most = now;
        limit = small;
      }
    if (limit != 0) split(rung, limit);
  }

private:
  // The cells that indices come from.
  bool findCells() {
    cells_.clear();
    needed_.assign(rung_->values.size(), false);
    for (size_t i = rung_->ops.size(); i-- > 0;) {
      const Op& op = rung_->ops[i];
      if (isWindow(op)) {
        need(op, 0);
        if (isOfBit(op)) need(op, 1);
      }
      if (op.resultCount != 1 || !needed_[op.result.index]) continue;
      if (op.code == OpCode::Load && isInt(op.type)) addCell(op);
      if (isPure(opInfo(op.code)))
        for (int k = 0; k < op.argCount; ++k) need(op, k);
    }
    return !cells_.empty() && cells_.size() <= kMaxCells;
  }
  void need(const Op& op, int operand) { needed_[arg(*rung_, op, operand).index] = true; }
  void addCell(const Op& load) {
    const Cell cell{.place = {SpaceId{load.ref}, static_cast<uint32_t>(load.imm), bitWidth(load.type)},
                    .type = load.type};
    if (std::ranges::find(cells_, cell) == cells_.end()) cells_.push_back(cell);
  }

  // Whether the rung asks for a limit already.
  bool isGuarded() {
    enum : uint8_t { kOther, kLimit, kQuestion };
    std::vector<uint8_t> what(rung_->values.size(), kOther);
    const auto of = [&](const Op& op, int i) { return what[arg(*rung_, op, i).index]; };
    for (const Op& op : rung_->ops) {
      if (op.code == OpCode::If && of(op, 0) == kQuestion) return true;
      if (op.code == OpCode::Const && std::ranges::count(kLimits, static_cast<uint64_t>(op.imm)) != 0)
        what[op.result.index] = kLimit;
      if (op.code == OpCode::LtU && of(op, 1) == kLimit) what[op.result.index] = kQuestion;
      if (op.code == OpCode::And && of(op, 0) == kQuestion && of(op, 1) == kQuestion) what[op.result.index] = kQuestion;
    }
    return false;
  }

  // How many windows and comparisons are known when the cells are below a limit.
  uint32_t known(uint64_t limit) {
    CellRanges held = belowLimit(limit);
    RungRanges& ranges = ranges_.emplace(module_, cells_);
    ranges.run(*rung_, held);
    uint32_t count = 0;
    for (const Op& op : rung_->ops) {
      if (isWindow(op) && ranges.of(arg(*rung_, op, 0)).high < op.count) ++count;
      if (isCompare(op) && ranges.of(op.result).isOne()) ++count;
    }
    return count;
  }
  CellRanges belowLimit(uint64_t limit) const {
    CellRanges held;
    for (const Cell& cell : cells_) {
      const Range all = wholeRange(cell.type);
      held.push_back(limit == kNoLimit ? all : Range{0, std::min(limit - 1, all.high)});
    }
    return held;
  }

  void split(Rung& rung, uint64_t limit) {
    known(limit); // ranges of the short way
    const Op first = rung.ops.front();
    writer_.start(rung);
    writer_.openIf(first, question(first, limit));
    for (const Op& op : rung.ops)
      if (!becomesConstant(op) && !shrinks(op)) writer_.copy(op);
    writer_.turnElse(first, leaving());
    for (const Op& op : rung.ops)
      if (op.code != OpCode::Note) writer_.copy(op); // once is enough
    writer_.closeIf(first, leaving(), transferValues());
    writer_.finish(rung);
  }

  ValueId question(const Op& at, uint64_t limit) {
    ValueId all;
    for (const Cell& cell : cells_) {
      Op& load = writer_.putBefore(at, OpCode::Load, cell.type, {});
      load.ref = cell.place.space.index;
      load.imm = cell.place.first;
      const ValueId value = load.result;
      const ValueId end = writer_.putConstant(at, cell.type, limit);
      const ValueId small = writer_.putBefore(at, OpCode::LtU, cell.type, {value, end}).result;
      all = all.valid() ? writer_.putBefore(at, OpCode::And, Type::Bit, {all, small}).result : small;
    }
    return all;
  }

  // What the rung's transfer needs of it.
  std::vector<ValueId> transferValues() const {
    std::vector<ValueId> values;
    for (const ValueId value : {rung_->transfer.cond, rung_->transfer.value})
      if (value.valid()) values.push_back(value);
    return values;
  }
  std::vector<ValueId> leaving() const {
    std::vector<ValueId> now;
    for (const ValueId value : transferValues()) now.push_back(writer_.now(value));
    return now;
  }

  // ---- the short way

  bool becomesConstant(const Op& op) {
    if (op.resultCount != 1 || op.code == OpCode::Const || !isEvaluable(opInfo(op.code))) return false;
    const Range& range = ranges_->of(op.result);
    const Type type = typeOf(*rung_, op.result);
    if (!range.isOne() || type == Type::F64) return false;
    writer_.replace(op.result, writer_.putConstant(op, type, range.low));
    return true;
  }

  bool shrinks(const Op& op) {
    if (!isWindow(op)) return false;
    const Range& index = ranges_->of(arg(*rung_, op, 0));
    if (index.high >= op.count) return false;
    const uint64_t most = std::bit_ceil(index.high - index.low + 1); // elements, as many as a mask lets through
    const ValueId base = constant(op, 0 - index.low);
    const ValueId number = writer_.putBefore(op, OpCode::Add, Type::I32, {writer_.nowArg(op, 0), base}).result;
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
    const Range& bit = ranges_->of(arg(*rung_, op, 1));
    const ValueId number = writer_.nowArg(op, 1);
    if (bit.isOne() || bit.high >= unitBits) return number;
    return writer_.putBefore(op, OpCode::And, Type::I32, {number, constant(op, std::bit_ceil(bit.high + 1) - 1)})
        .result;
  }

  ValueId constant(const Op& op, uint64_t bits) {
    return writer_.putConstant(op, Type::I32, bits & valueMask(Type::I32));
  }

  const Module& module_;
  const Rung* rung_ = nullptr;
  RungRewriter writer_;
  std::optional<RungRanges> ranges_;
  std::vector<Cell> cells_;
  std::vector<bool> needed_; // by value: an index is made of it
};

} // namespace

void guardIndices(Module& module) {
  Guard guard(module);
  for (Routine& routine : module.routines)
    for (Rung& rung : routine.rungs) guard.run(rung);
}

} // namespace rung::ir
