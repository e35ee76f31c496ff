// Contacts, coils, SET, RST, DIFU, DIFD (man. §6.1).
#include <fmt/format.h>

#include "frontend/dialects/nct/lower/lower.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::SlotId;
using ir::Type;
using ir::ValueId;

void SlotMaker::setElement(std::string text) {
  element_ = std::move(text);
  numbered_ = false;
}

std::string SlotMaker::key(std::string_view role) {
  if (!numbered_) element_ = alike_.numbered(element_);
  numbered_ = true;
  return fmt::format("{}/{}/{}", routine_, element_, role);
}

SlotId SlotMaker::make(std::string_view role, Type type, int64_t init, bool transient) {
  return frontend::addSlot(module_, {.type = type, .init = init, .transient = transient, .key = key(role)});
}

void SlotMaker::addTimer(ir::Timer timer) {
  timer.name = frontend::Numbering::withoutNumber(element_);
  module_.timers.push_back(std::move(timer));
}

ValueId risingEdge(Lowering& box, std::string_view role, size_t pin) {
  const SlotId slot = box.slots.make(role, Type::Bit);
  const ValueId power = box.power(pin);
  const ValueId edge = frontend::edge(box.b, box.b.slotLoad(slot), power);
  box.b.slotStore(slot, power);
  return edge;
}

namespace {

// Edge of a contact with `@` or `%`.
frontend::Edge edgeOf(const Lowering& box) { return box.edge == '@' ? kRising : kFalling; }

constexpr int64_t kNoAddress = 0xFFFFFFFF; // no bit has this address

// Edge of a contact with a computed address. The stored value belongs to the address it was read from: a change of
// the address is not an edge. Before the first evaluation the slot has no address and the value is 0.
ValueId movingPulse(Lowering& box, const Place& place, ValueId value) {
  RungBuilder& b = box.b;
  const SlotId addressSlot = box.slots.make("address", Type::I32, kNoAddress);
  const SlotId valueSlot = box.slots.make("value", Type::Bit);
  const ValueId address = box.memory.bitAddress(place);
  const ValueId lastAddress = b.slotLoad(addressSlot);
  const ValueId lastValue = b.slotLoad(valueSlot);
  const ValueId same = b.or_(b.eq(address, lastAddress), b.eq(lastAddress, b.i32(kNoAddress)));
  const ValueId edge = frontend::edge(b, lastValue, value, edgeOf(box));
  const bool guard = place.valid.valid();
  b.slotStore(addressSlot, guard ? b.select(place.valid, address, lastAddress) : address);
  b.slotStore(valueSlot, guard ? b.select(place.valid, value, lastValue) : value);
  return b.and_(edge, same);
}

} // namespace

// The edge of a contact is evaluated even without power on its left; FL_ER is set only with power.
ValueId lowerContact(Lowering& box) {
  RungBuilder& b = box.b;
  Memory& memory = box.memory;
  const bool onWord = (box.variant & kOnWord) != 0;
  const Address& address = box.operands[0].address;
  const Place place = onWord ? memory.word(address, AccessBound::Read) : memory.bit(address, AccessBound::Read);
  ValueId value = onWord ? b.ne(memory.loadWord(place), b.i32(0)) : memory.loadBit(place);
  if (box.edge != 0 && place.fixed) value = frontend::pulse(b, box.slots.make("edge", Type::Bit), value, edgeOf(box));
  if (box.edge != 0 && !place.fixed) value = movingPulse(box, place, value);
  if ((box.variant & kClosed) != 0) value = b.not_(value);
  if (!place.valid.valid()) return box.pass(value);
  memory.raiseErrorFlag(box.gate(b.not_(place.valid)));
  return box.pass(b.and_(value, place.valid));
}

ValueId lowerCoil(Lowering& box) {
  RungBuilder& b = box.b;
  const ValueId power = box.power();
  const Place place = box.memory.bit(box.operands[0].address, AccessBound::Write);
  const bool force = box.variant == kSet || box.variant == kReset;
  if (force)
    box.memory.forceBit(place, power, box.variant == kSet);
  else
    box.memory.storeBit(place, box.variant == kNegatedCoil ? b.not_(power) : power);
  if (place.valid.valid()) {
    const ValueId wrong = b.not_(place.valid);
    box.memory.raiseErrorFlag(force ? b.and_(power, wrong) : wrong);
  }
  return {};
}

ValueId lowerPulse(Lowering& box) {
  const ValueId edge = frontend::pulse(box.b, box.slots.make("edge", Type::Bit), box.power(), box.variant);
  const Place place = box.memory.bit(box.operands[0].address, AccessBound::Write);
  box.memory.storeBit(place, edge);
  if (place.valid.valid()) box.memory.raiseErrorFlag(box.b.not_(place.valid));
  return {};
}

} // namespace rung::frontend::nct
