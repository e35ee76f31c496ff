// A drive with the profile CiA 402: derives the status word from its control word (TECHNOL manual, l.17819-17868,
// l.10205-10216; status bits as in CiA 402). A step is the time in which a drive responds.
#pragma once
#include <cstdint>

namespace rung::sim::technol {

// Control words (6040h).
inline constexpr uint16_t kControlShutdown = 0x06; // VOLT, QSTOP
inline constexpr uint16_t kControlSwitchOn = 0x07; // plus ON
inline constexpr uint16_t kControlEnable = 0x0F;
inline constexpr uint16_t kControlFaultReset = 0x80;
// Status words (6041h), by the bits that identify a state.
inline constexpr uint16_t kStatusMask = 0x6F;
inline constexpr uint16_t kSwitchOnDisabled = 0x40;
inline constexpr uint16_t kReadyToSwitchOn = 0x21;
inline constexpr uint16_t kSwitchedOn = 0x23;
inline constexpr uint16_t kOperationEnabled = 0x27;
inline constexpr uint16_t kQuickStop = 0x07;
inline constexpr uint16_t kFault = 0x08;

class Ds402Drive {
public:
  void powerOn() { *this = {}; }
  void step(uint16_t control);
  // Sets error code 603Fh; the drive switches off until a fault reset (rising edge of bit 7). 0: nothing.
  void fault(uint16_t code);

  uint16_t status() const { return status_; }
  uint16_t error() const { return error_; }

  template <class Archive>
  void state(Archive& archive) {
    archive(status_, error_, control_);
  }

private:
  uint16_t status_ = kSwitchOnDisabled;
  uint16_t error_ = 0;
  uint16_t control_ = 0; // in the previous step
};

} // namespace rung::sim::technol
