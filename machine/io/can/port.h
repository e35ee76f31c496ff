// What a logical channel is connected to: a simulated bus or an interface of the machine.
#pragma once
#include "machine/io/can/channel.h"

namespace rung::io {

// Called by the scan's thread: nothing waits.
class CanPort {
public:
  virtual ~CanPort() = default;
  virtual BusState state() const = 0;
  // False: there is no room, or the bus takes nothing.
  virtual bool transmit(const CanPacket& packet) = 0;
  // The oldest packet that has come; false: none.
  virtual bool receive(CanPacket& packet) = 0;
};

} // namespace rung::io
