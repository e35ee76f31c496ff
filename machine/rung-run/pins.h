// The pins of a mapping file in the memory of the process.
#pragma once
#include <cstdint>
#include <vector>

#include "machine/host/box.h"

namespace rung::rung_run {

class Pins {
public:
  // Connects the box, which ends after it.
  explicit Pins(host::Box& box) : values_(box.pins().size()) {
    for (Value& value : values_) cells_.push_back({.any = &value});
    cells_.push_back({}); // a box without pins has cells, too
    box.connect(cells_.data());
  }
  Pins(const Pins&) = delete;
  Pins& operator=(const Pins&) = delete;

  // In the order of the map, and one more.
  const host::PinCell* cells() const noexcept { return cells_.data(); }

private:
  union Value {
    bool bit;
    int32_t s32;
    uint32_t u32;
    double real = 0;
  };
  std::vector<Value> values_;
  std::vector<host::PinCell> cells_;
};

} // namespace rung::rung_run
