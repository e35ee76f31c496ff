// Counting.
#include "tools/report/coverage_collector.h"

#include <algorithm>
#include <bit>

#include "ir/core/ops.h"

namespace rung::report {

namespace {

bool isCondition(const ir::Mark& mark) {
  return mark.kind == ir::MarkKind::Contact || mark.kind == ir::MarkKind::Result;
}

bool samePlace(const ir::Mark& a, const ir::Mark& b) {
  return a.kind == b.kind && a.line == b.line && a.column == b.column && a.text == b.text;
}

Rung describe(const ir::Module& module, const ir::Routine& routine, const ir::Rung& rung) {
  Rung out;
  out.number = rung.number;
  out.routine = routine.name;
  out.title = rung.title;
  if (rung.begin.file.valid()) out.file = module.files[rung.begin.file.index];
  out.line = rung.begin.line;
  return out;
}

// The values that decide, and the outputs of each: outputs with the same power are one decision.
std::vector<ir::ValueId> decisionsOf(std::span<const ir::Mark> marks, std::vector<std::vector<uint32_t>>& outputs) {
  std::vector<ir::ValueId> values;
  uint32_t output = 0;
  for (const ir::Mark& mark : marks) {
    if (isCondition(mark)) continue;
    const auto at = static_cast<size_t>(std::find(values.begin(), values.end(), mark.value) - values.begin());
    if (at == values.size()) {
      values.push_back(mark.value);
      outputs.emplace_back();
    }
    outputs[at].push_back(output++);
  }
  return values;
}

} // namespace

CoverageCollector::CoverageCollector(const ir::Module& module, const ir::Marks& marks) {
  program_.files = module.files;
  std::map<uint32_t, std::vector<Part>> known; // by rung number
  for (uint32_t r = 0; r < module.routines.size(); ++r) {
    const std::vector<ir::Rung>& rungs = module.routines[r].rungs;
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      const uint32_t number = rungs[i].number;
      plans_.push_back(
          number == 0 ? Plan{}
                      : planOf(module, {.routine = r, .code = &rungs[i], .marks = marks.of({r}, i)}, known[number]));
    }
  }
}

bool CoverageCollector::isSame(const Part& a, const Part& b) {
  return a.routine != b.routine && a.code->key == b.code->key &&
         std::equal(a.marks.begin(), a.marks.end(), b.marks.begin(), b.marks.end(), samePlace);
}

// Finds the part's position in the rung of the source. True: it is new, and its conditions and outputs are appended.
bool CoverageCollector::locate(const ir::Module& module, Part& part, std::vector<Part>& known) {
  const auto same = std::find_if(known.begin(), known.end(), [&](const Part& other) { return isSame(part, other); });
  if (same != known.end()) {
    part = {part.routine,     part.code,     part.marks,      same->rung,
            same->conditions, same->outputs, same->decisions, same->first};
    return false;
  }
  part.first = known.empty();
  part.rung = part.first ? static_cast<uint32_t>(program_.rungs.size()) : known[0].rung;
  if (part.first) program_.rungs.push_back(describe(module, module.routines[part.routine], *part.code));
  const Rung& rung = program_.rungs[part.rung];
  part.conditions = static_cast<uint32_t>(rung.conditions.size());
  part.outputs = static_cast<uint32_t>(rung.outputs.size());
  part.decisions = static_cast<uint32_t>(rung.decisions.size());
  known.push_back(part);
  return true;
}

CoverageCollector::Plan CoverageCollector::planOf(const ir::Module& module, Part part, std::vector<Part>& known) {
  const bool isNew = locate(module, part, known);
  Plan plan{.rung = part.rung,
            .counts = part.first,
            .conditions = {},
            .outputs = {},
            .decisions = {},
            .expressions = {},
            .last = {}};
  const std::vector<std::vector<Guard>> guards = guardsOf(*part.code);
  std::vector<ir::ValueId> conditions;
  for (const ir::Mark& mark : part.marks) {
    std::vector<Watched>& watched = isCondition(mark) ? plan.conditions : plan.outputs;
    const uint32_t first = isCondition(mark) ? part.conditions : part.outputs;
    watched.push_back({mark.value.index, first + static_cast<uint32_t>(watched.size()), guards[mark.value.index]});
    if (isCondition(mark)) conditions.push_back(mark.value);
  }
  std::vector<std::vector<uint32_t>> outputs;
  for (const ir::ValueId value : decisionsOf(part.marks, outputs)) {
    plan.decisions.push_back(
        {value.index, part.decisions + static_cast<uint32_t>(plan.decisions.size()), guards[value.index]});
    plan.expressions.emplace_back(*part.code, value, conditions);
  }
  if (isNew) addMarks(part, plan, outputs);
  return plan;
}

void CoverageCollector::addMarks(const Part& part, const Plan& plan,
                                 const std::vector<std::vector<uint32_t>>& outputs) {
  Rung& rung = program_.rungs[part.rung];
  for (const ir::Mark& mark : part.marks) {
    if (isCondition(mark))
      rung.conditions.push_back(
          {.text = mark.text, .line = mark.line, .column = mark.column, .contact = mark.kind == ir::MarkKind::Contact});
    else
      rung.outputs.push_back(
          {.text = mark.text, .line = mark.line, .column = mark.column, .coil = mark.kind == ir::MarkKind::Coil});
  }
  for (size_t i = 0; i < plan.expressions.size(); ++i) {
    Decision& decision = rung.decisions.emplace_back();
    for (const uint32_t output : outputs[i]) decision.outputs.push_back(part.outputs + output);
    for (const uint32_t condition : plan.expressions[i].conditions())
      decision.by.push_back({part.conditions + condition, 0});
  }
}

Program CoverageCollector::program() const {
  Program program = program_;
  std::sort(program.rungs.begin(), program.rungs.end(),
            [](const Rung& a, const Rung& b) { return a.number < b.number; });
  return program;
}

void CoverageCollector::rungRan(uint32_t number, std::span<const uint64_t> values) {
  Plan& plan = plans_[number];
  if (plan.rung == UINT32_MAX) return;
  Rung& rung = program_.rungs[plan.rung];
  rung.runs += plan.counts ? 1 : 0;
  if (values.empty() || std::ranges::equal(values, plan.last)) return; // the same values show nothing new
  plan.last.assign(values.begin(), values.end());
  for (const Watched& watched : plan.conditions) {
    if (!watched.reached(values)) continue;
    Condition& condition = rung.conditions[watched.index];
    (values[watched.value] != 0 ? condition.closed : condition.open) = true;
  }
  for (const Watched& watched : plan.outputs) {
    if (!watched.reached(values)) continue;
    Output& output = rung.outputs[watched.index];
    (values[watched.value] != 0 ? output.on : output.off) = true;
  }
  for (size_t i = 0; i < plan.decisions.size(); ++i)
    if (plan.decisions[i].reached(values)) decide(plan, i, values);
}

void CoverageCollector::decide(const Plan& plan, size_t index, std::span<const uint64_t> values) {
  const Watched& decision = plan.decisions[index];
  const Expression& expression = plan.expressions[index];
  std::vector<Deciding>& by = program_.rungs[plan.rung].decisions[decision.index].by;
  const bool on = values[decision.value] != 0;
  expression.findDeciding(values, [&](size_t i) {
    const bool closed = values[plan.conditions[expression.conditions()[i]].value] != 0;
    by[i].alone |= closed ? (on ? kClosedOn : kClosedOff) : (on ? kOpenOn : kOpenOff);
  });
}

// ---- several programs -----------------------------------------------------------------------------------------------

namespace {

class Delivery final : public ir::RungObserver {
public:
  Delivery(Collection& collection, const ir::Module& module, const ir::Marks& marks)
      : collection_(collection), collector_(module, marks) {}
  ~Delivery() override { collection_.add(collector_.program()); }
  void rungRan(uint32_t number, std::span<const uint64_t> values) override { collector_.rungRan(number, values); }

private:
  Collection& collection_;
  CoverageCollector collector_;
};

} // namespace

std::unique_ptr<ir::RungObserver> Collection::observe(const ir::Module& module, const ir::Marks& marks) {
  return std::make_unique<Delivery>(*this, module, marks);
}

void Collection::add(const Program& program) {
  const std::lock_guard lock(mutex_);
  merge(report_, CoverageReport{{program}});
}

// Threads finish in any order; the report does not depend on it.
CoverageReport Collection::report() const {
  const std::lock_guard lock(mutex_);
  CoverageReport report = report_;
  std::sort(report.programs.begin(), report.programs.end(), [](const Program& a, const Program& b) {
    return std::pair(a.files, a.rungs.size()) < std::pair(b.files, b.rungs.size());
  });
  return report;
}

// Decisions as functions of conditions.

namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr size_t kFlips = 63; // lane 0 flips nothing

uint64_t spread(uint64_t bit) { return bit == 0 ? 0 : ~uint64_t{0}; }

} // namespace

bool Expression::isLogic(const ir::Op& op) {
  if (op.type != ir::Type::Bit) return false;
  return op.code == ir::OpCode::And || op.code == ir::OpCode::Or || op.code == ir::OpCode::Xor ||
         op.code == ir::OpCode::Not || op.code == ir::OpCode::Select;
}

Expression::Kind Expression::kindOf(ir::OpCode code) {
  if (code == ir::OpCode::And) return Kind::And;
  if (code == ir::OpCode::Or) return Kind::Or;
  if (code == ir::OpCode::Xor) return Kind::Xor;
  return code == ir::OpCode::Not ? Kind::Not : Kind::Select;
}

// Operands are defined before they are used, so one backward walk finds what the root needs, and one forward walk makes
// the nodes.
Expression::Expression(const ir::Rung& rung, ir::ValueId root, std::span<const ir::ValueId> conditions) {
  std::vector<uint32_t> conditionOf(rung.values.size(), kNone);
  for (uint32_t i = 0; i < conditions.size(); ++i) conditionOf[conditions[i].index] = i;
  std::vector<bool> needed(rung.values.size(), false);
  needed[root.index] = true;
  const auto opens = [&](const ir::Op& op) {
    return isLogic(op) && needed[op.result.index] && conditionOf[op.result.index] == kNone;
  };
  for (size_t i = rung.ops.size(); i-- > 0;)
    if (opens(rung.ops[i]))
      for (int a = 0; a < rung.ops[i].argCount; ++a) needed[ir::arg(rung, rung.ops[i], a).index] = true;
  std::vector<uint32_t> nodeOf(rung.values.size(), kNone);
  const auto add = [&](uint32_t value, Node node) {
    nodeOf[value] = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back(node);
  };
  const auto addLeaf = [&](uint32_t value) {
    if (conditionOf[value] == kNone) return add(value, {.kind = Kind::Held, .value = value});
    add(value, {.kind = Kind::Condition, .a = static_cast<uint32_t>(conditions_.size()), .value = value});
    conditions_.push_back(conditionOf[value]);
  };
  for (const ir::Op& op : rung.ops) {
    if (opens(op)) {
      uint32_t args[3] = {};
      for (int a = 0; a < op.argCount; ++a) args[a] = nodeOf[ir::arg(rung, op, a).index];
      add(op.result.index, {.kind = kindOf(op.code), .a = args[0], .b = args[1], .c = args[2]});
      if (op.result == root) break; // the root must be the last node
      continue;
    }
    for (uint32_t r = 0; r < op.resultCount; ++r)
      if (needed[op.result.index + r]) addLeaf(op.result.index + r);
  }
}

// The root in 64 lanes; in lane l condition first + l - 1 is flipped, in lane 0 none.
uint64_t Expression::evaluate(std::span<const uint64_t> values, size_t first, std::vector<uint64_t>& lanes) const {
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    uint64_t& out = lanes[i];
    switch (node.kind) {
    case Kind::Held: out = spread(values[node.value]); break;
    case Kind::Condition:
      out = spread(values[node.value]);
      if (node.a >= first && node.a < first + kFlips) out ^= uint64_t{2} << (node.a - first);
      break;
    case Kind::And: out = lanes[node.a] & lanes[node.b]; break;
    case Kind::Or: out = lanes[node.a] | lanes[node.b]; break;
    case Kind::Xor: out = lanes[node.a] ^ lanes[node.b]; break;
    case Kind::Not: out = ~lanes[node.a]; break;
    case Kind::Select: out = (lanes[node.a] & lanes[node.b]) | (~lanes[node.a] & lanes[node.c]); break;
    }
  }
  return lanes.back();
}

void Expression::findDeciding(std::span<const uint64_t> values, const std::function<void(size_t i)>& decides) const {
  std::vector<uint64_t> lanes(nodes_.size());
  for (size_t first = 0; first < conditions_.size(); first += kFlips) {
    const uint64_t result = evaluate(values, first, lanes);
    uint64_t flipped = result ^ spread(result & 1); // lanes that differ from lane 0
    for (; flipped != 0; flipped &= flipped - 1) decides(first + static_cast<size_t>(std::countr_zero(flipped)) - 1);
  }
}

} // namespace rung::report
