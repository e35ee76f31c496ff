// External data input of the simulated CNC: program search, tool and work offsets, part count, from G0-G3 and G13
// (man. §9.1, l.7474-7564).
#pragma once
#include "sim/gsk/machine.h"
#include "sim/gsk/operation.h"

namespace rung::sim::gsk {

class ExternalData {
public:
  void step(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation, bool resetting);
  uint32_t parts() const { return parts_; }
  uint32_t partsPreset() const { return preset_; }

private:
  enum class Phase : uint8_t { Idle, Read, Waiting, Done };
  bool carryOut(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation);

  Phase phase_ = Phase::Idle;
  uint8_t address_ = 0; // EA0-EA6
  uint32_t data_ = 0;   // ED0-ED31
  uint32_t parts_ = 0;
  uint32_t preset_ = 0;
};

} // namespace rung::sim::gsk
