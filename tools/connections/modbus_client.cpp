// See modbus_client.h. All that may wait here waits on the thread of the connection.
#include "tools/connections/modbus_client.h"

#include <algorithm>
#include <cerrno>
#include <new>
#include <numeric>
#include <tuple>

#include "rtlib/host/realtime.h"
#include "tools/connections/registers.h"

namespace rung::connections {
namespace {

using mapping::Area;

constexpr int64_t kLongestWaitNs = 1'000'000'000; // for an answer
constexpr int64_t kRetryNs = 100'000'000;         // until the next attempt to connect, at least
constexpr int64_t kLookNs = 20'000'000;           // between two looks whether to end

bool isRegister(Area area) { return area == Area::HoldingRegister || area == Area::InputRegister; }
uint32_t lengthOf(const ExchangedPin& pin) { return isRegister(pin.place.area) ? registersOf(pin.place.format) : 1; }

// Places of one request.
uint32_t mostOf(Area area, bool writes) {
  if (isRegister(area)) return writes ? MODBUS_MAX_WRITE_REGISTERS : MODBUS_MAX_READ_REGISTERS;
  return writes ? MODBUS_MAX_WRITE_BITS : MODBUS_MAX_READ_BITS;
}

const char* nameOf(Area area) {
  switch (area) {
  case Area::Coil: return "coil ";
  case Area::DiscreteInput: return "discrete input ";
  case Area::HoldingRegister: return "holding register ";
  case Area::InputRegister: return "input register ";
  case Area::Memory: break;
  }
  return "";
}

void sleepUntil(int64_t end, const std::atomic<bool>& ending) {
  for (int64_t now = host::monotonicNs(); now < end && !ending; now = host::monotonicNs())
    host::sleepUntil(std::min(end, now + kLookNs));
}

} // namespace

ModbusClient::ModbusClient(const mapping::Connection& connection, Exchange& exchange)
    : exchange_(exchange), periodNs_(connection.periodNs),
      context_(modbus_new_tcp_pi(connection.host.c_str(), std::to_string(connection.port).c_str())),
      reads_(blocksOf(exchange.inputs(), false)), writes_(blocksOf(exchange.outputs(), true)),
      bits_(MODBUS_MAX_READ_BITS), registers_(MODBUS_MAX_READ_REGISTERS), inputs_(exchange.inputs().size()) {
  if (context_ == nullptr) throw std::bad_alloc();
  modbus_set_slave(context_.get(), connection.unit);
  const auto us = static_cast<uint32_t>(std::min(connection.timeoutNs, kLongestWaitNs) / 1000);
  modbus_set_response_timeout(context_.get(), us / 1'000'000, us % 1'000'000);
}

std::vector<ModbusClient::Block> ModbusClient::blocksOf(const std::vector<ExchangedPin>& pins, bool writes) {
  std::vector<size_t> order(pins.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return std::tuple(pins[i].place.area, pins[i].place.place); });
  std::vector<Block> blocks;
  for (const size_t i : order) {
    const mapping::ConnectedPin& place = pins[i].place;
    const bool follows = !blocks.empty() && blocks.back().area == place.area &&
                         blocks.back().first + blocks.back().count == place.place &&
                         blocks.back().count + lengthOf(pins[i]) <= mostOf(place.area, writes);
    if (!follows) blocks.push_back({.area = place.area, .first = place.place});
    blocks.back().count += lengthOf(pins[i]);
    blocks.back().pins.push_back(i);
  }
  return blocks;
}

void ModbusClient::run(const std::atomic<bool>& ending) noexcept {
  while (!ending) {
    const int64_t begin = host::monotonicNs();
    const bool good = (connected_ || connect()) && turn();
    if (!good) disconnect();
    sleepUntil(begin + (good ? periodNs_ : std::max(periodNs_, kRetryNs)), ending);
  }
  if (connected_) write();
  disconnect();
}

bool ModbusClient::connect() {
  connected_ = modbus_connect(context_.get()) == 0;
  return connected_ || fail("cannot connect");
}

// What an answer that comes too late belongs to would be unknown afterwards.
void ModbusClient::disconnect() {
  if (connected_) modbus_close(context_.get());
  connected_ = false;
}

bool ModbusClient::turn() {
  if (!write() || !read()) return false;
  setProblem("");
  exchange_.publish(inputs_, host::monotonicNs());
  return true;
}

bool ModbusClient::write() {
  const std::vector<double>& values = exchange_.newestOutputs();
  return std::ranges::all_of(writes_, [&](const Block& block) { return writeBlock(block, values); });
}

bool ModbusClient::writeBlock(const Block& block, const std::vector<double>& values) {
  for (const size_t i : block.pins) {
    const ExchangedPin& pin = exchange_.outputs()[i];
    const uint32_t at = pin.place.place - block.first;
    if (isRegister(block.area))
      toRegisters(pin, values[i], &registers_[at]);
    else
      bits_[at] = values[i] != 0 ? 1 : 0;
  }
  const int first = static_cast<int>(block.first), count = static_cast<int>(block.count);
  const int done = isRegister(block.area) ? modbus_write_registers(context_.get(), first, count, registers_.data())
                                          : modbus_write_bits(context_.get(), first, count, bits_.data());
  return done == count || fail(std::string("cannot write ") + nameOf(block.area) + std::to_string(block.first));
}

bool ModbusClient::read() {
  return std::ranges::all_of(reads_, [this](const Block& block) { return readBlock(block) && takeBlock(block); });
}

bool ModbusClient::readBlock(const Block& block) {
  modbus_t* device = context_.get();
  const int first = static_cast<int>(block.first), count = static_cast<int>(block.count);
  int done = -1;
  switch (block.area) {
  case Area::Coil: done = modbus_read_bits(device, first, count, bits_.data()); break;
  case Area::DiscreteInput: done = modbus_read_input_bits(device, first, count, bits_.data()); break;
  case Area::HoldingRegister: done = modbus_read_registers(device, first, count, registers_.data()); break;
  case Area::InputRegister: done = modbus_read_input_registers(device, first, count, registers_.data()); break;
  case Area::Memory: break;
  }
  return done == count || fail(std::string("cannot read ") + nameOf(block.area) + std::to_string(block.first));
}

bool ModbusClient::takeBlock(const Block& block) {
  for (const size_t i : block.pins) {
    const ExchangedPin& pin = exchange_.inputs()[i];
    const uint32_t at = pin.place.place - block.first;
    const std::optional<double> value =
        isRegister(block.area) ? fromRegisters(pin, &registers_[at]) : std::optional(bits_[at] != 0 ? 1.0 : 0.0);
    if (!value) {
      setProblem(std::string(nameOf(block.area)) + std::to_string(pin.place.place) + " is not a number");
      return false;
    }
    inputs_[i] = *value;
  }
  return true;
}

bool ModbusClient::fail(const std::string& what) {
  setProblem(what + ": " + modbus_strerror(errno));
  return false;
}

} // namespace rung::connections
