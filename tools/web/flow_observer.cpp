// States of elements from the values of rungs (see flow_observer.h).
#include "tools/web/flow_observer.h"

#include <algorithm>
#include <map>

#include "ir/core/ops.h"

namespace rung::web {

std::vector<std::vector<FlowObserver::Guard>> FlowObserver::guardsOf(const ir::Rung& rung) {
  std::vector<std::vector<Guard>> guards(rung.values.size());
  std::vector<Guard> open;
  for (const ir::Op& op : rung.ops) {
    if (op.code == ir::OpCode::EndIf) open.pop_back();
    if (op.code == ir::OpCode::Else) open.back().wanted = false;
    if (op.code == ir::OpCode::If) open.push_back({ir::arg(rung, op, 0).index, true});
    for (uint32_t i = 0; i < op.resultCount; ++i) guards[op.result.index + i] = open;
  }
  return guards;
}

namespace {

// Whether the result is and-ed with the power before the box, as that of a contact is.
bool conducts(const ir::Rung& rung, ir::ValueId result, ir::ValueId before) {
  return std::ranges::any_of(rung.ops, [&](const ir::Op& op) {
    if (op.code != ir::OpCode::And || op.argCount != 2) return false;
    const ir::ValueId a = ir::arg(rung, op, 0), b = ir::arg(rung, op, 1);
    return (a == result && b == before) || (a == before && b == result);
  });
}

} // namespace

FlowObserver::FlowObserver(const ir::Module& module, const ir::Marks& marks, const ShownProgram& program)
    : shown_(program.elementCount()), states_(program.elementCount()), runs_(program.elementCount()) {
  for (uint32_t r = 0; r < module.routines.size(); ++r) {
    const std::vector<ir::Rung>& rungs = module.routines[r].rungs;
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      std::vector<Watched>& watched = rungs_.emplace_back();
      const ir::Rung& rung = rungs[i];
      if (rung.number == 0 || !rung.begin.file.valid()) continue;
      const auto guards = guardsOf(rung);
      std::map<uint32_t, ir::ValueId> inputs; // the first of each element
      for (const ir::Mark& mark : marks.of({r}, i)) {
        const auto element = program.elementAt(module.files[rung.begin.file.index], mark.line, mark.column);
        if (!element) continue;
        shown_[*element] = true;
        const ir::ValueId before = inputs.try_emplace(*element, mark.value).first->second;
        uint8_t result = mark.kind == ir::MarkKind::Result ? kResultKnown : 0;
        if (result != 0 && conducts(rung, mark.value, before)) result |= kConducts;
        watched.push_back({mark.value.index, *element, result, guards[mark.value.index]});
      }
    }
  }
}

// The first pin of a box with several gives its state, as in coverage.
void FlowObserver::rungRan(uint32_t number, std::span<const uint64_t> values) {
  if (values.empty()) return; // it stopped the program
  ++run_;
  for (const Watched& watched : rungs_[number]) {
    const bool reached = std::ranges::all_of(
        watched.guards, [&](const Guard& guard) { return (values[guard.value] != 0) == guard.wanted; });
    if (!reached) continue;
    uint8_t& state = states_[watched.element];
    const bool on = values[watched.value] != 0;
    const bool first = runs_[watched.element] != run_;
    if (first) state = static_cast<uint8_t>(kEvaluated | (on ? kOn : 0)); // also of a box without a marked input
    if (watched.result != 0) state |= static_cast<uint8_t>(watched.result | (on ? kResult : 0));
    runs_[watched.element] = run_;
  }
}

std::vector<uint8_t> FlowObserver::states() const {
  std::vector<uint8_t> now(states_.size());
  for (size_t i = 0; i < now.size(); ++i) now[i] = runs_[i] > before_ ? states_[i] : 0;
  for (const auto& [element, state] : constants_) now[element] = state;
  return now;
}

void FlowObserver::setConstant(uint32_t element, bool conducts) {
  constants_.emplace_back(element, static_cast<uint8_t>(kConstant | (conducts ? kOn : 0)));
}

} // namespace rung::web
