// The signals of the CNC, the panel and the hand-held units as predeclared names (man. Part I §3, Part II). In operand
// position every symbol of the table is a name as it is printed, `*ESP`, `+J1` and `RST` too; only T00 to T31 are not:
// they are addresses of area T.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "frontend/dialects/gsk/read/address.h"
#include "rtlib/nc/signal.h"

namespace rung::gsk {

// The milling control GSK25iMc or the turning control GSK25iTc.
enum class Machine : uint8_t { Any, Mill, Turn };

// Letters count as they are printed.
const nc::Signal* findSignalByName(std::string_view name);
Address signalAddress(const nc::Signal& signal);

// A signal that the given machine does not have, where an operand of `length` bytes is that signal or a bit of it; null
// when there is none.
const nc::Signal* foreignSignal(Machine machine, const Address& address, uint32_t length);

// A signal whose name is like a misspelt one; null when there is none.
const nc::Signal* similarSignal(std::string_view name);

// What `rungc explain` says about a signal's name or the address of signals, of any case; "" when it is neither.
std::string explainSignal(std::string_view word);

} // namespace rung::gsk
