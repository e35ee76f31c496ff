// What a word means in a language: signals of the control and addresses (`rungc explain`).
#pragma once
#include <string>
#include <string_view>

#include "frontend/network/language.h"
#include "rtlib/nc/signal.h"

namespace rung::frontend::network {

// The meaning of a signal's name, or of an address, in upper or lower case; "" for any other word. `sourceOf`: the last
// line about a signal, where it is described; null for none.
std::string explainWord(const Language& language, std::string_view word,
                        std::string (*sourceOf)(const nc::Signal& signal) = nullptr);

} // namespace rung::frontend::network
