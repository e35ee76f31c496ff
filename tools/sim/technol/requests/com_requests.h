// COM_*: serial ports of the simulated control (man. ch. 23.3).
#pragma once
#include <string_view>

#include "tools/sim/technol/devices/com.h"
#include "tools/sim/technol/requests/device_call.h"

namespace rung::sim::technol {

// False: another service.
bool answerCom(ComPorts& ports, std::string_view service, DeviceCall& call);

} // namespace rung::sim::technol
