// State of instructions (see state.h).
#include "frontend/dialects/technol/lower/state.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

std::string instructionKey(const Program& program, const Statement& statement, std::string_view mnemonic) {
  std::string key(mnemonic);
  for (const Token& token : program.operandTokens(statement))
    key += token.is(',') ? ',' : ' ', key += symbolKey(token.text);
  return key;
}

// The key with a number where several are alike.
std::string State::numbered(std::string key) {
  if (const uint32_t number = names_[key]++; number != 0) key += "#" + std::to_string(number);
  return key;
}

// The key names module, instruction and operands.
ir::SlotId State::newSlot(Type type, const Statement& statement, std::string_view what) {
  const Program& program = m_.program();
  const std::string unit(program.units[statement.unit].name);
  automatic_.push_back(m_.newSlot(type, numbered(unit + "." + instructionKey(program, statement, what))));
  return automatic_.back();
}

void State::nameCells(std::string key, ir::SpaceId space, uint32_t byte, Type type, uint32_t count) {
  m_.module().symbols.push_back({.name = numbered(std::move(key)),
                                 .space = space,
                                 .byte = byte,
                                 .type = ir::abiType(type),
                                 .count = count,
                                 .flags = RUNG_SYMBOL_HIDDEN});
}

CountCell State::countCell(const Operand& operand, const Statement& statement) {
  if (operand.given()) return {.automatic = false, .slot = {}, .access = m_.reach(operand), .type = operand.type};
  const ir::SlotId slot = newSlot(Type::I16, statement, statement.row->info.mnemonic);
  addTimer(slot);
  return {.automatic = true, .slot = slot, .access = {}, .type = Type::I16};
}

ValueId State::load(const CountCell& cell) {
  return cell.automatic ? m_.b().slotLoad(cell.slot) : m_.load(cell.access, cell.type);
}

void State::store(const CountCell& cell, ValueId value) {
  if (cell.automatic)
    m_.b().slotStore(cell.slot, value);
  else
    m_.store(cell.access, value);
}

} // namespace rung::frontend::technol
