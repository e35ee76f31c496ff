// Lowers one network to one rung.
#include <algorithm>

#include <fmt/format.h>

#include "frontend/lower/operations.h"
#include "frontend/network/lower/lower_module.h"
#include "rung/types.hpp"

namespace rung::frontend::network {
namespace {

// The source lines of a network.
std::string linesOf(const SourceManager& sources, const Network& network) {
  std::string text;
  for (uint32_t line = network.firstLine; line <= network.lastLine; ++line) {
    if (line != network.firstLine) text += '\n';
    text += sources.lineText(network.file, line);
  }
  return text;
}

} // namespace

void ModuleLowering::describe(ir::Rung& rung, const Network& network, Key key) const {
  const auto number = numbers_.find(&network);
  rung.number = number == numbers_.end() ? 0 : number->second;
  rung.title = network.title;
  rung.sourceText = linesOf(context_.sources, network);
  rung.begin = {fileIndex_.at(network.file.index), network.firstLine,
                context_.sources.lineCol(network.range.begin).column};
  rung.lastLine = network.lastLine;
  rung.key = key.key;
  rung.copy = key.copy;
  rung.weight = std::max(network.steps, 1u);
}

void RungMarks::add(ir::MarkKind kind, ir::ValueId value, SourceRange range, std::string text) const {
  const LineCol at = sources_.lineCol(range.begin);
  marks_->add(routine_, rung_, {kind, value, at.line, at.column, std::move(text)});
}

void RungMarks::element(ir::MarkKind kind, ir::ValueId value, SourceRange range) const {
  if (marks_ != nullptr) add(kind, value, range, std::string(sources_.text(range)));
}

void RungMarks::function(ir::MarkKind kind, ir::ValueId value, const Function& function, std::string_view more) const {
  if (marks_ == nullptr) return;
  std::string text(function.row->info.mnemonic);
  for (const Param& param : function.params) text.append(" ").append(sources_.text(param.range));
  add(kind, value, function.range, text.append(more));
}

std::vector<ir::ValueId> ModuleLowering::lowerLogic(LevelState& level, ir::RungBuilder& b, const Network& network,
                                                    const RungMarks& marks) {
  std::vector<ir::ValueId> stack;
  for (const LogicStep& step : network.logic) {
    b.setLine(step.line);
    if (step.kind == Logic::OrBlock || step.kind == Logic::AndBlock) {
      const ir::ValueId top = stack.back();
      stack.pop_back();
      stack.back() = step.kind == Logic::OrBlock ? b.or_(stack.back(), top) : b.and_(stack.back(), top);
      continue;
    }
    const std::optional<bool> constant = execution_.constantAt(step.bit);
    if (!constant) level.use(step.bit, 1);
    const ir::Place place = level.placeOf(step.bit);
    ir::ValueId value = constant ? b.constantBit(place, *constant) : b.load(ir::Type::Bit, place);
    if (step.contact == Contact::Closed) value = b.not_(value);
    if (step.contact == Contact::Falling)
      value = frontend::pulse(b, slot(edgeKeys_.at(&step), ir::Type::Bit, 0, false), value, frontend::kFalling);
    if (!constant) marks.element(ir::MarkKind::Contact, value, step.range);
    if (step.kind == Logic::Load)
      stack.push_back(value);
    else
      stack.back() = step.kind == Logic::And ? b.and_(stack.back(), value) : b.or_(stack.back(), value);
  }
  return stack;
}

// Inside a common line that is off, OUT writes 0, OUTI writes 1, and SET and RST do nothing (P41): the same as with ST0
// = 0. The select expresses that SET and RST write the bit without reading it (ir::RungUse::keeps).
void ModuleLowering::lowerCoils(RoutineContext& routine, ir::RungBuilder& b, const Network& network, ir::ValueId value,
                                const RungMarks& marks) {
  if (network.com != kNone) {
    const ir::ValueId line = b.slotLoad(slot(slotPrefixes_[routine.unit][network.com] + "com", ir::Type::Bit, 0, true));
    marks.function(ir::MarkKind::Result, line, program_.units[routine.unit].networks[network.com].function);
    value = b.and_(value, line);
  }
  for (const CoilStep& coil : network.coils) {
    b.setLine(coil.line);
    marks.element(ir::MarkKind::Coil, value, coil.range);
    routine.level->use(coil.bit, 1);
    const ir::Place place = routine.level->placeOf(coil.bit);
    switch (coil.kind) {
    case Coil::Out: b.store(place, value); break;
    case Coil::OutInverted: b.store(place, b.not_(value)); break;
    case Coil::Set: b.store(place, b.select(value, b.bit(true), b.load(ir::Type::Bit, place))); break;
    case Coil::Reset: b.store(place, b.select(b.not_(value), b.load(ir::Type::Bit, place), b.bit(false))); break;
    }
  }
}

// Returns the output. A function that only passes on a condition gets no result mark.
ir::ValueId ModuleLowering::lowerFunction(RoutineContext& routine, ir::RungBuilder& b, uint32_t index,
                                          std::span<const ir::ValueId> conditions, const RungMarks& marks) {
  const Network& network = program_.units[routine.unit].networks[index];
  const LoweredRow& row = loweredRow(*network.function.row);
  for (size_t i = 0; i < conditions.size(); ++i) {
    const bool one = conditions.size() == 1;
    marks.function(ir::MarkKind::Input, conditions[i], network.function,
                   one ? std::string() : fmt::format(" {}", row.info.pins[i].name));
  }
  Lowering f(*this, routine, b, network, conditions, slotPrefixes_[routine.unit][index]);
  b.setLine(network.function.line);
  if (row.control == Control::Plain) b.note(row.info.mnemonic);
  row.lower(f);
  const bool passes = std::find(conditions.begin(), conditions.end(), f.output()) != conditions.end();
  if (f.output().valid() && !passes) marks.function(ir::MarkKind::Result, f.output(), network.function);
  if (f.output().valid() || conditions.empty()) return f.output();
  return conditions.back(); // what a coil after a function without an output takes
}

void ModuleLowering::lowerNetwork(RoutineContext& routine, ir::Rung& rung, uint32_t index) {
  const Network& network = program_.units[routine.unit].networks[index];
  describe(rung, network, keys_[routine.unit][index]);
  ir::RungBuilder b(*module_, rung);
  const bool endsCycle = routine.unit == lastLevel() && controlOf(network) == Control::LevelEnd;
  if (endsCycle && execution_.eachCycle) byControl(execution_.eachCycle, routine, b, network);
  const RungMarks marks(marks_, context_.sources, routine.level->routines[routine.unit], routine.rungOf[index]);
  const std::vector<ir::ValueId> conditions = lowerLogic(*routine.level, b, network, marks);
  ir::ValueId value = conditions.empty() ? ir::ValueId{} : conditions[0];
  if (network.function.row != nullptr) value = lowerFunction(routine, b, index, conditions, marks);
  if (!network.coils.empty()) lowerCoils(routine, b, network, value, marks);
}

// Follows a call that a JMPC may have left (P43): a subprogram returns at once, the main program continues at the
// label.
void ModuleLowering::addLeave(RoutineContext& routine, ir::Rung& rung, uint32_t next) {
  const ir::Rung& call = *(&rung - 1);
  rung.number = call.number;
  rung.title = call.title;
  rung.begin = call.begin;
  rung.lastLine = call.lastLine;
  rung.key = rungKey(~textOfKey(call.key, call.copy), call.copy);
  rung.copy = call.copy;
  ir::RungBuilder b(*module_, rung);
  b.note("return of the call");
  const ir::ValueId target = b.slotLoad(leaveTarget());
  if (program_.units[routine.unit].kind == UnitKind::Subprogram) return b.ret(b.ne(target, b.i32(0)));
  b.slotStore(leaveTarget(), b.i32(0));
  std::vector<uint32_t> targets{next};
  for (uint32_t network : program_.jumpTargets) targets.push_back(routine.rungOf[network]);
  b.switchTo(target, std::move(targets));
}

} // namespace rung::frontend::network
