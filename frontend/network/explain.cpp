// See explain.h.
#include "frontend/network/explain.h"

#include <fmt/format.h>

#include "frontend/network/address.h"
#include "rtlib/nc/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {

std::string explainWord(const Language& language, std::string_view word,
                        std::string (*sourceOf)(const nc::Signal& signal)) {
  const auto textOfSignal = [&](const nc::Signal& signal) {
    const Address address = addressOf(language, signal);
    const uint32_t bytes = bytesOf(signal);
    const std::string width = address.isBit ? "" : bytes == 1 ? " (1 byte)" : fmt::format(" ({} bytes)", bytes);
    return fmt::format("[{}] {}: {}{}, {}\n  {}\n{}", language.name, signal.symbol, textOf(language, address), width,
                       language.at(address.area).doc, nc::meaningWithNote(signal),
                       sourceOf == nullptr ? "" : fmt::format("  {}\n", sourceOf(signal)));
  };
  std::string text;
  for (const nc::Signal& signal : language.signals())
    if (text::equalsIgnoringCase(signal.symbol, word)) text += textOfSignal(signal);
  const std::optional<Address> address = parseAddress(language, word);
  if (!address || language.at(address->area).room(address->byte) == 0) return text;
  const size_t before = text.size();
  for (const nc::Signal& signal : language.signals())
    if (covers(language, signal, *address)) text += textOfSignal(signal);
  if (text.size() == before)
    text += fmt::format("[{}] {}: area {} ({}), not a signal of the CNC\n", language.name, textOf(language, *address),
                        language.at(address->area).letter, language.at(address->area).doc);
  return text;
}

} // namespace rung::frontend::network
