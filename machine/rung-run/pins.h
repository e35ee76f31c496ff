// The pins of a mapping file in the memory of the process.
#pragma once
#include <cstdint>
#include <vector>

#include "machine/host/plc_host.h"

namespace rung::rung_run {

class Pins {
public:
  // Connects the host, which must be destroyed before this object.
  explicit Pins(host::PlcHost& host) : values_(host.pins().size()) {
    for (Value& value : values_) cells_.push_back({.any = &value});
    cells_.push_back({}); // so that a host without pins gets a pointer, too
    host.connect(cells_.data());
  }
  Pins(const Pins&) = delete;
  Pins& operator=(const Pins&) = delete;

  // One cell per pin, in the order of the map, and one more.
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
