// What holds of the nets of every rung: power comes from the left rail and leads to an element.
#include <algorithm>

#include "frontend/ladder/rung.h"
#include "ir/support/diag/ladder.h"

namespace rung::frontend::ladder {
namespace {

bool checkElement(const Rung& rung, const Element& element, Diagnostics& diagnostics) {
  const auto isOutput = [&](const Pin& pin) { return element.output.valid() && pin.input == element.output; };
  if (std::ranges::any_of(rung.pinsOf(element), isOutput)) {
    diagnostics.report(diag::ShortCircuit, element.range);
  } else if (element.output == kRail) {
    diagnostics.report(diag::PowerLoop, element.range);
  } else {
    return true;
  }
  return false;
}

} // namespace

bool checkPower(const Rung& rung, Diagnostics& diagnostics) {
  bool good = true;
  for (const Element& element : rung.elements) good &= checkElement(rung, element, diagnostics);
  if (!good) return false;
  for (uint32_t net = 1; net < rung.nets.size(); ++net) {
    if (!rung.driversOf(NetId{net}).empty()) continue;
    diagnostics.report(diag::DanglingWire, rung.nets[net].range) << "nothing leads to this from the left rail";
    good = false;
  }
  return good;
}

bool checkClosed(const Rung& rung, Diagnostics& diagnostics) {
  bool good = true;
  for (uint32_t net = 1; net < rung.nets.size(); ++net) {
    if (!rung.consumersOf(NetId{net}).empty()) continue;
    diagnostics.report(diag::MissingClosingElement, rung.nets[net].range) << "this wire";
    good = false;
  }
  return good;
}

} // namespace rung::frontend::ladder
