// The equation and its stack (see equation.h).
#include "frontend/dialects/technol/check/equation.h"

#include <algorithm>

#include "ir/support/diag/operand.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

// Values beyond the stack's end are lost; that is reported once, also where they are taken off.
void Equation::loadRlo(SourceRange at, StackUse& use) {
  use.begins = !open_;
  if (!open_) {
    begin_ = at;
  } else if (depth_ < kStackDepth) {
    use.pushed = depth_++;
  } else if (lost_++ == 0) {
    diagnostics_.report(diag::StackOverflow, at) << kStackDepth;
  }
}

uint32_t Equation::pop(const Statement& statement) {
  if (depth_ != 0) return --depth_;
  if (lost_ > 0)
    --lost_;
  else
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
  use.depth = depth_;
  return use;
}

// A macro that pushes does so before its statements, as LDR before its load.
StackUse Equation::beginMacro(const Statement& statement) {
  macros_.push_back({depth_, open_, diagnostics_.errorCount()});
  StackUse use;
  if (static_cast<MacroStack>(statement.row->variant) != MacroStack::Push) return use;
  loadRlo(statement.range(), use);
  open_ = false;
  return use;
}

void Equation::endMacro(const Statement& statement) {
  if (macros_.empty()) return;
  const auto [depth, open, errors] = macros_.back();
  macros_.pop_back();
  switch (static_cast<MacroStack>(statement.row->variant)) {
  case MacroStack::Normal: return;
  case MacroStack::Begin: depth_ = 0; return;
  case MacroStack::End: depth_ = depth, open_ = false; return;
  case MacroStack::Push: depth_ = std::min(depth + (open ? 1 : 0), kStackDepth), open_ = true; return;
  case MacroStack::Pop:
    if (depth == 0 && diagnostics_.errorCount() == errors)
      diagnostics_.report(diag::StackUnderflow, statement.range()) << statement.row->info.mnemonic;
    depth_ = depth == 0 ? 0 : depth - 1, open_ = open;
    return;
  }
}

void Equation::checkBalance(SourceRange at, std::string_view where) {
  if (depth_ != 0)
    diagnostics_.report(diag::UnbalancedStack, at) << std::to_string(depth_) +
                                                          (depth_ == 1 ? " value is" : " values are") +
                                                          " left on the stack at " + std::string(where);
  else if (open_ && !hasUnknown_)
    diagnostics_.report(diag::UnterminatedEquation, begin_).note(at, "it is still open here");
  depth_ = 0;
  lost_ = 0;
}

void Equation::end(SourceRange at, std::string_view where) {
  checkBalance(at, where);
  open_ = false;
}

} // namespace rung::frontend::technol
