// See modbus_image.h.
#include "machine/io/connections/modbus_image.h"

#include <algorithm>
#include <new>

#include "machine/io/connections/registers.h"

namespace rung::io {
namespace {

using host::Area;

bool isRegister(Area area) { return area == Area::HoldingRegister || area == Area::InputRegister; }
uint32_t lengthOf(const ExchangedPin& pin) { return isRegister(pin.place.area) ? registersOf(pin.place.format) : 1; }

} // namespace

ModbusImage::ModbusImage(Exchange& exchange) : exchange_(exchange), inputs_(exchange.inputs().size()) {
  for (const ExchangedPin& pin : exchange.inputs()) mark(pin, true);
  for (const ExchangedPin& pin : exchange.outputs()) mark(pin, false);
  const auto size = [this](Area area) { return static_cast<int>(marks(area).size()); };
  tables_.reset(modbus_mapping_new(size(Area::Coil), size(Area::DiscreteInput), size(Area::HoldingRegister),
                                   size(Area::InputRegister)));
  if (tables_ == nullptr) throw std::bad_alloc();
  for (const ExchangedPin& pin : exchange.inputs()) set(pin, pin.place.safe);
}

void ModbusImage::mark(const ExchangedPin& pin, bool isInput) {
  std::vector<uint8_t>& places = marks(pin.place.area);
  const size_t end = pin.place.place + lengthOf(pin);
  places.resize(std::max(places.size(), end));
  for (size_t i = pin.place.place; i < end; ++i) places[i] = isInput ? kThere | kInput : kThere;
  places[pin.place.place] |= kFirst;
  places[end - 1] |= kLast;
}

Exception ModbusImage::check(const Request& request) const {
  const std::vector<uint8_t>& places = marks(request.area);
  const size_t end = size_t{request.first} + request.count;
  if (end > places.size()) return Exception::Address;
  const uint8_t wanted = request.writes ? kThere | kInput : kThere;
  const auto isGood = [wanted](uint8_t place) { return (place & wanted) == wanted; };
  if (!std::all_of(places.begin() + request.first, places.begin() + static_cast<int64_t>(end), isGood))
    return Exception::Address;
  if (!request.writes) return Exception::None;
  if ((places[request.first] & kFirst) == 0 || (places[end - 1] & kLast) == 0) return Exception::Address;
  return writesNumbers(request) ? Exception::None : Exception::Value;
}

// Whole values are written: that is known by now.
bool ModbusImage::writesNumbers(const Request& request) const {
  if (!isRegister(request.area)) return true;
  return std::ranges::all_of(exchange_.inputs(), [&](const ExchangedPin& pin) {
    if (pin.place.area != request.area || pin.place.place < request.first ||
        pin.place.place >= request.first + request.count)
      return true;
    uint16_t registers[2] = {};
    for (uint32_t i = 0; i < lengthOf(pin); ++i) {
      const size_t at = size_t{pin.place.place - request.first + i} * 2;
      registers[i] = static_cast<uint16_t>(request.values[at] << 8 | request.values[at + 1]);
    }
    return fromRegisters(pin, registers).has_value();
  });
}

uint16_t* ModbusImage::registers(Area area) const {
  return area == Area::HoldingRegister ? tables_->tab_registers : tables_->tab_input_registers;
}

uint8_t* ModbusImage::bits(Area area) const { return area == Area::Coil ? tables_->tab_bits : tables_->tab_input_bits; }

void ModbusImage::set(const ExchangedPin& pin, double value) {
  if (isRegister(pin.place.area))
    toRegisters(pin, value, registers(pin.place.area) + pin.place.place);
  else
    bits(pin.place.area)[pin.place.place] = value != 0 ? 1 : 0;
}

double ModbusImage::get(const ExchangedPin& pin) const {
  if (!isRegister(pin.place.area)) return bits(pin.place.area)[pin.place.place] != 0 ? 1 : 0;
  return fromRegisters(pin, registers(pin.place.area) + pin.place.place).value_or(pin.place.safe);
}

void ModbusImage::refreshOutputs() {
  const std::vector<double>& values = exchange_.newestOutputs();
  for (size_t i = 0; i < values.size(); ++i) set(exchange_.outputs()[i], values[i]);
}

const std::vector<double>& ModbusImage::inputs() {
  for (size_t i = 0; i < inputs_.size(); ++i) inputs_[i] = get(exchange_.inputs()[i]);
  return inputs_;
}

void ModbusImage::resetInputs() {
  for (const ExchangedPin& pin : exchange_.inputs())
    if (!pin.place.holds) set(pin, pin.place.safe);
}

} // namespace rung::io
