// Inputs that follow axes and bits (see input_wiring.h).
#include "sim/technol/requests/input_wiring.h"

#include <algorithm>

#include "rtlib/nc/config_key.h"
#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/number.h"

namespace rung::sim::technol {
namespace {

struct NamedBit {
  std::string_view cell;
  std::optional<uint32_t> number; // of a cell
};
NamedBit parts(std::string_view name) {
  const size_t dot = std::min(name.find('.'), name.size());
  if (dot == name.size()) return {name, std::nullopt};
  return {name.substr(0, dot), text::numberIn<uint32_t>(name.substr(dot + 1))};
}

bool isBit(std::string_view name) {
  const auto [cell, number] = parts(name);
  const nc::Signal* signal = nc::findSignal(nc::technolSignals(), cell, "I");
  if (signal == nullptr) return false;
  if (cell.size() == name.size()) return signal->type == nc::SignalType::Bit;
  return number && *number < 8 * nc::elementBytes(signal->type);
}

core::Place placeOf(const rung_program& program, std::string_view name) {
  const auto [cell, number] = parts(name);
  auto place = nc::technol::signalPlace(program, cell);
  if (place && number) place = runtime::bitOf(*place, *number);
  return runtime::locate({program, nullptr}, place.value_or(runtime::Ref{}));
}

} // namespace

std::optional<std::string> InputWiring::configure(std::string_view key, std::string_view value, Axes& axes) {
  constexpr std::string_view kSwitch = "switch.", kFollow = "follow.";
  if (key.starts_with(kFollow)) return follow(key, key.substr(kFollow.size()), value);
  if (!key.starts_with(kSwitch)) return std::nullopt;
  const std::string_view bit = key.substr(kSwitch.size());
  if (!isBit(bit)) return std::string(key) + ": expected the bit of a signal after 'switch.'";
  const auto same = std::ranges::find(switches_, bit, &Bit::name);
  const auto handle = static_cast<uint64_t>(same - switches_.begin());
  if (same == switches_.end()) switches_.push_back({.name = std::string(bit), .place = {}});
  return axes.addSwitch(handle, value);
}

std::string InputWiring::follow(std::string_view key, std::string_view input, std::string_view value) {
  const size_t at = std::min(value.find('@'), value.size());
  Wire wire{.inverted = value.starts_with('/')};
  const std::string_view source = value.substr(wire.inverted ? 1 : 0, at - (wire.inverted ? 1 : 0));
  wire.delayUs = at == value.size() ? 0 : nc::durationUs(value.substr(at + 1));
  if (!isBit(input)) return std::string(key) + ": expected the bit of a signal after 'follow.'";
  if (!isBit(source) || wire.delayUs < 0)
    return std::string(key) + ": expected a bit such as P0OUT.3, /P0OUT.3 or P0OUT.3@100ms, found '" +
           std::string(value) + "'";
  wire.input.name = input;
  wire.source.name = source;
  wires_.push_back(std::move(wire));
  return {};
}

void InputWiring::locate(const rung_program& program) {
  for (Bit& bit : switches_) bit.place = placeOf(program, bit.name);
  for (Wire& wire : wires_) {
    wire.input.place = placeOf(program, wire.input.name);
    wire.source.place = placeOf(program, wire.source.name);
  }
}

void InputWiring::powerOn(const core::Memory& memory) {
  nowUs_ = 0;
  for (Wire& wire : wires_) {
    wire.level = memory.read(wire.source.place) != 0;
    wire.sinceUs = -wire.delayUs;
  }
}

void InputWiring::pass(const core::Memory& memory, const Axes& axes, int64_t us) {
  nowUs_ += us;
  for (const Bit& bit : switches_) memory.write(bit.place, 0);
  for (const Axes::Switch& contact : axes.switches())
    if (axes.isClosed(contact)) memory.write(switches_[contact.bit].place, 1);
  for (Wire& wire : wires_) {
    const bool level = memory.read(wire.source.place) != 0;
    if (level != wire.level) {
      wire.level = level;
      wire.sinceUs = nowUs_;
    }
    if (nowUs_ - wire.sinceUs >= wire.delayUs) memory.write(wire.input.place, level != wire.inverted ? 1 : 0);
  }
}

} // namespace rung::sim::technol
