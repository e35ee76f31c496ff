// See signals.h.
#include "frontend/dialects/fanuc/read/signals.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/language.h"
#include "frontend/network/address.h"
#include "rtlib/nc/fanuc/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::fanuc {
namespace {

// The largest memory has all addresses.
const network::Language& language() { return languageOf(Pmc::MemD); }

std::string textOf(const nc::Signal& signal) {
  const network::Address address = addressOf(language(), signal);
  return fmt::format("[fanuc] {}: {}, {}\n  {}\n", signal.symbol, textOf(language(), address),
                     language().at(address.area).doc, signal.meaning);
}

bool covers(const nc::Signal& signal, const network::Address& address) {
  const network::Address own = addressOf(language(), signal);
  const uint32_t bytes = std::max(1u, nc::elementBytes(signal.type));
  if (own.area != address.area || address.byte < own.byte || address.byte >= own.byte + bytes) return false;
  return !own.isBit || !address.isBit || own.bit == address.bit;
}

} // namespace

std::string explainWord(std::string_view word) {
  std::string text;
  for (const nc::Signal& signal : nc::fanucSignals())
    if (text::equalsIgnoringCase(signal.symbol, word)) text += textOf(signal);
  const auto split = network::splitAddress(language(), word);
  if (!split || language().at(split->area).room(split->byte) == 0) return text;
  network::Address address{split->area, static_cast<uint32_t>(split->byte), 0, split->hasPoint};
  if (split->hasPoint) {
    if (split->bit.size() != 1 || split->bit[0] < '0' || split->bit[0] > '7') return text;
    address.bit = static_cast<uint8_t>(split->bit[0] - '0');
  }
  const size_t before = text.size();
  for (const nc::Signal& signal : nc::fanucSignals())
    if (covers(signal, address)) text += textOf(signal);
  if (text.size() == before)
    text += fmt::format("[fanuc] {}: area {} ({}), not a signal of the CNC\n", textOf(language(), address),
                        language().at(address.area).letter, language().at(address.area).doc);
  return text;
}

} // namespace rung::frontend::fanuc
