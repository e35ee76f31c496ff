// The requests of Modbus TCP that a server takes, as bytes: whole messages, and what they ask for. Nothing here trusts
// the other side.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <modbus.h>

#include "machine/host/mapping_file.h"
#include "machine/io/connections/connections.h"

namespace rung::io {

inline constexpr size_t kLongestMessage = 260; // bytes, with its header

enum class Exception : uint8_t { None = 0, Function = 1, Address = 2, Value = 3 };

// The bytes of the message that `bytes` begin with: 0 where too few are there to know. Nothing: it is not a request of
// Modbus TCP, and what comes after it cannot be understood.
std::optional<size_t> messageLength(std::span<const uint8_t> bytes);

struct Request {
  host::Area area = host::Area::Coil;
  bool writes = false;
  uint32_t first = 0;              // of the places
  uint32_t count = 0;              // `first` + `count` is at most 65536
  std::span<const uint8_t> values; // of registers that are written, two bytes each, the high one first
};

// `message` is a whole one. What is wrong with it, or None and `request`.
Exception parseRequest(std::span<const uint8_t> message, Request& request);

// The coils and registers of a server, and which of them a client may read and write.

// For the thread of the server.
class ModbusImage {
public:
  // Throws std::bad_alloc. Inputs begin with their safe values.
  explicit ModbusImage(Exchange& exchange);

  // Every place that is asked for must be a pin's; what is written must be of inputs, values in their whole length, and
  // numbers.
  Exception check(const Request& request) const;
  // The outputs as they are now, before a client reads them.
  void refreshOutputs();
  // Of all inputs, in their order, as clients have written them.
  const std::vector<double>& inputs();
  // As if they had not been written, except those that hold their values.
  void resetInputs();
  modbus_mapping_t* tables() noexcept { return tables_.get(); }

private:
  // Marks of a place, from bits.
  static constexpr uint8_t kThere = 1, kInput = 2, kFirst = 4, kLast = 8;
  struct Free {
    void operator()(modbus_mapping_t* tables) const noexcept { modbus_mapping_free(tables); }
  };
  std::vector<uint8_t>& marks(host::Area area) { return marks_[static_cast<size_t>(area)]; }
  const std::vector<uint8_t>& marks(host::Area area) const { return marks_[static_cast<size_t>(area)]; }
  void mark(const ExchangedPin& pin, bool isInput);
  bool writesNumbers(const Request& request) const;
  void set(const ExchangedPin& pin, double value);
  double get(const ExchangedPin& pin) const;
  uint16_t* registers(host::Area area) const;
  uint8_t* bits(host::Area area) const;

  Exchange& exchange_;
  std::vector<uint8_t> marks_[4]; // by Area, by place
  std::unique_ptr<modbus_mapping_t, Free> tables_;
  std::vector<double> inputs_;
};

// Values of pins as registers of Modbus and as bytes of memory.

// An integer is rounded, and limited to the format.
void toRegisters(const ExchangedPin& pin, double value, uint16_t* registers) noexcept;
// Limited to the type of the pin. Nothing: what is there is not a number.
std::optional<double> fromRegisters(const ExchangedPin& pin, const uint16_t* registers) noexcept;

// The byte order is the machine's; a bit is a byte.
void toBytes(const ExchangedPin& pin, double value, uint8_t* bytes) noexcept;
std::optional<double> fromBytes(const ExchangedPin& pin, const uint8_t* bytes) noexcept;

} // namespace rung::io
