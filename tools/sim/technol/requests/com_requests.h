// COM_*: serial ports of the simulated control (man. ch. 23.3).
#pragma once
#include <string_view>

#include "tools/sim/technol/devices/com.h"
#include "tools/sim/technol/requests/device_call.h"

namespace rung::sim::technol {

// What a request asks for; None: no such service.
enum class ComOrder : uint8_t { None, Send, SendText, Receive, Control };
ComOrder comOrder(std::string_view service);
void answerCom(ComPorts& ports, ComOrder order, DeviceCall& call);

} // namespace rung::sim::technol
