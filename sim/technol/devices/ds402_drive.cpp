// A drive by CiA 402 (see ds402_drive.h).
#include "sim/technol/devices/ds402_drive.h"

namespace rung::sim::technol {
namespace {

// One transition of CiA 402.
uint16_t next(uint16_t status, uint16_t control) {
  const bool voltage = (control & 0x02) != 0;
  const bool quickStop = (control & 0x04) == 0; // low active
  if (!voltage) return kSwitchOnDisabled;
  if (quickStop) return status == kOperationEnabled || status == kQuickStop ? kQuickStop : kSwitchOnDisabled;
  const bool on = (control & 0x01) != 0, enable = (control & 0x08) != 0;
  switch (status) {
  case kSwitchOnDisabled: return on ? kSwitchOnDisabled : kReadyToSwitchOn; // not before ON has been 0
  case kReadyToSwitchOn: return on ? kSwitchedOn : kReadyToSwitchOn;
  case kSwitchedOn:
  case kOperationEnabled:
    if (!on) return kReadyToSwitchOn;
    return enable ? kOperationEnabled : kSwitchedOn;
  case kQuickStop: return on && enable ? kOperationEnabled : kQuickStop;
  default: return status;
  }
}

} // namespace

void Ds402Drive::fault(uint16_t code) {
  if (code == 0) return;
  error_ = code;
  status_ = kFault;
}

void Ds402Drive::step(uint16_t control) {
  const bool reset = (control & ~control_ & kControlFaultReset) != 0;
  control_ = control;
  if (status_ != kFault) {
    status_ = next(status_, control);
  } else if (reset) {
    status_ = kSwitchOnDisabled;
    error_ = 0;
  }
}

} // namespace rung::sim::technol
