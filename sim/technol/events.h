// Events for which the control calls a procedure of the program, if it has one (man. l.1609-1644).
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rtlib/core/queues.h"
#include "rtlib/run/instance.h"
#include "sim/simulated_nc.h"

namespace rung::sim::technol {

// Returns the number of a PLC constant by its identifier.
using ConstantOf = std::function<std::optional<int64_t>(std::string_view)>;

// The value of DR in _ON_CMD for a command code, which has 32 bits.
constexpr uint64_t commandRegister(int64_t code) {
  return static_cast<uint64_t>(static_cast<int64_t>(static_cast<int32_t>(code)));
}

// The names of the events that callEvent knows.
std::vector<std::string_view> programEvents();
// PLCEVENT_... calls _ON_EVENT, PLCCOMMAND calls _ON_CMD. Returns "", or the error; nothing if the name is not such an
// event.
std::optional<std::string> callEvent(runtime::Instance& instance, std::string_view name,
                                     std::span<const NcArgument> keys, const ConstantOf& constantOf);

// Effects of late answers on the interface cells: SPI_AX ends with POLOHV_x, CAN_AX_SEND with CAN_AX_BUSY and the
// packet of the drive (man. l.7964, l.9474-9493).

// Called between two scans.
void showLateAnswer(runtime::Instance& instance, const core::ServiceRequest& request, std::string_view bytes);

} // namespace rung::sim::technol
