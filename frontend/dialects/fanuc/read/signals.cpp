// See signals.h.
#include "frontend/dialects/fanuc/read/signals.h"

#include <fmt/format.h>

#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/read/mnemonic.h"
#include "frontend/network/explain.h"

namespace rung::frontend::fanuc {

// The largest memory has all addresses.
std::string explainWord(std::string_view word) {
  if (isNetworkNumber(word)) return fmt::format("[fanuc] {}: the number of a network, which has no effect\n", word);
  return network::explainWord(languageOf(Pmc::MemD), word);
}

} // namespace rung::frontend::fanuc
