// External data input (see external_data.h).
#include "sim/gsk/external_data.h"

namespace rung::sim::gsk {

// ESTC, then EREND when the data have been read, ESEND when the function is carried out; both fall with ESTC.
void ExternalData::step(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation, bool resetting) {
  const bool start = io.g(13, 7);
  if (!start) phase_ = Phase::Idle;
  bool cancelled = io.f(60, 2) && start;
  if (start && phase_ == Phase::Idle && !resetting) {
    address_ = io.gByte(13) & 0x7F;
    data_ = io.gDword(0);
    phase_ = Phase::Read;
  } else if (phase_ == Phase::Read || phase_ == Phase::Waiting) {
    if (resetting && machine.tables.parameterBit(kParamExternal, 7)) { // l.7533-7537
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
bool ExternalData::carryOut(const nc::gsk::SignalsIo& io, Machine& machine, Operation& operation) {
  const uint32_t kind = address_ >> 4;
  const uint32_t low = address_ & 0xF;
  const int64_t value = static_cast<int32_t>(data_);
  switch (kind) {
  case 0: { // program search, in an automatic mode at rest (l.7545)
    const Mode needed = io.g(85, 0) ? Mode::Mdi : Mode::Auto;
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

} // namespace rung::sim::gsk
