// Access to the values of HAL pins. HAL redirects the pointers when a pin is linked to a signal, so they lie in HAL's
// memory and are read again in every scan.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "machine/host/mapping_file.h"

namespace rung::host {

union PinCell {
  volatile bool* bit;
  volatile int32_t* s32;
  volatile uint32_t* u32;
  volatile double* real;
  void* any;
};

// The value of a pin or of a constant.
union Value {
  bool bit;
  int32_t s32;
  uint32_t u32;
  double real = 0;
};

// Functions that read and write pins, by type. A host whose pin cells have other widths than PinCell supplies its own.
struct PinAccess {
  Value (*read)(PinType type, const PinCell& cell) noexcept;
  void (*write)(PinType type, const PinCell& cell, const Value& value) noexcept;
};

// For cells that point to variables of the pins' types.
extern const PinAccess kVariables;

// The pins of a map in one step of the host: each input is read once before the step, and each output that was set is
// written once after it, so that all code within a step sees the same values. Used by one thread at a time.

class Pins {
public:
  // All values are 0 at first.
  explicit Pins(const std::vector<host::Pin>& pins);
  // `cells` has one cell per pin, in the order of the pins; cells and access must outlive this object.
  void connect(const PinCell* cells, const PinAccess& access) noexcept;
  bool connected() const noexcept { return cells_ != nullptr; }

  // Reads the pins that are inputs of the program. The pins must be connected.
  void read() noexcept;
  // Reads the current HAL values of all pins.
  void look(std::span<Value> values) const noexcept;
  // Writes the pins that were set since the last call. The pins must be connected.
  void write() noexcept;

  const Value& operator[](uint32_t pin) const noexcept { return pins_[pin].value; }
  void set(uint32_t pin, const Value& value) noexcept {
    pins_[pin].value = value;
    pins_[pin].isSet = true;
  }

private:
  struct Pin {
    Value value;
    PinType type{};
    bool isInput = false;
    bool isSet = false;
  };
  std::vector<Pin> pins_;
  const PinCell* cells_ = nullptr;
  const PinAccess* access_ = &kVariables;
};

} // namespace rung::host
