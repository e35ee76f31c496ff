// Inputs that follow outputs (see wiring.h).
#include "sim/nct/wiring.h"

#include "rtlib/nc/config_key.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::sim::nct {

// NAME, NAME.BB of a double word, with ,#INDEX after it.
std::optional<Wiring::Place> Wiring::place(std::string_view name) {
  const size_t comma = std::min(name.find(",#"), name.size());
  const auto index =
      comma == name.size() ? std::optional<uint32_t>(0) : text::numberIn<uint32_t>(name.substr(comma + 2));
  name = name.substr(0, comma);
  const size_t dot = std::min(name.find('.'), name.size());
  const nc::Signal* signal = findSignal(nc::nctSignals(), name.substr(0, dot));
  const bool isBit = signal != nullptr && signal->type == nc::SignalType::Bit;
  const auto bit = dot == name.size() ? std::optional<uint32_t>(isBit ? signal->bit : 32)
                                      : text::numberIn<uint32_t>(name.substr(dot + 1));
  if (signal == nullptr || !index || *index >= signal->count || !bit || *bit > 31) return std::nullopt;
  if (isBit != (dot == name.size()) || signal->type == nc::SignalType::Real) return std::nullopt;
  return Place{(signal->byteOffset + *index * signal->strideBytes) / 4, *bit};
}

Handled Wiring::config(std::string_view key, std::string_view value) {
  constexpr std::string_view kPrefix = "follow.";
  if (!key.starts_with(kPrefix)) return std::nullopt;
  Wire wire;
  const auto input = place(key.substr(kPrefix.size()));
  const size_t at = std::min(value.find('@'), value.size());
  wire.inverted = value.starts_with('/');
  const auto source = place(value.substr(wire.inverted ? 1 : 0, at - (wire.inverted ? 1 : 0)));
  wire.delayUs = at == value.size() ? 0 : nc::durationUs(value.substr(at + 1));
  if (!input) return std::string(key) + ": expected the bit of a signal after 'follow.'";
  if (!source || wire.delayUs < 0)
    return std::string(key) + ": expected a bit such as OUT010.00, /OUT010.00 or OUT010.00@100ms, found '" +
           std::string(value) + "'";
  wire.input = *input;
  wire.source = *source;
  wires_.push_back(wire);
  return "";
}

// Everything has been as it is for long.
void Wiring::powerOn(nc::PowerOn) {
  for (Wire& wire : wires_) {
    wire.level = links().signals.bit(wire.source.word, wire.source.bit);
    wire.sinceUs = links().nowUs - wire.delayUs;
    links().signals.setBit(wire.input.word, wire.input.bit, wire.level != wire.inverted);
  }
}

void Wiring::timeSlice() {
  const SignalMemory& signals = links().signals;
  for (Wire& wire : wires_) {
    const bool level = signals.bit(wire.source.word, wire.source.bit);
    if (level != wire.level) {
      wire.level = level;
      wire.sinceUs = links().nowUs;
    }
    if (links().nowUs - wire.sinceUs >= wire.delayUs)
      signals.setBit(wire.input.word, wire.input.bit, level != wire.inverted);
  }
}

} // namespace rung::sim::nct
