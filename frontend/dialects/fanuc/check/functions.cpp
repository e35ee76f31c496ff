// See functions.h.
#include "frontend/dialects/fanuc/check/functions.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/language.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::fanuc {
namespace {

// The parameter with this index, if it is there and right; otherwise null.
const network::Param* goodParam(const network::Function& function, size_t i) {
  return i < function.params.size() && !function.params[i].bad ? &function.params[i] : nullptr;
}

constexpr int64_t kGroups = 4;          // of a path (inventory §6.10)
constexpr int64_t kGroupsOfPath = 1000; // path p adds 1000(p-1) to a group

} // namespace

// The simulated CNC has path 1.
void checkAxisGroup(network::Context& context, const network::Network& network) {
  const network::Param* group = goodParam(network.function, 0);
  if (group == nullptr) return;
  const int64_t number = group->value % kGroupsOfPath;
  if (number < 1 || number > kGroups)
    context.diagnostics.report(diag::ParameterOutOfRange, group->range)
        << group->value << "1 to 4, with path - 1 in the thousands" << network.function.row->info.mnemonic;
  else if (context.isSimulated && group->value >= kGroupsOfPath)
    context.diagnostics.report(diag::NotSimulated, group->range)
        << fmt::format("group {}", group->value) << group->value / kGroupsOfPath + 1;
}

// NNDD: the digit that is not compared is 0 (inventory §6.4).
void checkDecodedDigits(network::Context& context, const network::Network& network) {
  const network::Param* decoded = goodParam(network.function, 1);
  if (decoded == nullptr) return;
  const int64_t digits = decoded->value / 100, which = decoded->value % 100;
  const bool isLow = which == 1 && digits < 10, isHigh = which == 10 && digits % 10 == 0;
  if (isLow || isHigh || which == 11) return;
  context.diagnostics.report(diag::ParameterOutOfRange, decoded->range)
      << decoded->value << "NNDD with DD = 01 (low digit, the other one 0 in NN), 10 (high) or 11 (both)"
      << network.function.row->info.mnemonic;
}

// Of a fixed timer; older types have less than the row says (inventory §6.2).
void checkPreset(network::Context& context, const network::Network& network) {
  const network::Param* preset = goodParam(network.function, 1);
  const int64_t most = limitsOf(pmcOf(context.language)).mostPresetMs();
  if (preset == nullptr || preset->value <= most) return;
  context.diagnostics.report(diag::ParameterOutOfRange, preset->range)
      << preset->value << fmt::format("0 to {}", most) << network.function.row->info.mnemonic;
}

// Constants of more than two digits where BYT is always 0: that of NUME, the rows of COD.
void checkCut(network::Context& context, const network::Network& network) {
  constexpr int64_t kMost = 99;
  const network::Function& function = network.function;
  const auto cut = [&](int64_t value, SourceRange range) {
    if (value > kMost) context.diagnostics.report(diag::ConstantCut, range) << value << "1 byte";
  };
  if (constantCondition(context.language, network, 0) != false) return;
  if (!function.table.empty()) return cut(std::ranges::max(function.table), function.range);
  if (const network::Param* constant = goodParam(function, 0)) cut(constant->value, constant->range);
}

} // namespace rung::frontend::fanuc
