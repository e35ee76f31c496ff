// What the registers hold (see registers_kept.h).
#include "frontend/dialects/technol/check/registers_kept.h"

#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

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
