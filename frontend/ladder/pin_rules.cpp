// Pins against rows (see pin_rules.h).
#include "frontend/ladder/pin_rules.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "ir/support/diag/ladder.h"

namespace rung::frontend::ladder {
namespace {

bool hasName(std::span<const Pin> pins, std::string_view name, SameName same) {
  return std::ranges::any_of(pins, [&](const Pin& pin) { return same(pin.name, name); });
}

// All of one box at once.
void reportMissing(const frontend::InstructionInfo& info, std::span<const std::string_view> pins, SourceRange box,
                   Diagnostics& diagnostics) {
  std::string names(pins.size() == 1 ? "pin" : "pins");
  for (const std::string_view pin : pins) names += fmt::format("{} {}", pin == pins[0] ? "" : ",", pin);
  diagnostics.report(diag::MissingPin, box)
          .note(fmt::format("a pin has a line of its own below the box: |--[x]--{{{}}}", pins[0]))
      << info.mnemonic << names;
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
  std::vector<std::string_view> missing;
  bool good = true;
  size_t next = 1; // the first has the mnemonic
  for (size_t i = 1; i < drawn.size(); ++i, ++next) {
    const auto isDrawn = [&](const frontend::PinInfo& pin) { return same(drawn[i].name, pin.name); };
    const bool isLater = std::ranges::any_of(known.subspan(std::min(next, known.size())), isDrawn);
    for (; isLater && !isDrawn(known[next]) && !hasName(drawn.subspan(i + 1), known[next].name, same); ++next)
      missing.push_back(known[next].name);
    if (next < known.size() && isDrawn(known[next])) continue;
    diagnostics.report(diag::UnknownPin, drawn[i].range)
        << info.mnemonic << drawn[i].name << (next < known.size() ? known[next].name : "no further pin");
    good = false;
  }
  for (; next < known.size(); ++next) missing.push_back(known[next].name);
  if (missing.empty()) return good;
  reportMissing(info, missing, box, diagnostics);
  return false;
}

} // namespace rung::frontend::ladder
