// Operations on rungs: text dump, evaluation order of the elements, rules common to all dialects, pin checks.
#include "frontend/ladder/rung.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/diag/ladder.h"
#include "ir/support/put.h"

namespace rung::frontend::ladder {

// Text dump of a rung's elements and nets, for tests and debugging.

std::string elementText(const Element& element, std::span<const Word> operands) {
  const std::string_view edge(&element.edge, element.edge != 0 ? 1 : 0);
  switch (element.kind) {
  case ElementKind::Contact: return fmt::format("[{}{}{}]", element.negated ? "/" : "", edge, operands[0].text);
  case ElementKind::Coil: {
    constexpr std::string_view kKinds[] = {"", "/", "S ", "R "};
    return fmt::format("({}{}{})", kKinds[static_cast<size_t>(element.coil)], edge, operands[0].text);
  }
  case ElementKind::Error: return "unread";
  case ElementKind::Box: break;
  }
  std::string out = fmt::format("{{{}", element.mnemonic);
  for (const Word& word : operands) {
    const std::string_view quote = word.quoted ? "\"" : "";
    put(out, " {}{}{}", quote, word.text, quote);
  }
  return out + '}';
}

std::string dumpRung(const Rung& rung) {
  std::string out;
  put(out, "rung{} {}-{}{}\n", rung.hasComment ? fmt::format(" \"{}\"", rung.comment) : "", rung.firstLine,
      rung.lastLine, rung.bad ? " bad" : "");
  for (size_t i = 0; i < rung.elements.size(); ++i) {
    const Element& element = rung.elements[i];
    put(out, "e{} ", i);
    out += elementText(element, rung.operandsOf(element));
    for (const Pin& pin : rung.pinsOf(element)) {
      put(out, " {}{}n{}", pin.name, pin.name.empty() ? "" : "=", pin.input.index);
    }
    put(out, " -> {}", element.output.valid() ? fmt::format("n{}", element.output.index) : ".");
    out += '\n';
  }
  for (const Comment& comment : rung.comments) put(out, "; {}\n", comment.text);
  return out;
}

// Drivers and consumers of nets, and the order of evaluation.

namespace {

using Work = std::priority_queue<uint32_t, std::vector<uint32_t>, std::greater<>>;

/// Kahn's algorithm. Among the ready elements the first one in the text is taken: the upper line, then the leftmost.
/// Elements of a loop never become ready and are missing from the result.
std::vector<uint32_t> evaluationOrder(const Rung& rung) {
  std::vector<uint32_t> waiting(rung.elements.size(), 0); // inputs whose power source is not yet placed
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

/// Returns one element of a loop: from any unplaced element, follow unplaced drivers until one repeats.
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
  // The rightmost element of the loop is most likely the one that was drawn backwards.
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

// Rules for the nets of every rung: power comes from the left rail and leads to an element.

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

// Checks the drawn pins against the instruction table.

namespace {

bool hasName(std::span<const Pin> pins, std::string_view name, SameName same) {
  return std::ranges::any_of(pins, [&](const Pin& pin) { return same(pin.name, name); });
}

// Reports all missing pins of one box in a single message.
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

// A pin that is left out must not make the next one look misdrawn.
bool checkPins(const frontend::InstructionInfo& info, std::span<const Pin> drawn, SourceRange box, SameName same,
               Diagnostics& diagnostics) {
  const auto known = info.pins.all();
  std::vector<std::string_view> missing;
  bool good = true;
  size_t next = 1; // the first pin is the line with the mnemonic
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
