// How operations reach memory: cells, bits, indices by BX, counts and the compiler's own slots.
#include "frontend/dialects/technol/lower/lowering.h"
#include "rtlib/nc/faults.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

Access Lowering::reach(const Operand& operand, ValueId guard) {
  Access access{.place = operand.place, .indexed = operand.indexed, .window = {}, .index = {}};
  if (!operand.indexed) return access;
  ir::RungBuilder& builder = b();
  const uint32_t bytes = bytesOf(operand.place.space);
  const uint32_t width = operand.type == Type::Bit || operand.type == Type::None ? 1 : ir::byteWidth(operand.type);
  ValueId index = r().bx();
  if (operand.scale != 1) index = builder.mul(index, builder.i32(operand.scale));
  if (operand.value != 0) index = builder.add(index, builder.i32(operand.value));
  // BX has 16 bits: addresses of a segment of 64 kB wrap around, so that an index may be negative.
  if (bytes <= 0x10000) index = builder.and_(index, builder.i32(0xFFFF));
  access.window = {.space = operand.place.space, .byte = 0, .count = bytes >= width ? bytes - width + 1 : 0};
  access.index = index;
  ValueId outside = builder.leU(builder.i32(access.window.count), index);
  if (guard.valid()) outside = builder.and_(guard, outside);
  protect(outside);
  return access;
}

ValueId Lowering::load(const Access& access, Type type) {
  if (!access.indexed) return b().load(type, access.place);
  if (type == Type::Bit) return b().loadBitAt(access.window, access.index, b().i32(access.place.bit));
  return b().loadAt(type, access.window, access.index);
}

void Lowering::store(const Access& access, ValueId value) {
  if (!access.indexed)
    b().store(access.place, value);
  else if (b().typeOf(value) == Type::Bit)
    b().storeBitAt(access.window, access.index, b().i32(access.place.bit), value);
  else
    b().storeAt(access.window, access.index, value);
}

ValueId Lowering::bit(const Operand& operand) {
  const ValueId value = load(reach(operand), Type::Bit);
  return operand.negated ? b().not_(value) : value;
}

ValueId Lowering::value(const Operand& operand, ValueId guard) {
  if (operand.form == Operand::Form::Real) return b().real(operand.real);
  if (operand.form == Operand::Form::Integer) return b().constant(operand.type, operand.value);
  return load(reach(operand, guard), operand.type);
}

std::string Lowering::instructionKey(std::string_view mnemonic) const {
  std::string key(mnemonic);
  for (const Token& token : program_.operandTokens(*statement_))
    key += token.is(',') ? ',' : ' ', key += symbolKey(token.text);
  return key;
}

// The key names module, instruction and operands, with a number where several are alike.
ir::SlotId Lowering::newSlot(Type type, std::string_view what) {
  std::string key = std::string(program_.units[statement_->unit].name) + "." + instructionKey(what);
  const uint32_t number = slotNames_[key]++;
  if (number != 0) key += "#" + std::to_string(number);
  module_.slots.push_back({.type = type, .key = std::move(key)});
  automatic_.push_back({static_cast<uint32_t>(module_.slots.size()) - 1});
  return automatic_.back();
}

void Lowering::nameCells(std::string key, ir::SpaceId space, uint32_t byte, Type type, uint32_t count) {
  if (const uint32_t number = slotNames_[key]++; number != 0) key += "#" + std::to_string(number);
  module_.symbols.push_back({.name = std::move(key),
                             .space = space,
                             .byte = byte,
                             .type = ir::abiType(type),
                             .count = count,
                             .flags = RUNG_SYMBOL_HIDDEN});
}

void Lowering::protect(ValueId bad) { b().trap(bad, fault(nc::kTechnolProtection)); }

CountCell Lowering::countCell(const Operand& operand) {
  if (operand.given()) return {.automatic = false, .slot = {}, .access = reach(operand), .type = operand.type};
  timers_.push_back(newSlot(Type::I16, statement_->row->info.mnemonic));
  return {.automatic = true, .slot = timers_.back(), .access = {}, .type = Type::I16};
}

ValueId Lowering::loadCount(const CountCell& cell) {
  return cell.automatic ? b().slotLoad(cell.slot) : load(cell.access, cell.type);
}

void Lowering::storeCount(const CountCell& cell, ValueId value) {
  if (cell.automatic)
    b().slotStore(cell.slot, value);
  else
    store(cell.access, value);
}

ir::Place Lowering::place(HostCell cell) const { return {.space = kRegisterSpace, .byte = hostCell(cell).byte}; }

} // namespace rung::frontend::technol
