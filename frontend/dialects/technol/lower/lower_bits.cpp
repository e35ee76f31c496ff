// Bit logic and jumps (man. ch. 3.5-3.8).
#include <array>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// Computes all addresses before the region of a condition.
std::vector<MemoryAccess> reachAll(Memory& memory, std::span<const Operand> bits, ValueId guard) {
  std::vector<MemoryAccess> places;
  for (const Operand& bit : bits) places.push_back(memory.reach(bit, guard));
  return places;
}

} // namespace

void lowerLoadBit(Lowering& l, std::span<const Operand> o, int) { l.r().setRlo(l.contact(o[0])); }

void lowerLicence(Lowering& l, std::span<const Operand> o, int) {
  ir::Place at = place(HostCell::Licences);
  at.byte += static_cast<uint32_t>(o[0].value) / 8;
  at.bit = static_cast<uint8_t>(o[0].value % 8);
  l.r().setRlo(l.b().load(Type::Bit, at));
}

void lowerJoin(Lowering& l, std::span<const Operand> o, int logic) {
  const ValueId rlo = l.r().rlo();
  l.r().setRlo(o[0].given() ? combine(l.b(), logic, rlo, l.contact(o[0])) : combine(l.b(), logic, l.popped(), rlo));
}

void lowerComplement(Lowering& l, std::span<const Operand>, int) { l.r().setRlo(l.b().not_(l.r().rlo())); }

// The slot holds the previous value: 0 before the first execution after a start, then 2 or 3. The first execution
// reports no edge (man. l.300).
void lowerEdge(Lowering& l, std::span<const Operand> o, int rising) {
  constexpr int kWasLow = 2, kWasHigh = 3;
  const ir::SlotId former = l.ownSlot(Type::I8);
  l.state.forgetAtStart(former);
  ir::RungBuilder& b = l.b();
  const ValueId bit = l.memory.bit(o[0]);
  const ValueId was = b.eq(b.slotLoad(former), b.constant(Type::I8, rising ? kWasLow : kWasHigh));
  b.slotStore(former, b.select(bit, b.constant(Type::I8, kWasHigh), b.constant(Type::I8, kWasLow)));
  l.r().setRlo(b.and_(was, rising ? bit : b.not_(bit)));
}

void lowerWrite(Lowering& l, std::span<const Operand> o, int) {
  const ValueId rlo = l.r().rlo();
  for (const Operand& bit : o) l.memory.store(l.memory.reach(bit), rlo);
}

void lowerFlag(Lowering& l, std::span<const Operand> o, int condition) {
  const ValueId guard = l.guardOf(condition);
  const std::vector<MemoryAccess> places = reachAll(l.memory, o.subspan(1), guard);
  l.b().when(guard, [&] {
    const ValueId flag = l.b().bit(o[0].value != 0);
    for (const MemoryAccess& place : places) l.memory.store(place, flag);
  });
}

void lowerMoveBit(Lowering& l, std::span<const Operand> o, int condition) {
  const ValueId guard = l.guardOf(condition);
  const std::vector<MemoryAccess> places = reachAll(l.memory, o, guard);
  l.b().when(guard, [&] {
    const ValueId bit = l.memory.load(places[1], Type::Bit);
    l.memory.store(places[0], o[1].negated ? l.b().not_(bit) : bit);
  });
}

// CHECK concerns only the compiler.
void lowerNothing(Lowering&, std::span<const Operand>, int) {}

void lowerJump(Lowering& l, std::span<const Operand> o, int condition) {
  l.emitter.out().jump(l.jumpTarget(o[0]), l.guardOf(condition));
}

} // namespace rung::frontend::technol
