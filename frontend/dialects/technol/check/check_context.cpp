// Calls, and the contents of the registers (see check_context.h).
#include "frontend/dialects/technol/check/check_context.h"

#include <algorithm>

#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

// Checks call cycles and call depth.

void ProcedureCalls::check(const SourceProgram& program, Diagnostics& diagnostics) const {
  const CallGraph::Order order = graph_.order();
  const auto nameOf = [&](uint32_t procedure) { return std::string(program.procedures[procedure].name); };
  for (const CallGraph::Cycle& cycle : order.cycles)
    diagnostics.report(diag::RecursiveProcedure, cycle.call.range)
        << program.procedures[cycle.call.callee].name << CallGraph::throughText(cycle, nameOf);
  if (order.cycles.empty()) checkDepth(order.calleesFirst, diagnostics);
}

void ProcedureCalls::checkDepth(std::span<const uint32_t> calleesFirst, Diagnostics& diagnostics) const {
  constexpr uint32_t kMaxDepth = RUNG_STACK_DEPTH - 8;
  std::vector<uint32_t> depth(calleesFirst.size(), 1); // call depth including the callees
  for (const uint32_t caller : calleesFirst)
    for (const CallGraph::Call& call : graph_.of(caller)) {
      depth[caller] = std::max(depth[caller], depth[call.callee] + 1);
      if (depth[caller] == kMaxDepth) diagnostics.report(diag::TooDeep, call.range) << "procedure calls" << kMaxDepth;
    }
}

// Contents of the registers.

void LostRegisters::reportIf(bool& lost, bool reads, const Statement& statement, std::string_view name) {
  if (!lost || !reads) return;
  diagnostics_.report(diag::ValueNotPreserved, statement.range()) << name;
  lost = false;
}

void LostRegisters::begin(const Statement& statement, bool readsDr) {
  reportIf(rlo_, (statement.row->effects & kReadsRlo) != 0, statement, "RLO");
  reportIf(dr_, readsDr, statement, "DR");
}

void LostRegisters::finish(const Row& row, bool waits) {
  if (waits) {
    rlo_ = true;
    dr_ = (row.effects & kKeepsDr) == 0;
  }
  if (row.effects & kSetsRlo) rlo_ = false;
  if (row.effects & kSetsDr) dr_ = false;
}

void Mixing::note(DrUse kind, const Statement& statement) {
  switch (kind) {
  case DrUse::LoadInteger: state_ = State::No; return;
  case DrUse::LoadReal: state_ = State::Real; return;
  case DrUse::Integer:
    if (state_ != State::Real) return;
    state_ = State::IntegerOnReal;
    integer_ = &statement;
    return;
  case DrUse::Real:
    if (state_ == State::IntegerOnReal)
      diagnostics_.report(diag::MixedRealInteger, integer_->range())
              .note(statement.range(), "this works on the real value again")
          << integer_->row->info.mnemonic;
    state_ = State::Real;
    return;
  }
}

} // namespace rung::frontend::technol
