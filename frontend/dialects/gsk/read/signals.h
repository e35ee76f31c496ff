// The signals of the CNC, the panel and the hand-held units as predeclared names (man. Part I §3, Part II). In operand
// position every symbol of the table is a name as printed, including `*ESP`, `+J1` and `RST`; except T00 to T31, which
// are addresses of area T.
#pragma once
#include <string>
#include <string_view>

#include "frontend/network/read/context.h"

namespace rung::frontend::gsk {

// The milling control GSK25iMc or the turning control GSK25iTc.
enum class Machine : uint8_t { Any, Mill, Turn };

// Warns of each operand that is a signal, or a bit of one, that the given machine does not have.
void watchSignals(network::Context& context, Machine machine);

// The text of `rungc explain` about a signal's name, an address of signals, in upper or lower case, or a word of
// command lists; "" for any other word.
std::string explainWord(std::string_view word);

} // namespace rung::frontend::gsk
