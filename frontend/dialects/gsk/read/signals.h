// The signals of the CNC, the panel and the hand-held units as predeclared names (man. Part I §3, Part II). In operand
// position every symbol of the table is a name as it is printed, `*ESP`, `+J1` and `RST` too; only T00 to T31 are not:
// they are addresses of area T.
#pragma once
#include <string>
#include <string_view>

#include "frontend/network/read/context.h"

namespace rung::frontend::gsk {

// The milling control GSK25iMc or the turning control GSK25iTc.
enum class Machine : uint8_t { Any, Mill, Turn };

// Warns of each signal that the given machine does not have, where an operand is that signal or a bit of it.
void watchSignals(network::Context& context, Machine machine);

// What `rungc explain` says about a signal's name or the address of signals, of any case, or a word of command lists;
// "" when it is neither.
std::string explainWord(std::string_view word);

} // namespace rung::frontend::gsk
