// Units and networks as text.
#include "frontend/network/program.h"

#include <fmt/format.h>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

std::string textOf(const Language& language, const Param& param) {
  return param.isAddress ? textOf(language, param.address)
                         : fmt::format(fmt::runtime(param.kind->written), param.value);
}

} // namespace

Command commandOf(Logic kind, Contact contact) {
  constexpr Command kOpen[] = {Command::Load, Command::And, Command::Or, Command::OrBlock, Command::AndBlock};
  constexpr Command kClosed[] = {Command::LoadNot, Command::AndNot, Command::OrNot};
  if (contact == Contact::Falling) return Command::LoadFalling;
  return contact == Contact::Closed ? kClosed[static_cast<size_t>(kind)] : kOpen[static_cast<size_t>(kind)];
}

Logic logicOf(Command command) {
  constexpr Logic kLogic[] = {Logic::Load, Logic::Load, Logic::And,     Logic::And,     Logic::Or,
                              Logic::Or,   Logic::Load, Logic::OrBlock, Logic::AndBlock};
  return kLogic[static_cast<size_t>(command)];
}

std::vector<Logic> logicOf(std::span<const Written> commands) {
  std::vector<Logic> result;
  for (const Written& written : commands)
    if (isLogic(written.command)) result.push_back(logicOf(written.command));
  return result;
}

std::optional<bool> constantCondition(const Language& language, const Network& network, size_t condition) {
  std::vector<const LogicStep*> stack; // null: a value of several contacts
  for (const LogicStep& step : network.logic) {
    const bool isBlock = step.kind == Logic::OrBlock || step.kind == Logic::AndBlock;
    if (step.kind == Logic::Load)
      stack.push_back(&step);
    else if (isBlock && !stack.empty())
      stack.pop_back();
    if (step.kind != Logic::Load && !stack.empty()) stack.back() = nullptr;
  }
  if (condition >= stack.size() || stack[condition] == nullptr || language.constantOf == nullptr) return std::nullopt;
  const LogicStep& contact = *stack[condition];
  const std::optional<bool> bit = language.constantOf(language, contact.bit);
  if (!bit || contact.contact == Contact::Falling) return std::nullopt;
  return *bit != (contact.contact == Contact::Closed);
}

std::string nameOf(const Language& language, const Unit& unit) {
  if (unit.kind == UnitKind::Subprogram) return language.numbered(Control::Sp, unit.number);
  return std::string(language.levels[unit.number].name);
}

Program::Program(const Language& language) {
  for (uint32_t level = 0; level < language.levels.size(); ++level)
    units.push_back({.kind = UnitKind::Level, .number = level});
}

std::string commandText(const Language& language, const Network& network) {
  std::string text;
  const auto line = [&](Command command, std::string_view operand) {
    text += language.nameOf(command);
    if (!operand.empty()) (text += ' ') += operand;
    text += '\n';
  };
  for (const LogicStep& step : network.logic) {
    const bool isBlock = step.kind == Logic::OrBlock || step.kind == Logic::AndBlock;
    line(commandOf(step.kind, step.contact), isBlock ? std::string() : textOf(language, step.bit));
  }
  if (network.function.row != nullptr) {
    line(Command::Function, fmt::format("{}", network.function.row->info.number));
    for (const Param& param : network.function.params) line(Command::Parameter, textOf(language, param));
    for (int64_t row : network.function.table) line(Command::Table, fmt::format("{}", row));
  }
  for (const CoilStep& coil : network.coils) line(commandOf(coil.kind), textOf(language, coil.bit));
  return text;
}

std::string identityOf(const Language& language, const SourceManager& sources, const Function& function) {
  // An operand with a symbol is identified by the symbol, whose address may change.
  const auto written = [&](const Param& param) {
    std::string_view word = text::trimmed(sources.text(param.range));
    if (word.size() > 2 && word.front() == '"') word = word.substr(1, word.size() - 2); // a name in a drawing
    return !param.isAddress || word.empty() || splitAddress(language, word) ? textOf(language, param)
                                                                            : text::upper(word);
  };
  std::string text(function.row->info.mnemonic);
  for (const Param& param : function.params) {
    (text += ' ') += written(param);
    if (function.row->numbers != Row::Numbers::Free) break;
  }
  return text;
}

} // namespace rung::frontend::network
