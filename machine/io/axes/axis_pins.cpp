// Pins of axes (see axis_pins.h).
#include "machine/io/axes/axis_pins.h"

#include <algorithm>
#include <iterator>

namespace rung::io {
namespace {

using host::Direction, host::PinType;

struct AxisPin {
  std::string_view name;
  PinType type;
  Direction direction;
};
enum : uint32_t { kPosition, kHomed, kEnabled, kFault, kCommand, kEnable }; // in kPins
constexpr AxisPin kPins[] = {
    {"position-feedback", PinType::Float, Direction::In},
    {"homed", PinType::Bit, Direction::In},
    {"enabled", PinType::Bit, Direction::In},
    {"fault", PinType::Bit, Direction::In},
    {"position-command", PinType::Float, Direction::Out},
    {"enable", PinType::Bit, Direction::Out},
};

} // namespace

std::string AxisPins::add(host::File& map, uint32_t axis, const std::string& prefix) {
  const auto first = static_cast<uint32_t>(map.pins.size());
  for (const AxisPin& pin : kPins) {
    const std::string name = prefix + "." + std::string(pin.name);
    if (const auto same = std::ranges::find(map.pins, name, &host::Pin::name); same != map.pins.end())
      return "found a pin " + name + (same->ofHost ? "" : " in line " + std::to_string(same->at.line)) +
             " already, which axis " + std::to_string(axis) + " is to have; give one of them another name";
    map.pins.push_back({.name = name, .type = pin.type, .direction = pin.direction, .ofHost = true});
  }
  pins_.push_back({axis, first});
  return {};
}

void AxisPins::connect(const host::PinCell* cells, const host::PinAccess& access) noexcept {
  cells_ = cells;
  access_ = &access;
}

void AxisPins::read(PositionedAxes& axes) const noexcept {
  if (cells_ == nullptr) return;
  for (const Pins& pins : pins_) {
    const host::PinCell* cells = cells_ + pins.first;
    axes.inputs(pins.axis) = {.position = access_->read(PinType::Float, cells[kPosition]).real,
                              .homed = access_->read(PinType::Bit, cells[kHomed]).bit,
                              .enabled = access_->read(PinType::Bit, cells[kEnabled]).bit,
                              .fault = access_->read(PinType::Bit, cells[kFault]).bit};
  }
}

void AxisPins::write(const PositionedAxes& axes) const noexcept {
  if (cells_ == nullptr) return;
  for (const Pins& pins : pins_) {
    const DriveOutputs outputs = axes.outputs(pins.axis);
    access_->write(PinType::Float, cells_[pins.first + kCommand], {.real = outputs.position});
    access_->write(PinType::Bit, cells_[pins.first + kEnable], {.bit = outputs.enable});
  }
}

} // namespace rung::io
