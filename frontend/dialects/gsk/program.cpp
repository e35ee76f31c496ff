// A network as text.
#include "frontend/dialects/gsk/program.h"

#include <array>

#include <fmt/format.h>

namespace rung::gsk {
namespace {

std::string_view commandOf(const LogicStep& step) {
  switch (step.kind) {
  case Logic::Load: return step.negated ? "LDI" : "LD";
  case Logic::And: return step.negated ? "ANI" : "AND";
  case Logic::Or: return step.negated ? "ORI" : "OR";
  case Logic::OrBlock: return "ORB";
  case Logic::AndBlock: return "ANB";
  }
  return {};
}

std::string_view commandOf(Coil kind) {
  switch (kind) {
  case Coil::Out: return "OUT";
  case Coil::OutInverted: return "OUTI";
  case Coil::Set: return "SET";
  case Coil::Reset: return "RST";
  }
  return {};
}

std::string textOf(const Param& param) {
  if (param.isAddress) return textOf(param.address);
  switch (param.kind) {
  case Kind::Mask: return fmt::format("{:04b}", param.value);
  case Kind::Label: return fmt::format("L{}", param.value);
  case Kind::Subprogram: return fmt::format("P{}", param.value);
  case Kind::FormatA: return fmt::format("{:04}", param.value);
  case Kind::Bit:
  case Kind::Coil:
  case Kind::Format:
  case Kind::Byte:
  case Kind::Word:
  case Kind::Dword:
  case Kind::Data:
  case Kind::Block:
  case Kind::Constant:
  case Kind::ConstantOrData:
  case Kind::Number:
  case Kind::DataTable:
  case Kind::WorkArea: return fmt::format("{}", param.value);
  }
  return {};
}

} // namespace

std::string commandText(const Network& network) {
  std::string text;
  const auto line = [&](std::string_view command, std::string_view operand) {
    text += command;
    if (!operand.empty()) (text += ' ') += operand;
    text += '\n';
  };
  for (const LogicStep& step : network.logic) {
    const bool isBlock = step.kind == Logic::OrBlock || step.kind == Logic::AndBlock;
    line(commandOf(step), isBlock ? std::string() : textOf(step.bit));
  }
  if (network.function.row != nullptr) {
    line("FUNC", fmt::format("{}", network.function.row->info.number));
    for (const Param& param : network.function.params) line("PRM", textOf(param));
    for (int64_t row : network.function.table) line("TABLE", fmt::format("{}", row));
  }
  for (const CoilStep& coil : network.coils) line(commandOf(coil.kind), textOf(coil.bit));
  return text;
}

} // namespace rung::gsk
