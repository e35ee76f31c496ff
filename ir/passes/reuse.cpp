// Reuse: an operation without effects that was done before with the same operands is not done again. A load takes the
// value that an earlier load of the same place and type gave, or an earlier store put there, unless something between
// may have written over it. Values of a region are known within it only; writes count from where they are, whether
// their region runs or not; and a loop that writes at all makes everything unknown that was read before it.
#include <algorithm>
#include <utility>

#include "ir/passes/passes.h"
#include "ir/passes/rewriter.h"
#include "ir/passes/value_table.h"
#include "ir/passes/write_times.h"

namespace rung::ir {
namespace {

bool isCommutative(OpCode code) {
  return code == OpCode::Add || code == OpCode::Mul || code == OpCode::And || code == OpCode::Or ||
         code == OpCode::Xor || code == OpCode::Eq || code == OpCode::Ne || code == OpCode::FAdd ||
         code == OpCode::FMul || code == OpCode::FEq;
}

class Reuser {
public:
  explicit Reuser(const Module& module) : writes_(module) {}

  void run(Rung& rung) {
    rung_ = &rung;
    writer_.start(rung);
    table_.clear(rung.ops.size());
    writes_.start(rung);
    findWritingLoops();
    size_t reused = 0;
    for (uint32_t i = 0; i < rung.ops.size(); ++i) reused += visit(i) ? 1 : 0;
    if (reused != 0) writer_.finish(rung);
  }

private:
  // Whether the results of operation i are there already.
  bool visit(uint32_t i) {
    const Op& op = rung_->ops[i];
    const OpInfo& info = opInfo(op.code);
    const uint32_t time = i + 1;
    if (onlyReads(info)) return reuse(op, time);
    if (op.code == OpCode::Else || op.code == OpCode::EndIf || op.code == OpCode::EndLoop) table_.close();
    if (op.code == OpCode::If || op.code == OpCode::Else || op.code == OpCode::Loop) table_.open();
    if (op.code == OpCode::Loop && writingLoop_[i]) writes_.writeAll(time);
    if (isThere(op)) return true;
    writer_.copy(op);
    if ((info.effects & kWrites) != 0) {
      writes_.write(op, time);
      if (op.code == OpCode::Store || op.code == OpCode::SlotStore)
        table_.enter(keyOf(op), writer_.nowArg(op, 0), time);
    }
    return false;
  }

  // A store of what its place holds already.
  bool isThere(const Op& op) {
    if (op.code != OpCode::Store && op.code != OpCode::SlotStore) return false;
    const ValueTable::Entry* entry = table_.find(keyOf(op));
    return entry != nullptr && entry->value == writer_.nowArg(op, 0) && writes_.unchanged(op, entry->time);
  }

  bool reuse(const Op& op, uint32_t time) {
    const bool reads = opInfo(op.code).effects == kReads;
    const ValueKey key = keyOf(op);
    const ValueTable::Entry* entry = table_.find(key);
    if (entry != nullptr && (!reads || writes_.unchanged(op, entry->time))) {
      writer_.replace(op.result, entry->value);
      return true;
    }
    writer_.copy(op);
    table_.enter(key, writer_.now(op.result), time);
    return false;
  }

  // A store has the key of the load that reads its place.
  ValueKey keyOf(const Op& op) const {
    ValueKey key{.code = op.code, .type = op.type, .ref = op.ref, .count = op.count, .imm = op.imm, .args = {0, 0, 0}};
    if (op.code == OpCode::Store)
      key.code = OpCode::Load;
    else if (op.code == OpCode::SlotStore)
      key.code = OpCode::SlotLoad;
    else
      for (uint32_t i = 0; i < op.argCount; ++i) key.args[i] = writer_.nowArg(op, i).index;
    if (isCommutative(op.code) && key.args[0] > key.args[1]) std::swap(key.args[0], key.args[1]);
    return key;
  }

  void findWritingLoops() {
    writingLoop_.assign(rung_->ops.size(), false);
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < rung_->ops.size(); ++i) {
      const Op& op = rung_->ops[i];
      if (op.code == OpCode::Loop) {
        open.push_back(i);
      } else if (op.code == OpCode::EndLoop) {
        const bool writes = writingLoop_[open.back()];
        open.pop_back();
        if (writes && !open.empty()) writingLoop_[open.back()] = true;
      } else if (!open.empty() && (opInfo(op.code).effects & kWrites) != 0) {
        writingLoop_[open.back()] = true;
      }
    }
  }

  Rung* rung_ = nullptr;
  RungRewriter writer_;
  ValueTable table_;
  WriteTimes writes_;
  std::vector<bool> writingLoop_; // by operation
};

} // namespace

void reuseValues(Module& module) {
  Reuser reuser(module);
  for (Routine& routine : module.routines)
    for (Rung& rung : routine.rungs) reuser.run(rung);
}

} // namespace rung::ir
