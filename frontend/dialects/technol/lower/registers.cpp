// The registers inside a rung (see registers.h).
#include "frontend/dialects/technol/lower/registers.h"

#include "frontend/lower/module_items.h"
#include "ir/core/ops.h"

#include <string>

namespace rung::frontend::technol {

using ir::OpCode;
using ir::Type;
using ir::ValueId;

RegisterSlots makeRegisterSlots(ir::Module& module) {
  const auto make = [&](Type type, std::string key) {
    return addSlot(module, {.type = type, .transient = true, .key = std::move(key)});
  };
  RegisterSlots slots;
  slots.rlo = make(Type::Bit, "RLO");
  slots.dr = make(Type::I64, "DR");
  slots.real = make(Type::F64, "DR_REAL");
  slots.bx = make(Type::I32, "BX");
  for (uint32_t i = 0; i < kStackDepth; ++i) slots.stack[i] = make(Type::Bit, "STACK" + std::to_string(i));
  return slots;
}

void Registers::begin(ir::RungBuilder& builder) {
  b_ = &builder;
  rlo_ = real_ = bx_ = dr_ = Cell{};
  stack_.fill(Cell{});
  low_ = {};
  part_ = Part::None;
}

ValueId Registers::get(Cell& cell, ir::SlotId slot) {
  if (!cell.value.valid()) cell.value = b_->slotLoad(slot);
  return cell.value;
}

void Registers::set(Cell& cell, ValueId value) { cell = {.value = value, .changed = true}; }

void Registers::put(Cell& cell, ir::SlotId slot) {
  if (cell.changed) b_->slotStore(slot, cell.value);
  cell.changed = false;
}

void Registers::flush() {
  put(rlo_, slots_.rlo);
  if (dr_.changed) whole();
  put(dr_, slots_.dr);
  put(real_, slots_.real);
  put(bx_, slots_.bx);
  for (uint32_t i = 0; i < kStackDepth; ++i) put(stack_[i], slots_.stack[i]);
}

void Registers::clear() {
  setRlo(b_->bit(false));
  set(real_, b_->real(0));
  setDr(b_->constant(Type::I64, 0));
  setBx(b_->i32(0));
}

ValueId Registers::rlo() { return get(rlo_, slots_.rlo); }
void Registers::setRlo(ValueId value) { set(rlo_, value); }
ValueId Registers::real() { return get(real_, slots_.real); }
ValueId Registers::bx() { return get(bx_, slots_.bx); }
void Registers::setBx(ValueId value) { set(bx_, value); }
ValueId Registers::stack(uint32_t level) { return get(stack_[level], slots_.stack[level]); }
void Registers::setStack(uint32_t level, ValueId value) { set(stack_[level], value); }

void Registers::setReal(ValueId value) {
  set(real_, value);
  setDr(b_->op(OpCode::FToIntNearest, Type::I64, {value}));
}

ValueId Registers::whole() {
  if (part_ == Part::Signed) {
    dr_.value = b_->sextOrTrunc(Type::I64, low_);
  } else if (part_ == Part::Pending) {
    const ValueId rest = get(dr_, slots_.dr);
    const int64_t mask = static_cast<int64_t>(~uint64_t{0} << ir::bitWidth(lowType_));
    dr_.value = b_->or_(b_->and_(rest, b_->constant(Type::I64, mask)), b_->zextOrTrunc(Type::I64, low_));
  }
  if (part_ != Part::None) part_ = Part::Merged;
  return get(dr_, slots_.dr);
}

ValueId Registers::dr(Type type) {
  const bool covers = part_ != Part::None && ir::bitWidth(lowType_) >= ir::bitWidth(type);
  if (covers || part_ == Part::Signed) return b_->sextOrTrunc(type, low_);
  return b_->zextOrTrunc(type, whole());
}

void Registers::setDr(ValueId value) {
  const Type type = b_->typeOf(value);
  dr_ = {.value = type == Type::I64 ? value : ValueId{}, .changed = true};
  low_ = value;
  lowType_ = type;
  part_ = type == Type::I64 ? Part::None : Part::Signed;
}

void Registers::setDrPart(ValueId value) {
  const Type type = b_->typeOf(value);
  if (type == Type::I64) return setDr(value);
  const bool covered = part_ == Part::Pending && ir::bitWidth(lowType_) <= ir::bitWidth(type);
  if (!covered && part_ != Part::None) whole();
  dr_.changed = true;
  low_ = value;
  lowType_ = type;
  part_ = Part::Pending;
}

} // namespace rung::frontend::technol
