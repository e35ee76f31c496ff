// Where the value of a HAL pin is, and how it is read and written. HAL redirects these pointers when a pin is linked to
// a signal, so they lie in HAL's memory and are read anew in every scan.
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

// A value of a pin, or of a constant.
union Value {
  bool bit;
  int32_t s32;
  uint32_t u32;
  double real = 0;
};

// By the type of the pin. A host whose cells are not as wide as their types has its own.
struct PinAccess {
  Value (*read)(PinType type, const PinCell& cell) noexcept;
  void (*write)(PinType type, const PinCell& cell, const Value& value) noexcept;
};

// Cells that point to variables of the pins' types.
extern const PinAccess kVariables;

// The pins of a map as a step sees them: each is read once before it, and written once after it where it was set, so
// that all that looks at a pin within a step finds the same value. One thread at a time.

class Pins {
public:
  // Their values begin with 0.
  explicit Pins(const std::vector<host::Pin>& pins);
  // As many cells as there are pins, in their order; cells and access outlive this.
  void connect(const PinCell* cells, const PinAccess& access) noexcept;
  bool connected() const noexcept { return cells_ != nullptr; }

  // Those that bring something to the program; they are connected.
  void read() noexcept;
  // All of them, as they are on the other side.
  void look(std::span<Value> values) const noexcept;
  // Those that have been set since; they are connected.
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
