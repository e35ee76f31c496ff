// External data input of the simulated CNC: program search, tool and work offsets, part count (GSK's man. §9.1,
// l.7474-7564).
#pragma once
#include "sim/pmc/machine.h"
#include "sim/pmc/operation.h"

namespace rung::sim::pmc {

class ExternalData {
public:
  void step(const nc::pmc::SignalsIo& io, Machine& machine, Operation& operation, bool resetting);
  uint32_t parts() const { return parts_; }
  uint32_t partsPreset() const { return preset_; }

  template <class Archive>
  void state(Archive& archive) {
    archive(phase_, address_, data_, parts_, preset_);
  }

private:
  enum class Phase : uint8_t { Idle, Read, Waiting, Done };
  bool carryOut(const nc::pmc::SignalsIo& io, Machine& machine, Operation& operation);

  Phase phase_ = Phase::Idle;
  uint8_t address_ = 0; // EA0-EA6
  uint32_t data_ = 0;
  uint32_t parts_ = 0;
  uint32_t preset_ = 0;
};

} // namespace rung::sim::pmc
