// See modbus_client.h. All waiting takes place on the thread of the connection.
#include "machine/io/connections/modbus_client.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <numeric>
#include <span>
#include <tuple>

#include "machine/io/connections/modbus_image.h"
#include "rtlib/run/realtime.h"

namespace rung::io {
namespace {

using host::Area;

constexpr int64_t kLongestWaitNs = 1'000'000'000; // longest wait for an answer
constexpr int64_t kRetryNs = 100'000'000;         // shortest time to the next attempt to connect
constexpr int64_t kLookNs = 20'000'000;           // between two checks for the end
constexpr int64_t kNsInMs = 1'000'000;
constexpr size_t kPlaceBytes = 5; // bytes of a request's function code, address and count

bool isRegister(Area area) { return area == Area::HoldingRegister || area == Area::InputRegister; }
uint32_t lengthOf(const ExchangedPin& pin) { return isRegister(pin.place.area) ? registersOf(pin.place.format) : 1; }

// Largest number of addresses in one request.
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

std::string inMs(int64_t ns) { return std::to_string(ns / kNsInMs) + " ms"; }

void sleepUntil(int64_t end, const std::atomic<bool>& ending) {
  for (int64_t now = runtime::monotonicNs(); now < end && !ending; now = runtime::monotonicNs())
    runtime::sleepUntil(std::min(end, now + kLookNs));
}

} // namespace

ModbusClient::ModbusClient(const host::Connection& connection, Exchange& exchange)
    : exchange_(exchange), periodNs_(connection.periodNs),
      context_(modbus_new_tcp_pi(connection.host.c_str(), std::to_string(connection.port).c_str())),
      reads_(blocksOf(exchange.inputs(), false)), writes_(blocksOf(exchange.outputs(), true)),
      bits_(MODBUS_MAX_READ_BITS), registers_(MODBUS_MAX_READ_REGISTERS), inputs_(exchange.inputs().size()),
      answerNs_(std::min(connection.timeoutNs, kLongestWaitNs)) {
  if (context_ == nullptr) throw std::bad_alloc();
  modbus_set_slave(context_.get(), connection.unit);
  unit_ = static_cast<uint8_t>(connection.unit);
  const auto us = static_cast<uint32_t>(answerNs_ / 1000);
  modbus_set_response_timeout(context_.get(), us / 1'000'000, us % 1'000'000);
}

std::vector<ModbusClient::Block> ModbusClient::blocksOf(const std::vector<ExchangedPin>& pins, bool writes) {
  std::vector<size_t> order(pins.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return std::tuple(pins[i].place.area, pins[i].place.place); });
  std::vector<Block> blocks;
  for (const size_t i : order) {
    const host::ConnectedPin& place = pins[i].place;
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
  ending_ = &ending;
  while (!ending) {
    const int64_t begin = runtime::monotonicNs();
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

// Closes the connection after an error, because a late answer could not be assigned to its request.
void ModbusClient::disconnect() {
  if (connected_) modbus_close(context_.get());
  connected_ = false;
}

// An exchange may take too long although each answer is in time.
bool ModbusClient::turn() {
  const int64_t begin = runtime::monotonicNs();
  if (!write() || !read()) return false;
  const int64_t now = runtime::monotonicNs();
  waited_ = false;
  setProblem(now - begin <= exchange_.timeoutNs()
                 ? ""
                 : "the device answers, but too slowly: an exchange took " + inMs(now - begin) +
                       ", longer than its timeout of " + inMs(exchange_.timeoutNs()));
  exchange_.publish(inputs_, now);
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
  const bool words = isRegister(block.area);
  std::vector<uint8_t> data(words ? 2 * block.count : (block.count + 7) / 8);
  for (size_t i = 0; i < block.count; ++i)
    if (words)
      MODBUS_SET_INT16_TO_INT8(data, 2 * i, registers_[i]);
    else
      data[i / 8] = static_cast<uint8_t>(data[i / 8] | bits_[i] << i % 8);
  begin(words ? MODBUS_FC_WRITE_MULTIPLE_REGISTERS : MODBUS_FC_WRITE_MULTIPLE_COILS, block);
  request_.push_back(static_cast<uint8_t>(data.size()));
  request_.insert(request_.end(), data.begin(), data.end());
  // The answer repeats function code, address and count.
  const bool good = ask() && std::ranges::equal(answer_, std::span(request_).subspan(1, kPlaceBytes));
  return good || fail(std::string("cannot write ") + nameOf(block.area) + std::to_string(block.first));
}

// Unit, function code, address and count, the beginning of all requests.
void ModbusClient::begin(uint8_t function, const Block& block) {
  request_ = {unit_,
              function,
              static_cast<uint8_t>(block.first >> 8),
              static_cast<uint8_t>(block.first),
              static_cast<uint8_t>(block.count >> 8),
              static_cast<uint8_t>(block.count)};
}

// Sends a raw request, because the library's own requests do not check the unit of the answer. Returns false, with
// errno, if there is no answer, or not one to this request; the next answer could then not be assigned.
bool ModbusClient::ask() {
  modbus_t* device = context_.get();
  answer_.clear();
  errno = EMBBADDATA;
  if (modbus_send_raw_request(device, request_.data(), static_cast<int>(request_.size())) < 0) return false;
  std::array<uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> message{};
  const int length = modbus_receive_confirmation(device, message.data());
  if (length < 0) return false;
  errno = EMBBADDATA;
  constexpr size_t kUnitAt = 6, kFunctionAt = 7;
  const std::span<const uint8_t> given(message.data(), static_cast<size_t>(length));
  if (given.size() < kFunctionAt + 2) return false;
  if (given[0] != 0 || given[1] != 0) return false; // transaction identifier of raw requests
  errno = EMBBADSLAVE;
  if (given[kUnitAt] != unit_) return false;
  errno = EMBBADDATA;
  if (given[kFunctionAt] == (request_[1] | 0x80)) return errno = MODBUS_ENOBASE + given[kFunctionAt + 1], false;
  if (given[kFunctionAt] != request_[1]) return false;
  answer_.assign(given.begin() + kFunctionAt, given.end());
  return true;
}

bool ModbusClient::read() {
  return std::ranges::all_of(reads_, [this](const Block& block) { return readBlock(block) && takeBlock(block); });
}

bool ModbusClient::readBlock(const Block& block) {
  constexpr uint8_t kFunctions[] = {MODBUS_FC_READ_COILS, MODBUS_FC_READ_DISCRETE_INPUTS,
                                    MODBUS_FC_READ_HOLDING_REGISTERS, MODBUS_FC_READ_INPUT_REGISTERS}; // by Area
  const bool words = isRegister(block.area);
  begin(kFunctions[static_cast<size_t>(block.area)], block);
  constexpr size_t kDataAt = 2; // after function code and number of bytes
  const size_t bytes = words ? 2 * size_t{block.count} : (block.count + 7) / 8;
  if (!ask() || answer_.size() != kDataAt + bytes || answer_[1] != bytes)
    return fail(std::string("cannot read ") + nameOf(block.area) + std::to_string(block.first));
  for (size_t i = 0; i < block.count; ++i)
    if (words)
      registers_[i] = static_cast<uint16_t>(MODBUS_GET_INT16_FROM_INT8(answer_, kDataAt + 2 * i));
    else
      bits_[i] = answer_[kDataAt + i / 8] >> i % 8 & 1;
  return true;
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
  if (errno != ETIMEDOUT || !connected_) {
    setProblem(what + ": " + modbus_strerror(errno));
    return false;
  }
  const std::string late = what + ": no answer within " + inMs(answerNs_);
  if (!waited_) setProblem(late + (answersLater() ? "; the device answers, but later than that" : ""));
  waited_ = true;
  return false;
}

// Waits longer for a late answer, only once after a successful exchange, because the client cannot reconnect meanwhile.
bool ModbusClient::answersLater() {
  constexpr int64_t kTimes = 3;
  pollfd waiting{modbus_get_socket(context_.get()), POLLIN, 0};
  bool answers = false;
  for (int64_t left = kTimes * answerNs_; left > 0 && !answers && !*ending_; left -= kLookNs)
    answers = poll(&waiting, 1, static_cast<int>(kLookNs / kNsInMs)) > 0;
  char byte = 0;
  return answers && recv(waiting.fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0; // false: connection closed
}

} // namespace rung::io
