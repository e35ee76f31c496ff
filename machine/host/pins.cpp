// See pins.h.
#include "machine/host/pins.h"

namespace rung::host {

namespace {

Value readVariable(PinType type, const PinCell& cell) noexcept {
  switch (type) {
  case PinType::Bit: return {.bit = *cell.bit};
  case PinType::S32: return {.s32 = *cell.s32};
  case PinType::U32: return {.u32 = *cell.u32};
  case PinType::Float: return {.real = *cell.real};
  }
  return {};
}

void writeVariable(PinType type, const PinCell& cell, const Value& value) noexcept {
  switch (type) {
  case PinType::Bit: *cell.bit = value.bit; return;
  case PinType::S32: *cell.s32 = value.s32; return;
  case PinType::U32: *cell.u32 = value.u32; return;
  case PinType::Float: *cell.real = value.real; return;
  }
}

} // namespace

const PinAccess kVariables{readVariable, writeVariable};

Pins::Pins(const std::vector<host::Pin>& pins) {
  pins_.reserve(pins.size());
  for (const host::Pin& pin : pins)
    pins_.push_back({.value = {}, .type = pin.type, .isInput = toProgram(pin.direction)});
}

void Pins::connect(const PinCell* cells, const PinAccess& access) noexcept {
  cells_ = cells;
  access_ = &access;
}

void Pins::read() noexcept {
  for (size_t i = 0; i < pins_.size(); ++i)
    if (pins_[i].isInput) pins_[i].value = access_->read(pins_[i].type, cells_[i]);
}

void Pins::look(std::span<Value> values) const noexcept {
  for (size_t i = 0; i < pins_.size() && connected(); ++i) values[i] = access_->read(pins_[i].type, cells_[i]);
}

void Pins::write() noexcept {
  for (size_t i = 0; i < pins_.size(); ++i) {
    Pin& pin = pins_[i];
    if (pin.isSet) access_->write(pin.type, cells_[i], pin.value);
    pin.isSet = false;
  }
}

} // namespace rung::host
