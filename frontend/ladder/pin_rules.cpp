// Pins against rows (see pin_rules.h).
#include "frontend/ladder/pin_rules.h"

#include <algorithm>

#include "ir/support/diag/ladder.h"

namespace rung::ladder {
namespace {

bool hasName(std::span<const Pin> pins, std::string_view name, SameName same) {
  return std::ranges::any_of(pins, [&](const Pin& pin) { return same(pin.name, name); });
}

} // namespace

bool isMisplaced(const frontend::InstructionInfo& info, const Pin& pin) {
  switch (info.placement) {
  case frontend::Placement::AfterContact: return pin.input == kRail;
  case frontend::Placement::AtRail: return pin.input != kRail;
  case frontend::Placement::Anywhere: return false;
  }
  return false;
}

// A pin that is left out is not the next one drawn wrongly.
bool checkPins(const frontend::InstructionInfo& info, std::span<const Pin> drawn, SourceRange box, SameName same,
               Diagnostics& diagnostics) {
  const auto known = info.pins.all();
  const auto missing = [&](size_t pin) {
    diagnostics.report(diag::MissingPin, box) << info.mnemonic << known[pin].name;
    return false;
  };
  bool good = true;
  size_t next = 1; // the first has the mnemonic
  for (size_t i = 1; i < drawn.size(); ++i, ++next) {
    if (next < known.size() && same(drawn[i].name, known[next].name)) continue;
    const bool isLater =
        next < known.size() &&
        std::ranges::any_of(known.subspan(next + 1), [&](const auto& pin) { return same(pin.name, drawn[i].name); });
    if (isLater && !hasName(drawn.subspan(i + 1), known[next].name, same)) return missing(next);
    diagnostics.report(diag::UnknownPin, drawn[i].range)
        << info.mnemonic << drawn[i].name << (next < known.size() ? known[next].name : "no further pin");
    good = false;
  }
  return next < known.size() ? missing(next) : good;
}

} // namespace rung::ladder
