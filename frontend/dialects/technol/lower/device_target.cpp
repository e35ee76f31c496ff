// Operands with data of devices (see device_target.h).
#include "frontend/dialects/technol/lower/device_target.h"

#include <algorithm>

#include "frontend/dialects/technol/lower/lower_text.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

constexpr Type kInteger = Type::I32, kReal = Type::I64; // elements of tables in bytes (man. l.18752)

} // namespace

DeviceTarget::DeviceTarget(Lowering& context, const Operand& operand, ValueId guard)
    : l_(&context), operand_(&operand) {
  if (operand.form == Operand::Form::Text) {
    area_ = textOf(context.memory, operand).area;
    return;
  }
  access_ = context.memory.reach(operand, guard);
  area_ = areaAt(context.memory, access_);
}

void DeviceTarget::keep(ValueId when) {
  if (!access_.indexed) return;
  ir::RungBuilder& b = l_->b();
  const ir::SlotId slot = l_->ownSlot(Type::I32);
  const ValueId first = l_->memory.placeIn(*operand_, operand_->begin);
  b.when(when, [&] { b.slotStore(slot, b.sub(access_.index, first)); });
  access_.index = area_.at = b.add(b.slotLoad(slot), first);
}

uint32_t DeviceTarget::most() const {
  if (operand_->form == Operand::Form::Text) return static_cast<uint32_t>(operand_->text.size());
  if (operand_->prefixed) return ir::byteWidth(operand_->type);
  return operand_->indexed ? static_cast<uint32_t>(operand_->end - operand_->begin) : operand_->size();
}

ValueId DeviceTarget::roomWithEnd() const {
  ir::RungBuilder& b = l_->b();
  if (!access_.indexed) return b.i32(most());
  const ValueId begin = l_->memory.placeIn(*operand_, operand_->begin),
                end = l_->memory.placeIn(*operand_, operand_->end);
  const ValueId room = b.sub(end, area_.at);
  const ValueId inside = b.and_(b.leU(begin, area_.at), b.ltU(area_.at, end));
  return b.select(inside, room, b.i32(0));
}

ValueId DeviceTarget::room() const {
  const ValueId all = roomWithEnd();
  if (terminator() == 0) return all;
  ir::RungBuilder& b = l_->b();
  return b.select(b.eq(all, b.i32(0)), all, b.sub(all, b.i32(1)));
}

// A variable of 8 bytes without a type is a QWORD or a REAL (man. l.700-704).
Type DeviceTarget::cellType() const {
  if (operand_->type != Type::None) return operand_->type == Type::F64 ? Type::I64 : operand_->type;
  return !operand_->isText && operand_->size() == 8 ? Type::I64 : Type::None;
}

ValueId DeviceTarget::numberAt(Type type) const {
  return l_->b().sextOrTrunc(Type::I64, loadByte(l_->b(), area_, l_->b().i32(0), type));
}

void DeviceTarget::put(ValueId value, Type type) const {
  storeByte(l_->b(), area_, l_->b().i32(0), l_->b().zextOrTrunc(type, value));
}

void DeviceTarget::require(DataForm form, ValueId guard) const {
  const bool word = form == DataForm::Integer && cellType() == Type::None;
  if (!access_.indexed || (!word && form != DataForm::Real)) return;
  ir::RungBuilder& b = l_->b();
  const ValueId lacks = b.ltU(roomWithEnd(), b.i32(ir::byteWidth(word ? kInteger : kReal)));
  l_->emitter.protect(guard.valid() ? b.and_(guard, lacks) : lacks);
}

void DeviceTarget::addWord(DeviceRequest& request) const {
  request.add(l_->b().zextOrTrunc(Type::I64, loadByte(l_->b(), area_, l_->b().i32(0), Type::I16)));
}

void DeviceTarget::addTo(DeviceRequest& request, DataForm form, ValueId count) const {
  ir::RungBuilder& b = l_->b();
  switch (form) {
  case DataForm::None: return;
  case DataForm::Integer: {
    const Type type = cellType();
    request.add(type == Type::None ? numberAt(kInteger) : b.sextOrTrunc(Type::I64, l_->memory.load(access_, type)));
    return;
  }
  case DataForm::Real: request.add(numberAt(kReal)); return;
  case DataForm::Text: request.add(bytesArgument(l_->emitter, area_, count)); return;
  case DataForm::Binary:
  case DataForm::Bytes: request.add(bytesArgument(l_->emitter, area_, count)); return;
  }
}

void DeviceTarget::take(DeviceRequest& request, ValueId ticket, std::string_view name, DataForm form) const {
  ir::RungBuilder& b = l_->b();
  const ValueId value = request.result(name);
  switch (form) {
  case DataForm::None: return;
  case DataForm::Integer: {
    const Type type = cellType();
    if (type == Type::None) return put(value, kInteger);
    return l_->memory.store(access_, b.zextOrTrunc(type, value));
  }
  case DataForm::Real: return put(value, kReal);
  case DataForm::Text:
  case DataForm::Binary:
  case DataForm::Bytes: return fetch(ticket, b.zextOrTrunc(Type::I32, value), form);
  }
}

void DeviceTarget::fetch(ValueId ticket, ValueId length, DataForm form) const {
  ir::RungBuilder& b = l_->b();
  const bool counted = form == DataForm::Bytes;
  const ValueId room = counted ? roomWithEnd() : this->room();
  const ValueId count = b.select(b.ltU(length, room), length, room);
  fetchBytes(l_->emitter, ticket, area_, count, most() - (counted ? 0 : terminator()));
  if (form == DataForm::Text) storeTerminator(b, area_, count, b.bit(true));
}

} // namespace rung::frontend::technol
