// See external_data.h.
#include "sim/pmc/external_data.h"

namespace rung::sim::pmc {

// Handshake: the strobe, then EREND when the data have been read, and ESEND when the function has been executed; both
// fall with the strobe.
void ExternalData::step(const nc::pmc::SignalsIo& io, Machine& machine, Operation& operation, bool resetting) {
  const Cnc& cnc = *machine.cnc;
  const bool start = io.g(cnc.externalAddress, 7);
  if (!start) phase_ = Phase::Idle;
  bool cancelled = io.f(60, 2) && start;
  if (start && phase_ == Phase::Idle && !resetting) {
    address_ = io.gByte(cnc.externalAddress) & 0x7F;
    data_ = cnc.externalBytes == 4 ? io.gDword(0) : io.gWord(0);
    phase_ = Phase::Read;
  } else if (phase_ == Phase::Read || phase_ == Phase::Waiting) {
    if (resetting && machine.tables.parameterBit(cnc.parameters.cancelExternal)) { // l.7533-7537
      cancelled = true;
      phase_ = Phase::Done;
    } else {
      phase_ = carryOut(io, machine, operation) ? Phase::Done : Phase::Waiting;
    }
  }
  io.setF(60, 0, phase_ != Phase::Idle);
  io.setF(60, 1, phase_ == Phase::Done && !cancelled);
  io.setF(60, 2, cancelled);
}

// False: the function waits for its condition.
bool ExternalData::carryOut(const nc::pmc::SignalsIo& io, Machine& machine, Operation& operation) {
  const uint32_t kind = address_ >> 4;
  const uint32_t low = address_ & 0xF;
  const Cnc& cnc = *machine.cnc;
  const int64_t step = cnc.externalBytes == 4 ? static_cast<int32_t>(data_) : static_cast<int16_t>(data_);
  const int64_t value = step * cnc.externalUnits;
  switch (kind) {
  case 0: { // program search, in an automatic mode at rest (l.7545)
    const Mode needed =
        (cnc.externalMdi.byte != 0 && io.g(cnc.externalMdi.byte, cnc.externalMdi.bit)) ? Mode::Mdi : Mode::Auto;
    if (operation.mode() != needed || operation.state() != RunState::Reset) return false;
    operation.select(data_, needed == Mode::Mdi);
    return true;
  }
  case 1: machine.tables.set(Table::ToolOffset, low, 0, value); return true;
  case 2: // the axis from 0 (P58)
    if (low < kAxes) machine.tables.set(Table::WorkOffset, 0, low, value);
    return true;
  case 6:
  case 7: ((low & 1) == 0 ? preset_ : parts_) = data_; return true;
  default: return true;
  }
}

} // namespace rung::sim::pmc
