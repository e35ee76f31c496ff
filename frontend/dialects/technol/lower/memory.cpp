// Accesses to cells and bits.
#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

MemoryAccess Memory::reach(const Operand& operand, ValueId guard) {
  MemoryAccess access{.place = operand.place, .indexed = operand.indexed, .window = {}, .index = {}};
  if (!operand.indexed) return access;
  ir::RungBuilder& b = emitter_.b();
  const uint32_t bytes = bytesOf(operand.place.space);
  const uint32_t width = operand.type == Type::Bit || operand.type == Type::None ? 1 : ir::byteWidth(operand.type);
  ValueId index = emitter_.r().bx();
  if (operand.scale != 1) index = b.mul(index, b.i32(operand.scale));
  if (operand.offset != 0 || emitter_.isCompared()) index = b.add(index, placeIn(operand, operand.offset));
  // BX has 16 bits: addresses in a segment of 64 kB wrap around, which allows negative indices.
  if (bytes <= 0x10000) index = b.and_(index, b.i32(0xFFFF));
  access.window = {.space = operand.place.space, .byte = 0, .count = bytes >= width ? bytes - width + 1 : 0};
  access.index = index;
  ValueId outside = b.leU(emitter_.given(Type::I32, access.window.count), index);
  if (guard.valid()) outside = b.and_(guard, outside);
  emitter_.protect(outside);
  return access;
}

ValueId Memory::load(const MemoryAccess& access, Type type) {
  ir::RungBuilder& b = emitter_.b();
  if (!access.indexed) return b.load(type, access.place);
  if (type == Type::Bit) return b.loadBitAt(access.window, access.index, b.i32(access.place.bit));
  return b.loadAt(type, access.window, access.index);
}

void Memory::store(const MemoryAccess& access, ValueId value) {
  ir::RungBuilder& b = emitter_.b();
  if (!access.indexed)
    b.store(access.place, value);
  else if (b.typeOf(value) == Type::Bit)
    b.storeBitAt(access.window, access.index, b.i32(access.place.bit), value);
  else
    b.storeAt(access.window, access.index, value);
}

ValueId Memory::bit(const Operand& operand) {
  const ValueId value = load(reach(operand), Type::Bit);
  return operand.negated ? emitter_.b().not_(value) : value;
}

ValueId Memory::value(const Operand& operand, ValueId guard) {
  if (operand.form == Operand::Form::Real) return emitter_.b().real(operand.real);
  if (operand.form == Operand::Form::Integer) return emitter_.b().constant(operand.type, operand.value);
  return load(reach(operand, guard), operand.type);
}

// State of instructions.

using ir::Type;
using ir::ValueId;

std::string instructionKey(const SourceProgram& program, const Statement& statement, std::string_view mnemonic) {
  std::string key(mnemonic);
  for (const Token& token : program.operandTokens(statement))
    key += token.is(',') ? ',' : ' ', key += symbolKey(token.text);
  return key;
}

// A slot whose key names module, instruction and operands.
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
