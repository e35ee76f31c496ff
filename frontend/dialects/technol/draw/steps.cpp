// Divides units that wait (see steps.h).
#include "frontend/dialects/technol/draw/steps.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "frontend/dialects/technol/draw/networks.h"
#include "frontend/dialects/technol/lower/lower.h"

namespace rung::frontend::technol {
namespace {

class Steps {
public:
  Steps(const Built& built, const Trace::Sequence& sequence)
      : built_(built), program_(built.program), source_(built.program.source), from_(sequence) {}

  chart::Sequence run();

private:
  const Statement& at(uint32_t index) const { return source_.statements[index]; }
  std::span<const Operand> operandsOf(uint32_t index) const { return program_.operandsOf(program_.statements[index]); }
  void name();
  void findStatements();
  void findStates();
  uint32_t statementAt(uint32_t rung) const;
  void divide();
  void beginPart(uint32_t index);
  void fill(chart::Part& part, std::span<const uint32_t> statements);
  void addLines(chart::Part& part, std::span<const uint32_t> statements);
  void addWait(chart::Part& part, const chart::Rung& rung, uint32_t index);
  uint32_t partOf(const Operand& label) const;
  bool isWait(uint32_t index) const { return (at(index).row->effects & kWaits) != 0; }
  bool isJump(uint32_t index) const { return (at(index).row->effects & kJumps) != 0; }
  // Whether control cannot reach the next statement.
  bool leaves(uint32_t index) const { return isJump(index) && at(index).row->variant == kAlways; }

  const Built& built_;
  const TypedProgram& program_;
  const SourceProgram& source_;
  const Trace::Sequence& from_;
  chart::Sequence made_;
  std::vector<uint32_t> statements_;                 // of the unit, in their order
  std::map<uint32_t, uint32_t> beginsIn_;            // by rung of the routine: the first statement there
  std::map<uint32_t, uint32_t> continuesIn_;         // the same for statements of several rungs
  std::map<uint32_t, std::vector<uint32_t>> states_; // by statement; kNone: the end
  std::map<uint32_t, uint32_t> entered_;             // by the same: number of the rung where the unit continues
  std::map<uint32_t, uint32_t> partOf_;              // by the statement that begins it
};

void Steps::name() {
  const Unit& unit = source_.at(from_.unit);
  made_.continuation = from_.continuation;
  made_.name = unit.kind == UnitKind::Mechanism ? std::string(unit.name) : std::string(moduleName(unit.module));
}

void Steps::findStatements() {
  for (const uint32_t i : built_.statements[from_.unit.index]) {
    const bool begins = at(i).row->role == Role::MechBegin;
    if (begins) made_.rung = built_.rungs[i];
    const Trace::Statement& place = built_.trace.statements[i];
    if (begins || !place.routine.valid()) continue;
    statements_.push_back(i);
    if (place.routine != from_.routine) continue;
    beginsIn_.emplace(place.first, i);
    for (uint32_t rung = place.first + 1; rung <= place.last; ++rung) continuesIn_.emplace(rung, i);
  }
}

// The statement that begins in the rung, or has a part of itself there; kNone: the rung is the end.
uint32_t Steps::statementAt(uint32_t rung) const {
  if (const auto begins = beginsIn_.find(rung); begins != beginsIn_.end()) return begins->second;
  const auto continues = continuesIn_.find(rung);
  return continues == continuesIn_.end() ? kNone : continues->second;
}

// The rungs in which the states continue are the targets of the switch; the compiler's own rungs lead to them.
void Steps::findStates() {
  const std::vector<ir::Rung>& rungs = built_.module.at(from_.routine).rungs;
  const std::vector<uint32_t>& targets = rungs[from_.dispatch].transfer.targets;
  for (uint32_t state = 0; state < targets.size(); ++state) {
    uint32_t rung = targets[state];
    while (rungs[rung].number == 0 && rungs[rung].transfer.kind == ir::TransferKind::Goto &&
           !rungs[rung].transfer.cond.valid())
      rung = rungs[rung].transfer.target;
    const uint32_t statement = statementAt(rung);
    states_[statement].push_back(state);
    entered_.emplace(statement, rungs[rung].number);
  }
}

void Steps::beginPart(uint32_t index) {
  partOf_[index] = static_cast<uint32_t>(made_.parts.size());
  chart::Part& part = made_.parts.emplace_back();
  if (const auto states = states_.find(index); states != states_.end()) part.states = states->second;
  const auto entered = entered_.find(index);
  if (entered != entered_.end() && entered->second != 0)
    part.first = entered->second;
  else if (index != kNone)
    part.first = built_.rungs[index];
  if (index == kNone) {
    part.end = true;
    for (const Label& label : source_.labels)
      if (source_.owner(label.unit) == from_.unit && !built_.trace.statements[label.statement].routine.valid())
        part.label.append(part.label.empty() ? "" : ", ").append(label.name);
    return;
  }
  part.end = at(index).row->role == Role::MechEnd;
  part.title = commentAfter(source_, at(index));
  for (uint32_t i = at(index).label; i < source_.labels.size() && source_.labels[i].statement == index; ++i)
    part.label.append(part.label.empty() ? "" : ", ").append(source_.labels[i].name);
}

void Steps::divide() {
  bool fresh = true;
  for (const uint32_t index : statements_) {
    const bool isEnd = at(index).row->role == Role::MechEnd;
    if (fresh || isEnd || at(index).label != kNone || states_.contains(index)) beginPart(index);
    fresh = isWait(index) || leaves(index);
  }
  if (made_.parts.empty() || !made_.parts.back().end) beginPart(kNone);
}

uint32_t Steps::partOf(const Operand& label) const {
  const uint32_t statement = source_.labels[label.index].statement;
  const bool isCode = built_.trace.statements[statement].routine.valid();
  const auto found = partOf_.find(isCode ? statement : kNone);
  return found == partOf_.end() ? chart::kNone : found->second;
}

// What the statement waits for.
void Steps::addWait(chart::Part& part, const chart::Rung& rung, uint32_t index) {
  const Row& row = *at(index).row;
  const std::span<const Operand> o = operandsOf(index);
  part.rung = rung.number;
  part.remark = commentAfter(source_, at(index));
  if (part.remark == part.title) part.remark.clear();
  if (row.lower == &lowerEx) {
    part.until = "next scan";
  } else if (row.lower == &lowerBex) {
    part.until = "no wait: a later one returns here";
  } else if (row.lower == &lowerWait) {
    part.until = fmt::format("after {} scans", spell(o[1]));
  } else if (row.lower == &lowerExWhile || row.lower == &lowerTimedEx) {
    const std::string condition = conditionOf(rung, index);
    part.until = row.variant == 0 ? condition : oppositeOf(condition);
  } else {
    part.until = "answer";
  }
  if (row.lower != &lowerTimedEx) return;
  part.otherwise = fmt::format("else after {} scans to {}", spell(o[1]), spell(o[2]));
  if (o[3].given()) part.otherwise += fmt::format(" with {}", spell(o[3]));
  part.target = partOf(o[2]);
}

// Statements of one rung.
void Steps::addLines(chart::Part& part, std::span<const uint32_t> statements) {
  chart::Rung rung{.number = built_.rungs[statements.front()]};
  addNetworks(program_, statements, rung);
  const uint32_t last = statements.back();
  // A service waits for what it has asked for: it is both an action and a wait.
  const Row& row = *at(last).row;
  const bool isState = row.lower == &lowerEx || row.lower == &lowerBex || row.lower == &lowerWait ||
                       row.lower == &lowerExWhile || row.lower == &lowerTimedEx;
  const uint32_t without = isState || isJump(last) ? last : kNone;
  for (const uint32_t network : rung.networks)
    for (std::string& text : outputTexts(rung, network, without)) part.lines.push_back({rung.number, std::move(text)});
  if (isJump(last)) {
    const std::string condition = conditionOf(rung, last);
    std::string text = fmt::format("to {}", spell(operandsOf(last)[0]));
    if (row.variant == kIfRlo) text += " if " + condition;
    if (row.variant == kIfNotRlo) text += " if " + oppositeOf(condition);
    part.lines.push_back({rung.number, std::move(text), partOf(operandsOf(last)[0])});
  }
  if (isWait(last)) addWait(part, rung, last);
}

void Steps::fill(chart::Part& part, std::span<const uint32_t> statements) {
  part.falls = !leaves(statements.back());
  if (part.end) return;
  const auto& places = built_.trace.statements;
  for (size_t first = 0, end = 0; first < statements.size(); first = end) {
    const uint32_t rung = places[statements[first]].first;
    while (end < statements.size() && places[statements[end]].first == rung) ++end;
    addLines(part, statements.subspan(first, end - first));
  }
}

chart::Sequence Steps::run() {
  name();
  findStatements();
  findStates();
  divide();
  for (size_t first = 0, end = 0; first < statements_.size(); first = end) {
    do ++end;
    while (end < statements_.size() && !partOf_.contains(statements_[end]));
    fill(made_.parts[partOf_.at(statements_[first])], std::span(statements_).subspan(first, end - first));
  }
  made_.parts.back().falls = false;
  return std::move(made_);
}

} // namespace

chart::Sequence sequenceOf(const Built& built, const Trace::Sequence& sequence) { return Steps(built, sequence).run(); }

} // namespace rung::frontend::technol
