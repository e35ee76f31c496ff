// The coils and registers of a server, and which of them a client may read and write.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include <modbus.h>

#include "machine/io/connections/exchange.h"
#include "machine/io/connections/modbus_request.h"

namespace rung::io {

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
  // As if nobody had written them, but for those that hold their values.
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

} // namespace rung::io
