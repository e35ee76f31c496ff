// Checks of the number of operands (see operand_count.h).
#include "frontend/sema/operand_count.h"

#include <algorithm>

#include "ir/support/diag/operand.h"

namespace rung::frontend {
namespace {

std::string countText(size_t least, size_t most, bool repeated) {
  if (most == 0) return "no operands";
  if (repeated) return std::to_string(least) + " or more operands";
  std::string text = std::to_string(most);
  if (least == 0)
    text = "at most " + text;
  else if (least < most)
    text = std::to_string(least) + (most == least + 1 ? " or " : " to ") + text;
  return text + (most == 1 ? " operand" : " operands");
}

std::string listed(std::span<const OperandInfo> operands) {
  std::string names;
  for (const OperandInfo& operand : operands) {
    const std::string name(operand.name);
    names += (names.empty() ? "" : ", ") + (operand.optional ? "[" + name + "]" : name);
    if (operand.repeated) names += ", ...";
  }
  return names;
}

} // namespace

std::string operandOrder(const InstructionInfo& info) {
  return "its operands in order: " + listed(info.operands.all());
}

bool countFits(const InstructionInfo& info, size_t found, SourceRange at, Diagnostics& diagnostics,
               std::string_view note) {
  const std::span<const OperandInfo> operands = info.operands.all();
  const auto least = static_cast<size_t>(std::ranges::count(operands, false, &OperandInfo::optional));
  const bool repeated = !operands.empty() && operands.back().repeated;
  if (found >= least && (found <= operands.size() || repeated)) return true;
  DiagBuilder report = diagnostics.report(diag::OperandCount, at);
  report << info.mnemonic << countText(least, operands.size(), repeated) << found;
  if (!operands.empty())
    report.note(operandOrder(info) + (least < operands.size() ? "; those in brackets may be left out" : ""));
  if (found + 1 == least && !operands[found].doc.empty())
    report.note(std::string(operands[found].name) + ": " + std::string(operands[found].doc));
  if (!note.empty()) report.note(note);
  return false;
}

} // namespace rung::frontend
