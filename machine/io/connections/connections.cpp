// See connections.h.
#include "machine/io/connections/connections.h"

#include <algorithm>

#include "machine/io/connections/modbus_client.h"
#include "machine/io/connections/modbus_server.h"
#include "machine/io/connections/shared_memory.h"
#include "rtlib/run/realtime.h"

namespace rung::io {

namespace {

std::unique_ptr<Service> serviceOf(const host::Connection& connection, Exchange& exchange) {
  switch (connection.kind) {
  case host::Connection::Kind::ModbusClient: return std::make_unique<ModbusClient>(connection, exchange);
  case host::Connection::Kind::ModbusServer: return std::make_unique<ModbusServer>(connection, exchange);
  case host::Connection::Kind::SharedMemory: return std::make_unique<SharedMemory>(connection, exchange);
  }
  return nullptr;
}

} // namespace

Connections::Served::Served(const host::File& map, const host::Connection& connection)
    : title(connection.title()), exchange(map, connection), service(serviceOf(connection, exchange)) {}

Connections::Connections(const host::File& map) {
  for (const host::Connection& connection : map.connections) {
    served_.emplace_back(map, connection);
    for (const host::ConnectedPin& pin : connection.pins)
      if (pin.holds)
        warnings_.push_back("pin " + map.pins[pin.pin].name + " holds its last value while " + connection.title() +
                            " is lost");
  }
}

void Connections::start() {
  for (Served& served : served_)
    served.thread = std::thread([this, &served] {
      runtime::becomeHelper();
      served.service->run(ending_);
    });
}

void Connections::end() {
  ending_ = true;
  for (Served& served : served_)
    if (served.thread.joinable()) served.thread.join();
}

void Connections::readInputs(const host::PinCell* pins, int64_t nowNs) noexcept {
  for (Served& served : served_) served.exchange.readInputs(pins, nowNs);
}

void Connections::writeOutputs(const host::PinCell* pins) noexcept {
  for (Served& served : served_) served.exchange.writeOutputs(pins);
}

void Connections::report(const std::function<void(const std::string&)>& print) {
  for (Served& served : served_) {
    const bool alive = served.exchange.isAlive();
    if (alive != served.reported)
      print(served.title + (alive ? ": connected" : ": lost; its inputs have their safe values"));
    if (alive != served.reported) served.explained = false;
    served.reported = alive;
    const std::string problem = alive || served.explained ? "" : served.service->problem();
    if (problem.empty()) continue;
    print(served.title + ": " + problem);
    served.explained = true;
  }
}

std::vector<Figures> Connections::figures() const {
  std::vector<Figures> all;
  for (const Served& served : served_)
    all.push_back({served.title, served.exchange.isAlive(), served.exchange.exchanges(), served.exchange.losses(),
                   served.service->problem()});
  return all;
}

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
