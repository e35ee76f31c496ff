// Texts about signals and other predefined names, for the reference and for `rungc explain`.
#pragma once
#include <string>
#include <string_view>

#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::frontend::nct {

// The signal at an index of `words` words from the signal's place, if that is another signal; otherwise null.
const nc::Signal* signalAfter(const nc::Signal& signal, int64_t words);
std::string_view typeText(const nc::Signal& signal); // "bit", "double word", "double"
std::string indexText(const nc::Signal& signal);     // "#0 to #31 (axis)"; "-" if there is only one
std::string placeText(const nc::Signal& signal);     // "MKBTNS0.05"; "-" for words and bits of words without name
std::string parameterText(const nc::nct::ScopeParameter& parameter);

} // namespace rung::frontend::nct
