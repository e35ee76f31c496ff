// Cells and bits (see memory.h).
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
  // BX has 16 bits: addresses of a segment of 64 kB wrap around, so that an index may be negative.
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

} // namespace rung::frontend::technol
