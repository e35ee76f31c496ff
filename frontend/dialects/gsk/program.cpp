// A network as text.
#include "frontend/dialects/gsk/program.h"

#include <array>

#include <fmt/format.h>

namespace rung::gsk {
namespace {

std::string textOf(const Param& param) {
  return param.isAddress ? textOf(param.address) : fmt::format(fmt::runtime(param.kind->written), param.value);
}

} // namespace

Command commandOf(Logic kind, bool negated) {
  switch (kind) {
  case Logic::Load: return negated ? Command::Ldi : Command::Ld;
  case Logic::And: return negated ? Command::Ani : Command::And;
  case Logic::Or: return negated ? Command::Ori : Command::Or;
  case Logic::OrBlock: return Command::Orb;
  case Logic::AndBlock: return Command::Anb;
  }
  return Command::Ld;
}

Logic logicOf(Command command) {
  switch (command) {
  case Command::Ld:
  case Command::Ldi: return Logic::Load;
  case Command::And:
  case Command::Ani: return Logic::And;
  case Command::Or:
  case Command::Ori: return Logic::Or;
  case Command::Orb: return Logic::OrBlock;
  case Command::Anb: return Logic::AndBlock;
  case Command::Out:
  case Command::Outi:
  case Command::Set:
  case Command::Rst:
  case Command::Func:
  case Command::Prm:
  case Command::Table:
  case Command::Dialect:
  case Command::Symbol:
  case Command::Const: break;
  }
  return Logic::Load;
}

Command commandOf(Coil kind) {
  switch (kind) {
  case Coil::Out: return Command::Out;
  case Coil::OutInverted: return Command::Outi;
  case Coil::Set: return Command::Set;
  case Coil::Reset: return Command::Rst;
  }
  return Command::Out;
}

std::string commandText(const Network& network) {
  std::string text;
  const auto line = [&](Command command, std::string_view operand) {
    text += nameOf(command);
    if (!operand.empty()) (text += ' ') += operand;
    text += '\n';
  };
  for (const LogicStep& step : network.logic) {
    const bool isBlock = step.kind == Logic::OrBlock || step.kind == Logic::AndBlock;
    line(commandOf(step.kind, step.negated), isBlock ? std::string() : textOf(step.bit));
  }
  if (network.function.row != nullptr) {
    line(Command::Func, fmt::format("{}", network.function.row->info.number));
    for (const Param& param : network.function.params) line(Command::Prm, textOf(param));
    for (int64_t row : network.function.table) line(Command::Table, fmt::format("{}", row));
  }
  for (const CoilStep& coil : network.coils) line(commandOf(coil.kind), textOf(coil.bit));
  return text;
}

std::string identityOf(const Function& function) {
  std::string text(function.row->info.mnemonic);
  for (const Param& param : function.params) {
    (text += ' ') += textOf(param);
    if (function.row->numbers != Row::Numbers::Free) break;
  }
  return text;
}

} // namespace rung::gsk
