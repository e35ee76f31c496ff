// Parser of the Modbus TCP requests that a server accepts: message boundaries and contents. All bytes are untrusted.
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

inline constexpr size_t kLongestMessage = 260; // bytes, including the header

enum class Exception : uint8_t { None = 0, Function = 1, Address = 2, Value = 3 };

// The length of the message at the beginning of `bytes`; 0 if there are too few bytes to know. Nothing: it is not a
// Modbus TCP request, so the following bytes cannot be understood either.
std::optional<size_t> messageLength(std::span<const uint8_t> bytes);

struct Request {
  host::Area area = host::Area::Coil;
  bool writes = false;
  uint32_t first = 0;              // first address
  uint32_t count = 0;              // number of addresses; `first` + `count` is at most 65536
  std::span<const uint8_t> values; // of registers to be written, two bytes each, high byte first
};

// Parses a complete message. Returns the exception for an error, or None and `request`.
Exception parseRequest(std::span<const uint8_t> message, Request& request);

// The coils and registers of a server, and which of them a client may read and write.

// Used only by the thread of the server.
class ModbusImage {
public:
  // Throws std::bad_alloc. Inputs have their safe values at first.
  explicit ModbusImage(Exchange& exchange);

  // Checks a request: every address must belong to a pin; written addresses must belong to inputs and contain complete,
  // finite values.
  Exception check(const Request& request) const;
  // Copies the newest outputs, before a client reads them.
  void refreshOutputs();
  // All inputs, in their order, as written by clients.
  const std::vector<double>& inputs();
  // Resets all inputs to their safe values, except those that hold their values.
  void resetInputs();
  modbus_mapping_t* tables() noexcept { return tables_.get(); }

private:
  // Marks of an address: combinations of these bits.
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
  std::vector<uint8_t> marks_[4]; // by Area and address
  std::unique_ptr<modbus_mapping_t, Free> tables_;
  std::vector<double> inputs_;
};

// Conversion of pin values to Modbus registers and to bytes of memory.

// Integers are rounded and limited to the format.
void toRegisters(const ExchangedPin& pin, double value, uint16_t* registers) noexcept;
// The result is limited to the type of the pin. Nothing: the registers do not contain a finite number.
std::optional<double> fromRegisters(const ExchangedPin& pin, const uint16_t* registers) noexcept;

// Native byte order; a bit is one byte.
void toBytes(const ExchangedPin& pin, double value, uint8_t* bytes) noexcept;
std::optional<double> fromBytes(const ExchangedPin& pin, const uint8_t* bytes) noexcept;

} // namespace rung::io
