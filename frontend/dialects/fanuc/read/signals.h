// Signals of the CNC's interface.
#pragma once
#include <string>
#include <string_view>

namespace rung::frontend::fanuc {

// What a signal's name, or an address, means; "" if the word is neither.
std::string explainWord(std::string_view word);

} // namespace rung::frontend::fanuc
