// The messages of a FANUC program by their numbers, which begin their texts: "1000 DOOR OPEN".
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "rung/program.h"

namespace rung::nc::fanuc {

// 0 for a text without a number.
uint32_t messageNumber(std::string_view text);

// The address that shows the message which the screen calls `word`, "1000" or "EX1000"; "" if the program has none.
std::string addressOfMessage(const rung_program& program, std::string_view word);

} // namespace rung::nc::fanuc
