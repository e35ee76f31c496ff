// See connections.h.
#include "machine/io/connections/connections.h"

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

} // namespace rung::io
