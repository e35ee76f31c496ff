// A message of the program as an operator reads it.
#pragma once
#include <string>

#include "rtlib/nc/control/shown_message.h"
#include "rung/program.h"

namespace rung::console {

// "message 12 (channel 1, index 0) \"text\"", TECHNOL as in its log.
std::string messageText(const rung_program& program, const nc::ShownMessage& message);

} // namespace rung::console
