// See exchange.h.
#include "tools/connections/exchange.h"

#include <algorithm>

namespace rung::connections {
namespace {

std::vector<ExchangedPin> pinsOf(const mapping::File& map, const mapping::Connection& connection,
                                 mapping::Direction direction) {
  std::vector<ExchangedPin> pins;
  for (const mapping::ConnectedPin& pin : connection.pins)
    if (map.pins[pin.pin].direction == direction) pins.push_back({pin, map.pins[pin.pin].type});
  return pins;
}

double numberOf(mapping::PinType type, const plc::PinCell& cell) noexcept {
  switch (type) {
  case mapping::PinType::Bit: return *cell.bit ? 1 : 0;
  case mapping::PinType::S32: return *cell.s32;
  case mapping::PinType::U32: return *cell.u32;
  case mapping::PinType::Float: return *cell.real;
  }
  return 0;
}

void setNumber(mapping::PinType type, const plc::PinCell& cell, double value) noexcept {
  switch (type) {
  case mapping::PinType::Bit: *cell.bit = value != 0; return;
  case mapping::PinType::S32: *cell.s32 = static_cast<int32_t>(value); return;
  case mapping::PinType::U32: *cell.u32 = static_cast<uint32_t>(value); return;
  case mapping::PinType::Float: *cell.real = value; return;
  }
}

} // namespace

Exchange::Exchange(const mapping::File& map, const mapping::Connection& connection)
    : inputs_(pinsOf(map, connection, mapping::Direction::In)),
      outputs_(pinsOf(map, connection, mapping::Direction::Out)), statusPin_(connection.statusPin),
      timeoutNs_(connection.timeoutNs), heard_({std::vector<double>(inputs_.size())}),
      said_(std::vector<double>(outputs_.size())) {}

void Exchange::readInputs(const plc::PinCell* pins, int64_t nowNs) noexcept {
  heard_.take();
  const bool alive = heard_.front().ever && nowNs - heard_.front().atNs <= timeoutNs_;
  if (isAlive() && !alive) losses_.fetch_add(1, std::memory_order_relaxed);
  alive_.store(alive, std::memory_order_relaxed);
  setInputs(pins, alive);
  if (statusPin_) *pins[*statusPin_].bit = alive;
}

void Exchange::setInputs(const plc::PinCell* pins, bool alive) noexcept {
  for (size_t i = 0; i < inputs_.size(); ++i) {
    const mapping::ConnectedPin& place = inputs_[i].place;
    if (alive)
      setNumber(inputs_[i].type, pins[place.pin], heard_.front().values[i]);
    else if (!place.holds)
      setNumber(inputs_[i].type, pins[place.pin], place.safe);
  }
}

void Exchange::writeOutputs(const plc::PinCell* pins) noexcept {
  std::vector<double>& values = said_.back();
  for (size_t i = 0; i < outputs_.size(); ++i) values[i] = numberOf(outputs_[i].type, pins[outputs_[i].place.pin]);
  said_.publish();
}

void Exchange::publish(std::span<const double> inputs, int64_t nowNs) noexcept {
  Heard& heard = heard_.back();
  std::ranges::copy(inputs, heard.values.begin());
  heard.atNs = nowNs;
  heard.ever = true;
  heard_.publish();
  exchanges_.fetch_add(1, std::memory_order_relaxed);
}

const std::vector<double>& Exchange::newestOutputs() noexcept {
  said_.take();
  return said_.front();
}

} // namespace rung::connections
