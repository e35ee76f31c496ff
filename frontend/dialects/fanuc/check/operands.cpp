// See operands.h.
#include "frontend/dialects/fanuc/check/operands.h"

#include "ir/support/diag/pmc.h"

namespace rung::frontend::fanuc {

// Four groups a path (inventory §6.10).
void checkAxisGroup(const network::Function& function, Diagnostics& diagnostics) {
  if (function.params.empty() || function.params[0].bad) return;
  const network::Param& group = function.params[0];
  if (const int64_t number = group.value % 1000; number >= 1 && number <= 4) return;
  diagnostics.report(diag::ParameterOutOfRange, group.range)
      << group.value << "1 to 4, with path - 1 in the thousands" << function.row->info.mnemonic;
}

// NNDD: the digit that is not compared is 0 (inventory §6.4).
void checkDecodedDigits(const network::Function& function, Diagnostics& diagnostics) {
  if (function.params.size() < 2 || function.params[1].bad) return;
  const network::Param& decoded = function.params[1];
  const int64_t digits = decoded.value / 100, which = decoded.value % 100;
  const bool isLow = which == 1 && digits < 10, isHigh = which == 10 && digits % 10 == 0;
  if (isLow || isHigh || which == 11) return;
  diagnostics.report(diag::ParameterOutOfRange, decoded.range)
      << decoded.value << "NNDD with DD = 01 (low digit, the other one 0 in NN), 10 (high) or 11 (both)"
      << function.row->info.mnemonic;
}

} // namespace rung::frontend::fanuc
