// See targets.h.
#include "tools/view/targets.h"

#include "rtlib/text/letters.h"

namespace rung::view {

TargetRole roleOf(const frontend::InstructionInfo& row, const frontend::OperandInfo& operand) {
  if (operand.kind != "label" && operand.kind != "subprogram") return TargetRole::None;
  // The rows that mark a place; all others go there.
  constexpr std::string_view kMarks[] = {"LBL", "JME", "SBN"};
  for (std::string_view mark : kMarks)
    if (row.mnemonic == mark) return TargetRole::Defines;
  return TargetRole::Asks;
}

uint32_t Targets::idOf(std::string_view module, std::string_view operand) {
  std::string key = std::string(module) + '\n';
  size_t at = 0;
  for (; at < operand.size() && (operand[at] < '0' || operand[at] > '9'); ++at) key += text::upper(operand[at]);
  while (at + 1 < operand.size() && operand[at] == '0') ++at;
  key += operand.substr(at);
  const auto [found, fresh] = ids_.emplace(std::move(key), static_cast<uint32_t>(targets_.size()));
  if (fresh) targets_.emplace_back();
  return found->second;
}

void Targets::ask(uint32_t id, uint32_t rung) {
  std::vector<uint32_t>& callers = targets_[id].callers;
  if (callers.empty() || callers.back() != rung) callers.push_back(rung);
}

} // namespace rung::view
