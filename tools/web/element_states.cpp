// States from the powers at pins (see element_states.h).
#include "tools/web/element_states.h"

#include <algorithm>
#include <cstring>

#include "ir/core/ops.h"

namespace rung::web {
namespace {

// Whether the result is and-ed with the power before the box, as that of a contact is.
bool conducts(const ir::Rung& rung, uint32_t result, uint32_t before) {
  return std::ranges::any_of(rung.ops, [&](const ir::Op& op) {
    if (op.code != ir::OpCode::And || op.argCount != 2) return false;
    const uint32_t a = ir::arg(rung, op, 0).index, b = ir::arg(rung, op, 1).index;
    return (a == result && b == before) || (a == before && b == result);
  });
}

bool conducts(const replay::FlowEngine& engine, const replay::SourceRung& source, uint32_t result, uint32_t before) {
  for (const uint32_t lowered : source.lowered) {
    std::optional<uint32_t> out, in;
    for (const replay::Point& point : engine.elements().points(lowered)) {
      if (point.pin == result) out = point.value;
      if (point.pin == before) in = point.value;
    }
    if (out && in) return conducts(engine.rung(lowered), *out, *in);
  }
  return false;
}

} // namespace

ElementStates::ElementStates(replay::FlowEngine& engine, const ShownProgram& program) : shown_(program.elementCount()) {
  for (const replay::Element& element : engine.elements().all()) {
    const replay::SourceRung& source = engine.elements().rungs()[element.rung];
    const auto shown = program.elementAt(source.file, element.line, element.column);
    if (!shown) continue;
    shown_[*shown] = true;
    for (uint32_t i = 0; i < element.pins.size(); ++i) {
      Pin pin{element.firstPin + i, *shown, 0};
      if (element.pins[i].kind == ir::MarkKind::Result)
        pin.result =
            static_cast<uint8_t>(kResultKnown | (conducts(engine, source, pin.pin, element.firstPin) ? kConducts : 0));
      pins_.push_back(pin);
    }
  }
  const rung_program& tables = engine.engine().program();
  const std::span continuations(tables.continuations, tables.continuation_count);
  for (ShownProgram::Step& step : program.steps()) {
    const auto found = std::ranges::find(continuations, step.continuation, &rung_continuation::key);
    if (found == continuations.end()) continue;
    shown_[step.element] = true;
    steps_.push_back({step.element, found->offset, std::move(step.states)});
  }
}

void ElementStates::setConstant(uint32_t element, bool conducts) {
  constants_.emplace_back(element, static_cast<uint8_t>(kConstant | (conducts ? kOn : 0)));
}

// The first pin of a box with several gives its state, as in coverage.
std::vector<uint8_t> ElementStates::of(const replay::Flow& flow, std::span<const uint8_t> block) const {
  const std::vector<std::optional<replay::Power>> powers = flow.lastPowers();
  std::vector<uint8_t> states(shown_.size(), 0);
  for (const Pin& pin : pins_) {
    const auto power = powers[pin.pin];
    if (!power || *power == replay::Power::NotReached) continue;
    uint8_t& state = states[pin.element];
    const bool on = *power == replay::Power::On;
    if (state == 0) state = static_cast<uint8_t>(kEvaluated | (on ? kOn : 0)); // also of a box without a marked input
    if (pin.result != 0) state |= static_cast<uint8_t>(pin.result | (on ? kResult : 0));
  }
  for (const Step& step : steps_) {
    uint32_t now = 0;
    std::memcpy(&now, block.data() + step.offset, sizeof now);
    states[step.element] = static_cast<uint8_t>(kEvaluated | (std::ranges::count(step.states, now) != 0 ? kOn : 0));
  }
  for (const auto& [element, state] : constants_) states[element] = state;
  return states;
}

} // namespace rung::web
