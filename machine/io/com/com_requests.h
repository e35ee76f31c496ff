// COM_*: serial ports (man. ch. 23.3).
#pragma once
#include <string_view>

#include "machine/io/com/port.h"
#include "machine/io/device_call.h"

namespace rung::io {

// What a request asks for; None: no such service.
enum class ComOrder : uint8_t { None, Send, SendText, Receive, Control };
ComOrder comOrder(std::string_view service);
inline uint32_t comOf(const DeviceCall& call) { return call.number(0); }
// Of the port that the request is for; null: no port of this number.
void answerCom(com::Port* port, ComOrder order, DeviceCall& call);

} // namespace rung::io
