// See exchange.h.
#include "machine/io/connections/exchange.h"

#include <algorithm>

namespace rung::io {
namespace {

std::vector<ExchangedPin> pinsOf(const host::File& map, const host::Connection& connection, host::Direction direction) {
  std::vector<ExchangedPin> pins;
  for (const host::ConnectedPin& pin : connection.pins)
    if (map.pins[pin.pin].direction == direction) pins.push_back({pin, map.pins[pin.pin].type});
  return pins;
}

double numberOf(host::PinType type, const host::PinCell& cell) noexcept {
  switch (type) {
  case host::PinType::Bit: return *cell.bit ? 1 : 0;
  case host::PinType::S32: return *cell.s32;
  case host::PinType::U32: return *cell.u32;
  case host::PinType::Float: return *cell.real;
  }
  return 0;
}

void setNumber(host::PinType type, const host::PinCell& cell, double value) noexcept {
  switch (type) {
  case host::PinType::Bit: *cell.bit = value != 0; return;
  case host::PinType::S32: *cell.s32 = static_cast<int32_t>(value); return;
  case host::PinType::U32: *cell.u32 = static_cast<uint32_t>(value); return;
  case host::PinType::Float: *cell.real = value; return;
  }
}

} // namespace

Exchange::Exchange(const host::File& map, const host::Connection& connection)
    : inputs_(pinsOf(map, connection, host::Direction::In)), outputs_(pinsOf(map, connection, host::Direction::Out)),
      statusPin_(connection.statusPin), timeoutNs_(connection.timeoutNs), heard_({std::vector<double>(inputs_.size())}),
      said_(std::vector<double>(outputs_.size())) {}

void Exchange::readInputs(const host::PinCell* pins, int64_t nowNs) noexcept {
  heard_.take();
  const bool alive = heard_.front().ever && nowNs - heard_.front().atNs <= timeoutNs_;
  if (isAlive() && !alive) losses_.fetch_add(1, std::memory_order_relaxed);
  alive_.store(alive, std::memory_order_relaxed);
  setInputs(pins, alive);
  if (statusPin_) *pins[*statusPin_].bit = alive;
}

void Exchange::setInputs(const host::PinCell* pins, bool alive) noexcept {
  for (size_t i = 0; i < inputs_.size(); ++i) {
    const host::ConnectedPin& place = inputs_[i].place;
    if (alive)
      setNumber(inputs_[i].type, pins[place.pin], heard_.front().values[i]);
    else if (!place.holds)
      setNumber(inputs_[i].type, pins[place.pin], place.safe);
  }
}

void Exchange::writeOutputs(const host::PinCell* pins) noexcept {
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

} // namespace rung::io
