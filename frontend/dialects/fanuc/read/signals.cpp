// See signals.h.
#include "frontend/dialects/fanuc/read/signals.h"

#include <fmt/format.h>

#include "frontend/dialects/fanuc/areas.h"
#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/read/mnemonic.h"
#include "frontend/network/explain.h"

namespace rung::frontend::fanuc {

namespace {

// "with memory C and larger this is Z91.1": the other address of a place in the system area.
std::string otherAddress(const network::Address& address) {
  const auto moved = [&](Pmc from, Pmc to, std::string_view memories) {
    const network::Address begin = systemArea(from);
    if (address.area != begin.area || address.byte - begin.byte >= kSystemBytes) return std::string();
    network::Address other = address;
    other.area = systemArea(to).area;
    other.byte = address.byte - begin.byte + systemArea(to).byte;
    return fmt::format("  {} this is {}\n", memories, textOf(languageOf(Pmc::MemD), other));
  };
  return moved(Pmc::MemB, Pmc::MemC, "with memory C and larger") + moved(Pmc::MemC, Pmc::MemB, "with memory A and B");
}

// What the control keeps at an address; "" if nothing.
std::string controlPlace(std::string_view word) {
  const network::Language& language = languageOf(Pmc::MemD);
  const std::optional<network::Address> written = network::parseAddress(language, word);
  if (!written) return {};
  network::Address address = *written;
  if (address.area == systemArea(Pmc::MemC).area) {
    address.area = systemArea(Pmc::MemB).area;
    address.byte += systemArea(Pmc::MemB).byte;
  }
  std::string text;
  for (const ControlPlace& place : controlPlaces()) {
    if (!place.has(address)) continue;
    const std::string bit = place.bit >= 0 && !address.isBit ? fmt::format(".{}", place.bit) : "";
    text += fmt::format("[fanuc] {}{}: {}\n", textOf(language, *written), bit, place.doc);
  }
  return text.empty() ? text : text + otherAddress(*written);
}

} // namespace

// The largest memory has all addresses.
std::string explainWord(std::string_view word) {
  if (isNetworkNumber(word)) return fmt::format("[fanuc] {}: the number of a network, which has no effect\n", word);
  if (std::string place = controlPlace(word); !place.empty()) return place;
  return network::explainWord(languageOf(Pmc::MemD), word);
}

} // namespace rung::frontend::fanuc
