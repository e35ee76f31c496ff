// States from the powers at pins (see element_states.h).
#include "tools/web/element_states.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>

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

// Whether a pin of an instruction may be of this cell.
bool isKindOf(ir::MarkKind kind, const view::Cell& cell) {
  switch (kind) {
  case ir::MarkKind::Contact:
  case ir::MarkKind::Result: return cell.kind != view::Cell::Kind::Coil;
  case ir::MarkKind::Coil:
  case ir::MarkKind::Input: return cell.kind != view::Cell::Kind::Contact;
  }
  return false;
}

// Whether an instruction as written, such as "WR PUMP,LAMP", names what the cell shows.
bool names(std::string_view instruction, const view::Cell& cell) {
  const bool isBox = cell.kind == view::Cell::Kind::Box;
  const std::string& name = isBox ? cell.title : cell.operand.name.empty() ? cell.mark : cell.operand.name;
  constexpr std::string_view kWord = "_ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  const auto isWord = [&](size_t at) { return at < instruction.size() && kWord.find(instruction[at]) != kWord.npos; };
  for (size_t at = instruction.find(name); at != std::string_view::npos && !name.empty();
       at = instruction.find(name, at + 1))
    if ((at == 0 || !isWord(at - 1)) && !isWord(at + name.size())) return true;
  return false;
}

// The pins of one of the cells that are drawn at the place of an element. Where a macro is used there may be several
// instructions: then a cell has the pins of the one that names it; the second cell of a name those of the second one.
std::vector<uint32_t> pinsOf(const ShownProgram& program, uint32_t row, const replay::Element& element,
                             std::span<const uint32_t> shown, uint32_t which) {
  std::vector<uint32_t> all(element.pins.size());
  std::iota(all.begin(), all.end(), 0u);
  if (shown.size() == 1) return all;
  const view::Cell& cell = program.cellOf(row, shown[which]);
  std::erase_if(all, [&](uint32_t i) { return !isKindOf(element.pins[i].kind, cell); });
  std::vector<uint32_t> named;
  std::ranges::copy_if(all, std::back_inserter(named), [&](uint32_t i) { return names(element.pins[i].text, cell); });
  const auto isFirst = [&](uint32_t i) { return element.pins[i].text == element.pins[0].text; };
  if (named.empty()) return std::ranges::all_of(all, isFirst) ? all : std::vector<uint32_t>();
  if (cell.kind == view::Cell::Kind::Box) return named;
  const auto before = std::ranges::count_if(shown.first(which), [&](uint32_t one) {
    const view::Cell& earlier = program.cellOf(row, one);
    return earlier.kind == cell.kind && earlier.operand.name == cell.operand.name;
  });
  return {named[std::min<size_t>(static_cast<size_t>(before), named.size() - 1)]};
}

} // namespace

ElementStates::ElementStates(replay::FlowEngine& engine, const ShownProgram& program)
    : elements_(program.elementCount()) {
  for (const replay::Element& element : engine.elements().all()) {
    const replay::SourceRung& source = engine.elements().rungs()[element.rung];
    const auto row = program.rowOf(source.number);
    if (!row) continue;
    const std::vector<uint32_t> shown = program.elementsAt(*row, element.line, element.column);
    for (uint32_t one = 0; one < shown.size(); ++one)
      for (const uint32_t i : pinsOf(program, *row, element, shown, one)) {
        const uint32_t pin = element.firstPin + i;
        uint8_t result = 0;
        if (element.pins[i].kind == ir::MarkKind::Result)
          result =
              static_cast<uint8_t>(kResultKnown | (conducts(engine, source, pin, element.firstPin) ? kConducts : 0));
        pins_.push_back({pin, shown[one], result});
      }
  }
  for (uint32_t lowered = 0; lowered < engine.elements().loweredCount(); ++lowered)
    for (const ir::SpaceBit& bit : engine.rung(lowered).constantBits) constantBits_.emplace(bit.space.index, bit.bit);
  addWired(engine.elements(), program);
  const rung_program& tables = engine.engine().program();
  const std::span continuations(tables.continuations, tables.continuation_count);
  for (ShownProgram::Step& step : program.steps()) {
    const auto found = std::ranges::find(continuations, step.continuation, &rung_continuation::key);
    if (found == continuations.end()) continue;
    steps_.push_back({step.element, found->offset, std::move(step.states)});
  }
}

// A rung that has run has a rail with power, even if nothing in it says more.
void ElementStates::addWired(const replay::Elements& elements, const ShownProgram& program) {
  std::vector<bool> marked(elements_, false);
  for (const Pin& pin : pins_) marked[pin.element] = true;
  for (uint32_t lowered = 0; lowered < elements.loweredCount(); ++lowered) rungOf_.push_back(elements.rungOf(lowered));
  for (const replay::SourceRung& rung : elements.rungs()) {
    std::vector<uint32_t>& wired = wired_.emplace_back();
    const auto row = program.rowOf(rung.number);
    const auto rail = row ? program.railOf(*row) : std::nullopt;
    if (!rail) continue;
    wired.push_back(*rail);
    for (const uint32_t element : program.poweredOf(*row))
      if (!marked[element]) wired.push_back(element);
  }
}

bool ElementStates::isConstant(const ir::BitRange& bit) const {
  return bit.count == 1 && constantBits_.contains({bit.space.index, bit.first});
}

void ElementStates::setConstant(uint32_t element, bool conducts) {
  constants_.emplace_back(element, static_cast<uint8_t>(kConstant | (conducts ? kOn : 0)));
}

// The first pin of a box with several gives its state, as in coverage.
std::vector<uint8_t> ElementStates::of(const replay::Flow& flow, std::span<const uint8_t> block) const {
  const std::vector<std::optional<replay::Power>> powers = flow.lastPowers();
  std::vector<uint8_t> states(elements_, 0);
  for (const replay::RungFlow& run : flow.runs())
    if (const uint32_t rung = rungOf_[run.lowered]; rung != replay::kNone)
      for (const uint32_t element : wired_[rung]) states[element] = kEvaluated | kWired;
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
