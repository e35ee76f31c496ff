// The equation and its stack (see equation.h).
#include "frontend/dialects/technol/check/equation.h"

#include <utility>

#include "ir/support/diag/operand.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

// Loads RLO, pushing its old value. Values beyond the stack's end are lost; the overflow is reported once, and their
// pops are not reported.
void Equation::loadRlo(SourceRange at, StackUse& use) {
  use.begins = !open_;
  if (!open_) {
    begin_ = at;
  } else if (depth() < kStackDepth) {
    use.pushed = depth();
    stored_.push_back(at);
  } else if (lost_++ == 0) {
    diagnostics_.report(diag::StackOverflow, at) << kStackDepth;
  }
}

uint32_t Equation::pop(const Statement& statement) {
  if (!stored_.empty()) {
    stored_.pop_back();
    return depth();
  }
  if (lost_ > 0)
    --lost_;
  else if (!lostTrack_)
    diagnostics_.report(diag::StackUnderflow, statement.range()) << statement.row->info.mnemonic;
  return kNone;
}

StackUse Equation::begin(const Statement& statement) {
  StackUse use;
  if (statement.row->effects & kPushes) {
    loadRlo(statement.range(), use);
    hasUnknown_ = hasUnknown_ && open_;
    open_ = true;
  }
  if ((statement.row->effects & kJoins) && statement.tokenCount == 0) use.popped = pop(statement);
  use.depth = depth();
  return use;
}

// A macro that pushes does so before its statements, like LDR before its load.
StackUse Equation::beginMacro(const Statement& statement) {
  macros_.push_back({stored_, open_, diagnostics_.errorCount()});
  StackUse use;
  if (static_cast<MacroStack>(statement.row->variant) != MacroStack::Push) return use;
  loadRlo(statement.range(), use);
  open_ = false;
  return use;
}

void Equation::endMacro(const Statement& statement) {
  if (macros_.empty()) return;
  const MacroState before = std::move(macros_.back());
  macros_.pop_back();
  switch (static_cast<MacroStack>(statement.row->variant)) {
  case MacroStack::Normal: return;
  case MacroStack::Begin: stored_.clear(); return;
  case MacroStack::End: stored_ = before.stored, open_ = false; return;
  case MacroStack::Push:
    stored_ = before.stored;
    if (before.open && depth() < kStackDepth) stored_.push_back(statement.range());
    open_ = true;
    return;
  case MacroStack::Pop:
    stored_ = before.stored;
    open_ = before.open;
    if (!stored_.empty())
      stored_.pop_back();
    else if (diagnostics_.errorCount() == before.errors)
      diagnostics_.report(diag::StackUnderflow, statement.range()) << statement.row->info.mnemonic;
    return;
  }
}

void Equation::checkBalance(SourceRange at, std::string_view where) {
  if (!stored_.empty() && !lostTrack_)
    diagnostics_.report(diag::UnbalancedStack, at).note(stored_.back(), "this stored a value that nothing takes")
        << std::to_string(depth()) + (depth() == 1 ? " value is" : " values are") + " left on the stack at " +
               std::string(where);
  else if (open_ && !hasUnknown_)
    diagnostics_.report(diag::UnterminatedEquation, begin_).note(at, "it is still open here");
  stored_.clear();
  lost_ = 0;
  lostTrack_ = false;
}

void Equation::end(SourceRange at, std::string_view where) {
  checkBalance(at, where);
  open_ = false;
}

} // namespace rung::frontend::technol
