// Drivers and consumers of nets, and the order of evaluation.
#include <algorithm>
#include <functional>
#include <queue>

#include "frontend/ladder/rung.h"
#include "ir/support/diag/ladder.h"

namespace rung::frontend::ladder {
namespace {

using Work = std::priority_queue<uint32_t, std::vector<uint32_t>, std::greater<>>;

/// Kahn's algorithm; among ready elements the one that comes first in the text, that is the upper line, then the left
/// one. Elements of a loop never become ready and are missing in the result.
std::vector<uint32_t> evaluationOrder(const Rung& rung) {
  std::vector<uint32_t> waiting(rung.elements.size(), 0); // inputs without power's source known
  std::vector<uint32_t> drivers(rung.nets.size());
  for (uint32_t n = 0; n < rung.nets.size(); ++n) drivers[n] = rung.nets[n].drivers.count;
  Work ready;
  for (uint32_t e = 0; e < rung.elements.size(); ++e) {
    for (const Pin& pin : rung.pinsOf(rung.elements[e])) waiting[e] += drivers[pin.input.index] != 0;
    if (waiting[e] == 0) ready.push(e);
  }
  std::vector<uint32_t> order;
  order.reserve(rung.elements.size());
  while (!ready.empty()) {
    const uint32_t e = ready.top();
    ready.pop();
    order.push_back(e);
    const NetId net = rung.elements[e].output;
    if (!net.valid() || --drivers[net.index] != 0) continue;
    for (const ElementId consumer : rung.consumersOf(net)) {
      if (--waiting[consumer.index] == 0) ready.push(consumer.index);
    }
  }
  return order;
}

/// One element of a loop: from any element that was left over, go back to a driver that was left over until one
/// repeats.
ElementId findLoop(const Rung& rung, const std::vector<uint32_t>& order) {
  std::vector<bool> placed(rung.elements.size(), false);
  for (const uint32_t e : order) placed[e] = true;
  uint32_t at = static_cast<uint32_t>(std::find(placed.begin(), placed.end(), false) - placed.begin());
  std::vector<bool> seen(rung.elements.size(), false);
  const auto leftOverDriver = [&](uint32_t e) {
    for (const Pin& pin : rung.pinsOf(rung.elements[e])) {
      for (const ElementId driver : rung.driversOf(pin.input)) {
        if (!placed[driver.index]) return driver.index;
      }
    }
    return e;
  };
  while (!seen[at]) {
    seen[at] = true;
    at = leftOverDriver(at);
  }
  // Of the loop, the rightmost element is most likely the one that was drawn backwards.
  uint32_t rightmost = at;
  for (uint32_t e = leftOverDriver(at); e != at; e = leftOverDriver(e)) {
    if (rung.elements[e].column > rung.elements[rightmost].column) rightmost = e;
  }
  return ElementId{rightmost};
}

} // namespace

void linkNets(Rung& rung) {
  const auto forEachLink = [&rung](auto&& driver, auto&& consumer) {
    for (uint32_t e = 0; e < rung.elements.size(); ++e) {
      for (const Pin& pin : rung.pinsOf(rung.elements[e])) consumer(rung.nets[pin.input.index], ElementId{e});
      const NetId output = rung.elements[e].output;
      if (output.valid()) driver(rung.nets[output.index], ElementId{e});
    }
  };
  for (Net& net : rung.nets) net.drivers.count = net.consumers.count = 0;
  forEachLink([](Net& net, ElementId) { ++net.drivers.count; }, [](Net& net, ElementId) { ++net.consumers.count; });
  uint32_t total = 0;
  for (Net& net : rung.nets) {
    net.drivers.first = total;
    net.consumers.first = total + net.drivers.count;
    total = net.consumers.first + net.consumers.count;
    net.drivers.count = net.consumers.count = 0;
  }
  rung.linkPool.resize(total);
  const auto put = [&rung](Slice& slice, ElementId id) { rung.linkPool[slice.first + slice.count++] = id; };
  forEachLink([&](Net& net, ElementId id) { put(net.drivers, id); },
              [&](Net& net, ElementId id) { put(net.consumers, id); });
}

void orderElements(Rung& rung, Diagnostics& diagnostics) {
  const std::vector<uint32_t> order = evaluationOrder(rung);
  if (order.size() != rung.elements.size()) {
    diagnostics.report(diag::PowerLoop, rung.element(findLoop(rung, order)).range);
    rung.bad = true;
    return;
  }
  if (std::is_sorted(order.begin(), order.end())) return;
  std::vector<Element> ordered;
  ordered.reserve(order.size());
  for (const uint32_t e : order) ordered.push_back(rung.elements[e]);
  rung.elements.swap(ordered);
  linkNets(rung);
}

} // namespace rung::frontend::ladder
