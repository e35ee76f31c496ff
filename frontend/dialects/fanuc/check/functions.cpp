// See functions.h.
#include "frontend/dialects/fanuc/check/functions.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/language.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/operand.h"

namespace rung::frontend::fanuc {
namespace {

// The parameter with this index, if it is there and right; otherwise null.
const network::Param* goodParam(const network::Function& function, size_t i) {
  return i < function.params.size() && !function.params[i].bad ? &function.params[i] : nullptr;
}

// A group of AXCTL has its path in the thousands; the simulated CNC has path 1.
void checkPath(network::Context& context, const network::Function& function) {
  const network::Param* group = goodParam(function, 0);
  if (group == nullptr || group->value < 1000) return;
  context.diagnostics.report(diag::NotSimulated, group->range)
      << fmt::format("group {}", group->value) << group->value / 1000 + 1;
}

// Of a fixed timer; older types have less than the row says (inventory §6.2).
void checkPreset(network::Context& context, const network::Function& function) {
  const network::Param* preset = goodParam(function, 1);
  const int64_t most = limitsOf(pmcOf(context.language)).mostPresetMs();
  if (preset == nullptr || preset->value <= most) return;
  context.diagnostics.report(diag::ParameterOutOfRange, preset->range)
      << preset->value << fmt::format("0 to {}", most) << function.row->info.mnemonic;
}

// A table and the data beside it may be inputs where a constant condition says that they are only read.
void checkDirection(network::Context& context, const network::Network& network) {
  const network::Function& function = network.function;
  const auto condition = static_cast<size_t>(function.row->direction);
  const std::optional<bool> writes = constantCondition(context.language, network, condition);
  bool isTable = true; // the first one of the two
  for (size_t i = 0; i < function.params.size(); ++i) {
    if (function.row->info.operands[i].access != frontend::Access::ReadWrite) continue;
    const bool isOnlyRead = writes && *writes != isTable;
    if (const network::Param* param = goodParam(function, i); param != nullptr && !isOnlyRead)
      checkWritable(context, param->address, param->bytes, param->range);
    isTable = false;
  }
}

// Constants of more than two digits where BYT is always 0: that of NUME, the rows of COD.
void checkCut(network::Context& context, const network::Network& network) {
  constexpr int64_t kMost = 99;
  const network::Function& function = network.function;
  const auto cut = [&](int64_t value, SourceRange range) {
    if (value > kMost) context.diagnostics.report(diag::ConstantCut, range) << value << 1;
  };
  if (constantCondition(context.language, network, 0) != false) return;
  if (!function.table.empty()) return cut(std::ranges::max(function.table), function.range);
  if (const network::Param* constant = goodParam(function, 0)) cut(constant->value, constant->range);
}

} // namespace

void checkFunctions(network::Context& context, const network::Program& program, bool isSimulated) {
  for (const network::Unit& unit : program.units)
    for (const network::Network& network : unit.networks) {
      if (network.function.row == nullptr) continue;
      const std::string_view mnemonic = network.function.row->info.mnemonic;
      if (mnemonic == "AXCTL" && isSimulated) checkPath(context, network.function);
      if (mnemonic == "TMRB" || mnemonic == "TMRBF") checkPreset(context, network.function);
      if (mnemonic == "NUME" || mnemonic == "COD") checkCut(context, network);
      if (network.function.row->direction >= 0) checkDirection(context, network);
    }
}

} // namespace rung::frontend::fanuc
