// State of instructions (see state.h).
#include "frontend/dialects/technol/lower/state.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

std::string instructionKey(const SourceProgram& program, const Statement& statement, std::string_view mnemonic) {
  std::string key(mnemonic);
  for (const Token& token : program.operandTokens(statement))
    key += token.is(',') ? ',' : ' ', key += symbolKey(token.text);
  return key;
}

// The key names module, instruction and operands.
ir::SlotId State::newSlot(Type type, const Statement& statement, std::string_view what) {
  const std::string unit(program_.at(statement.unit).name);
  automatic_.push_back(emitter_.newSlot(type, names_.numbered(unit + "." + instructionKey(program_, statement, what))));
  return automatic_.back();
}

CountCell State::countCell(const Operand& operand, const Statement& statement) {
  if (operand.given()) return {.automatic = false, .slot = {}, .access = memory_.reach(operand), .type = operand.type};
  const ir::SlotId slot = newSlot(Type::I16, statement, statement.row->info.mnemonic);
  addTimer(slot);
  return {.automatic = true, .slot = slot, .access = {}, .type = Type::I16};
}

ValueId State::load(const CountCell& cell) {
  return cell.automatic ? emitter_.b().slotLoad(cell.slot) : memory_.load(cell.access, cell.type);
}

void State::store(const CountCell& cell, ValueId value) {
  if (cell.automatic)
    emitter_.b().slotStore(cell.slot, value);
  else
    memory_.store(cell.access, value);
}

} // namespace rung::frontend::technol
