// Inlines each routine that has one call and is not the entry of a task: its rungs follow the rung with the call. The
// call becomes a step to the next rung, or if it is conditional a jump past them; a return becomes a jump to the rung
// after them. Entering and leaving is then a jump within a chunk, across which passes and compilers can optimise. Each
// rung keeps its routine's name and its number, for messages, profiles and explanations.
#include <algorithm>

#include "ir/core/ops.h"
#include "ir/transforms/passes.h"

namespace rung::ir {
namespace {

// The position of a rung in the source.
struct Place {
  uint32_t routine;
  uint32_t rung;
};

class Inliner {
public:
  explicit Inliner(Module& module) : module_(module), calls_(module.routines.size(), 0) {
    for (const Routine& routine : module.routines)
      for (const Rung& rung : routine.rungs)
        if (rung.transfer.kind == TransferKind::Call) ++calls_[rung.transfer.callee.index];
    constexpr uint32_t kMany = 2;
    for (const Task& task : module.tasks) calls_[task.entry.index] = kMany;
    for (const Routine& routine : module.routines) at_.emplace_back(routine.rungs.size());
    after_.resize(module.routines.size());
    now_.resize(module.routines.size());
  }

  void run() {
    if (std::ranges::find(calls_, 1) == calls_.end()) return;
    noteOrigins();
    std::vector<Routine> out;
    for (uint32_t r = 0; r < module_.routines.size(); ++r) {
      if (isInlined(r)) continue;
      now_[r] = RoutineId{static_cast<uint32_t>(out.size())};
      out.push_back(expanded(r));
    }
    for (Routine& routine : out)
      for (Rung& rung : routine.rungs)
        if (rung.transfer.kind == TransferKind::Call) rung.transfer.callee = now_[rung.transfer.callee.index];
    for (Task& task : module_.tasks) {
      for (uint32_t& border : task.borders) border = at_[task.entry.index][border];
      task.entry = now_[task.entry.index];
    }
    module_.routines = std::move(out);
  }

private:
  bool isInlined(uint32_t routine) const { return calls_[routine] == 1; }
  bool callsInlined(const Rung& rung) const {
    return rung.transfer.kind == TransferKind::Call && isInlined(rung.transfer.callee.index);
  }

  void noteOrigins() {
    uint32_t index = 0;
    for (Routine& routine : module_.routines) {
      for (Rung& rung : routine.rungs) {
        if (rung.origin.index == RUNG_NONE) rung.origin = {routine.name, index};
        ++index;
      }
    }
  }

  Routine expanded(uint32_t routine) {
    const std::vector<Place> order = orderOf(routine);
    Routine out{.name = module_.routines[routine].name, .rungs = {}};
    for (const Place& from : order) {
      Rung& rung = out.rungs.emplace_back(std::move(module_.routines[from.routine].rungs[from.rung]));
      adjust(rung, from, static_cast<uint32_t>(order.size()));
    }
    return out;
  }

  // The routine's rungs and those of the routines inlined into it, in their new order; fills at_ and after_.
  std::vector<Place> orderOf(uint32_t routine) {
    std::vector<Place> order;
    std::vector<Place> open{{routine, 0}};
    while (!open.empty()) {
      const Place next = open.back();
      if (next.rung == module_.routines[next.routine].rungs.size()) {
        after_[next.routine] = static_cast<uint32_t>(order.size());
        open.pop_back();
        continue;
      }
      ++open.back().rung;
      at_[next.routine][next.rung] = static_cast<uint32_t>(order.size());
      order.push_back(next);
      const Rung& rung = module_.routines[next.routine].rungs[next.rung];
      if (callsInlined(rung)) open.push_back({rung.transfer.callee.index, 0});
    }
    return order;
  }

  void adjust(Rung& rung, const Place& from, uint32_t count) {
    Transfer& transfer = rung.transfer;
    if (callsInlined(rung)) {
      const uint32_t after = after_[transfer.callee.index];
      transfer.callee = {};
      if (!transfer.cond.valid()) {
        transfer.kind = TransferKind::Next;
        return;
      }
      transfer.cond = negated(rung, transfer.cond);
      jump(transfer, after, count);
    } else if (transfer.kind == TransferKind::Ret && isInlined(from.routine)) {
      jump(transfer, after_[from.routine], count);
      if (transfer.kind == TransferKind::Goto && transfer.target == at_[from.routine][from.rung] + 1) transfer = {};
    } else if (transfer.kind == TransferKind::Goto) {
      transfer.target = at_[from.routine][transfer.target];
    }
    for (uint32_t& target : transfer.targets) target = at_[from.routine][target];
  }

  // A jump past the last rung becomes a return.
  static void jump(Transfer& transfer, uint32_t to, uint32_t count) {
    transfer.kind = to < count ? TransferKind::Goto : TransferKind::Ret;
    transfer.target = to < count ? to : 0;
  }

  static ValueId negated(Rung& rung, ValueId value) {
    const ValueId result{static_cast<uint32_t>(rung.values.size())};
    Op op;
    op.code = OpCode::Not;
    op.type = Type::Bit;
    op.argCount = op.resultCount = 1;
    op.firstArg = static_cast<uint32_t>(rung.args.size());
    op.result = result;
    op.line = rung.transferLine;
    rung.ops.push_back(op);
    rung.args.push_back(value);
    rung.values.push_back(Type::Bit);
    return result;
  }

  Module& module_;
  std::vector<uint32_t> calls_;           // by routine: number of calls; a task's entry counts as several
  std::vector<std::vector<uint32_t>> at_; // by routine and rung: the rung's new number
  std::vector<uint32_t> after_;           // by inlined routine: the number after its last rung
  std::vector<RoutineId> now_;            // by remaining routine
};

} // namespace

void inlineRoutines(Module& module) { Inliner(module).run(); }

} // namespace rung::ir
