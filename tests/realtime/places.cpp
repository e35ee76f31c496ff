// See places.h.
#include "tests/realtime/places.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "rtlib/nc/signals.h"

namespace rung::test {
namespace {

constexpr size_t kMostPins = 600; // each way: as many as a large machine has

// The flags of the space where a name's bit is; 0: it is none that a pin could have.
uint32_t spaceFlags(const runtime::Instance& instance, const std::optional<runtime::Ref>& place) {
  if (!place || place->kind != runtime::RefKind::Bit || place->count != 1) return 0;
  return instance.program().spaces[place->space].flags;
}

std::vector<std::string> candidates(const rung_program& program) {
  std::vector<std::string> names;
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count))
    if (symbol.name[0] != '@') names.emplace_back(symbol.name);
  if (const nc::SignalTable* signals = nc::signalsOf(program.dialect))
    for (const nc::Signal& signal : *signals) names.emplace_back(signal.symbol);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Not more than the limit, from all of the list.
void thin(std::vector<std::string>& names) {
  if (names.size() <= kMostPins) return;
  std::vector<std::string> kept;
  for (size_t i = 0; i < kMostPins; ++i) kept.push_back(names[i * names.size() / kMostPins]);
  names = std::move(kept);
}

} // namespace

Names namesOf(const runtime::Instance& instance, const nc::Control& control) {
  Names names;
  std::set<std::array<uint32_t, 3>> taken; // by inputs
  for (const std::string& name : candidates(instance.program())) {
    const std::optional<runtime::Ref> place = control.writePlace(instance.program(), name);
    const uint32_t flags = spaceFlags(instance, place);
    if ((flags & RUNG_SPACE_INPUT) != 0 && !control.writesItself(instance.program(), *place) &&
        taken.insert({place->space, place->byte, place->bit}).second) // each bit is one pin's
      names.inputs.push_back(name);
    if ((flags & RUNG_SPACE_OUTPUT) != 0) names.outputs.push_back(name);
  }
  thin(names.inputs);
  thin(names.outputs);
  return names;
}

host::File mapOf(const Names& names) {
  host::File map;
  map.paths = {"all.map"};
  const auto add = [&](const std::string& name, host::Direction direction) {
    const auto pin = static_cast<uint32_t>(map.pins.size());
    map.pins.push_back({.name = std::string(host::tableName(direction)) + "-" + std::to_string(pin),
                        .direction = direction,
                        .at = {pin + 1}});
    map.links.push_back({.pin = pin, .name = name, .at = {pin + 1}});
  };
  for (const std::string& name : names.inputs) add(name, host::Direction::In);
  for (const std::string& name : names.outputs) add(name, host::Direction::Out);
  return map;
}

Inputs::Inputs(const runtime::Instance& instance, const nc::Control& control, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    places_.push_back({runtime::locate(instance.memory(), *control.writePlace(instance.program(), name))});
  values_.resize(places_.size());
}

void Inputs::toggle(runtime::Instance& instance) {
  for (uint64_t& value : values_) value = toggles_.next(value != 0) ? 1 : 0;
  core::writePlaces(instance.memory(), places_, values_);
}

} // namespace rung::test
