// What an answer that comes later than its instruction does in the interface: SPI_AX ends with POLOHV_x, CAN_AX_SEND
// with CAN_AX_BUSY and the packet of the drive (man. l.7964, l.9474-9493).
#pragma once
#include <string_view>

#include "rtlib/core/queues.h"
#include "rtlib/run/instance.h"

namespace rung::sim::technol {

// Between two scans.
void showLateAnswer(runtime::Instance& instance, const core::ServiceRequest& request, std::string_view bytes);

} // namespace rung::sim::technol
