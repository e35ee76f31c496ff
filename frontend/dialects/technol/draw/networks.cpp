// Draws equations (see networks.h).
#include "frontend/dialects/technol/draw/networks.h"

#include <algorithm>
#include <utility>

#include "frontend/dialects/technol/check/analysis.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/routine_builder.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "rtlib/text/blanks.h"

namespace rung::frontend::technol {

using chart::Node;
using chart::NodeKind;

namespace {

constexpr std::string_view kExclusive = "=1"; // the mark of a box whose output is its inputs' exclusive or

// Whether it is shown: NIL is, a bare `-` and what is left out are not.
bool isWritten(const Operand& operand) { return operand.given() || (!operand.tokens.empty() && spell(operand) != "-"); }

class Networks {
public:
  Networks(const TypedProgram& program, chart::Rung& rung) : program_(program), rung_(rung) {}

  void add(uint32_t index);
  void finish();

private:
  using NodeId = uint32_t;
  // A condition with the outputs that it leads to. A level continues the one below it.
  struct Level {
    NodeId condition = kNone;
    std::vector<NodeId> outputs;
  };

  const Row& row() const { return *statement().row; }
  const Statement& statement() const { return program_.source.statements[index_]; }
  std::span<const Operand> operands() const { return program_.operandsOf(program_.statements[index_]); }
  bool has(uint16_t effects) const { return (row().effects & effects) != 0; }

  // The comment after the current statement; nothing in the first line of the rung, where it is the title.
  std::string comment() const {
    return statement().line == rung_.line ? "" : std::string(commentAfter(program_.source, statement()));
  }
  NodeId make(Node node);
  NodeId combined(NodeKind kind, NodeId left, NodeId right);
  std::string_view label(size_t operand) const;
  chart::Operand written(const Operand& operand, std::string_view label) const;
  NodeId contact(const Operand& operand, std::string mark);
  NodeId coil(const Operand* operand, std::string mark);
  NodeId value(std::string name);
  void addTo(Node& box, bool own) const;
  void addData(Node& box);
  NodeId box();

  void equation();
  void load(NodeId node, bool stores);
  void follow(NodeId node);
  void join(int logic);
  bool needsRail(NodeId node) const;
  bool worksOnLeft(NodeId node) const;
  void combine(int logic, NodeId left, NodeId right);
  void output();
  void alone();
  void data();
  std::vector<NodeId> outputs();

  NodeId take();
  Level& power();
  void closeEquation();
  void closeData();
  void network(NodeId node) { done_.push_back(node); }
  uint32_t firstStatement(NodeId node) const;

  const TypedProgram& program_;
  chart::Rung& rung_;
  uint32_t index_ = 0;        // of the current statement
  std::vector<Level> levels_; // of the open equation; none: RLO comes from before
  std::vector<NodeId> stack_;
  std::vector<uint32_t> data_; // statements that have worked on DR and are in no box yet
  std::vector<NodeId> done_;   // finished networks
};

uint32_t Networks::make(Node node) {
  if (node.statement == kNone && node.kind != NodeKind::Series && node.kind != NodeKind::Parallel &&
      node.kind != NodeKind::Outputs) {
    const RungSource at = sourceOf(program_.source, statement());
    node.statement = index_;
    node.line = at.line;
    node.column = at.column;
  }
  rung_.nodes.push_back(std::move(node));
  return static_cast<uint32_t>(rung_.nodes.size()) - 1;
}

// Series of series and branches of branches are one. `left` and `right` are used up.
uint32_t Networks::combined(NodeKind kind, NodeId left, NodeId right) {
  Node node{.kind = kind};
  for (const NodeId part : {left, right}) {
    Node& one = rung_.nodes[part];
    if (one.kind != kind)
      node.parts.push_back(part);
    else if (node.parts.empty())
      node.parts = std::move(one.parts);
    else
      node.parts.insert(node.parts.end(), one.parts.begin(), one.parts.end());
  }
  return make(std::move(node));
}

std::string_view Networks::label(size_t operand) const {
  const auto& infos = row().info.operands;
  return infos.size() == 0 ? "" : infos[std::min(operand, infos.size() - 1)].name;
}

chart::Operand Networks::written(const Operand& operand, std::string_view label) const {
  chart::Operand made{.label = std::string(label), .text = spell(operand)};
  if (operand.form == Operand::Form::Bit && operand.negated && made.text.starts_with('-')) made.text.erase(0, 1);
  made.use = useOf(program_, operand);
  const std::span<const NameUse> names = program_.namesOf(operand);
  if (names.empty()) return made;
  made.name = names.front().definition;
  if (operand.form == Operand::Form::Name) made.target = targetOf(program_.symbols, made.name, operand.range, false);
  return made;
}

uint32_t Networks::contact(const Operand& operand, std::string mark) {
  const bool negated = operand.form == Operand::Form::Bit && operand.negated;
  return make({.kind = NodeKind::Contact,
               .mark = negated ? "/" : std::move(mark),
               .operands = {written(operand, {})},
               .comment = comment()});
}

uint32_t Networks::coil(const Operand* operand, std::string mark) {
  Node node{.kind = NodeKind::Coil, .mark = std::move(mark)};
  if (operand != nullptr) node.operands.push_back(written(*operand, {}));
  node.comment = comment();
  return make(std::move(node));
}

// A value that has no name in the program.
uint32_t Networks::value(std::string name) {
  return make({.kind = NodeKind::Contact, .operands = {{.text = std::move(name)}}});
}

// Adds the current statement to a box: as the box's own instruction or as one of its lines.
void Networks::addTo(Node& box, bool own) const {
  const std::string_view mnemonic = row().info.mnemonic;
  const std::string comment = this->comment();
  if (!comment.empty()) box.comment.append(box.comment.empty() ? "" : "; ").append(comment);
  box.text.append(box.text.empty() ? "" : "; ").append(mnemonic);
  std::string_view before = " ";
  if (!own && std::ranges::none_of(operands(), isWritten)) box.operands.push_back({.label = std::string(mnemonic)});
  for (size_t i = 0; i < operands().size(); ++i) {
    const Operand& operand = operands()[i];
    if (!isWritten(operand)) continue;
    const bool first = before == " ";
    box.operands.push_back(written(operand, own ? label(i) : first ? mnemonic : ""));
    box.text.append(std::exchange(before, ",")).append(box.operands.back().text);
  }
}

// The statements that have worked on DR, as lines of a box.
void Networks::addData(Node& box) {
  const uint32_t current = index_;
  for (const uint32_t statement : std::exchange(data_, {})) {
    index_ = statement;
    addTo(box, false);
  }
  index_ = current;
}

// A box of the current statement, with those before it that have set DR for it.
uint32_t Networks::box() {
  Node node{.kind = NodeKind::Box, .title = std::string(row().info.mnemonic)};
  const bool isPlain = data_.size() == 1 && program_.source.statements[data_[0]].row->lower == &lowerLoad;
  addData(node);
  addTo(node, true);
  // "POCKET EQ TOOL_WANTED" reads better than "LOD POCKET; EQ TOOL_WANTED".
  if (isPlain && row().lower == &lowerCompare)
    node.text = node.operands[0].text + " " + node.title + " " + node.operands[1].text;
  return make(std::move(node));
}

// ---- the equation ---------------------------------------------------------------------------------------------------

// RLO as one condition; what already has outputs is finished first.
uint32_t Networks::take() {
  if (levels_.size() == 1 && levels_[0].outputs.empty()) return std::exchange(levels_, {})[0].condition;
  closeEquation();
  return value("RLO");
}

Networks::Level& Networks::power() {
  if (levels_.empty()) levels_.push_back({value("RLO"), {}});
  return levels_.back();
}

// RLO becomes `node`; its former value is stored if the statement does so, otherwise it is not used any more.
void Networks::load(NodeId node, bool stores) {
  if (stores)
    stack_.push_back(take());
  else
    closeEquation();
  levels_.push_back({node, {}});
}

// RLO becomes its value after `node`.
void Networks::follow(NodeId node) {
  Level& level = power();
  if (level.outputs.empty())
    level.condition = combined(NodeKind::Series, level.condition, node);
  else
    levels_.push_back({node, {}});
}

// What leads to the second pin of a box begins at the rail.
bool Networks::needsRail(NodeId node) const {
  const Node& one = rung_.nodes[node];
  if (one.kind == NodeKind::Box && !one.parts.empty()) return true;
  return std::ranges::any_of(one.parts, [&](NodeId part) { return needsRail(part); });
}

// Whether it is more than a condition beside others: a NOT or a timer works on all that is at its left.
bool Networks::worksOnLeft(NodeId node) const {
  const Node& one = rung_.nodes[node];
  if (one.kind == NodeKind::Contact) return one.mark == "NOT";
  if (one.kind == NodeKind::Box)
    return (program_.source.statements[one.statement].row->effects & kReadsRlo) != 0 || needsRail(node);
  return std::ranges::any_of(one.parts, [&](NodeId part) { return worksOnLeft(part); });
}

// What works on all that is at its left comes first in a series, and is the only one of its kind there: the value of
// another one is stored.
void Networks::combine(int logic, NodeId left, NodeId right) {
  if (logic == kAnd && worksOnLeft(right)) {
    if (worksOnLeft(left)) {
      network(combined(NodeKind::Series, left, make({.kind = NodeKind::Coil, .operands = {{.text = "STACK"}}})));
      left = value("STACK");
    }
    std::swap(left, right);
  }
  if (logic == kXor) {
    const NodeId both = make({.kind = NodeKind::Box,
                              .mark = std::string(kExclusive),
                              .title = std::string(row().info.mnemonic),
                              .parts = {right}});
    levels_.push_back({combined(NodeKind::Series, left, both), {}});
    return;
  }
  levels_.push_back({combined(logic == kAnd ? NodeKind::Series : NodeKind::Parallel, left, right), {}});
}

void Networks::join(int logic) {
  if (!operands().empty() && operands()[0].given()) {
    if (logic == kAnd) return follow(contact(operands()[0], {}));
    if (logic == kXor) {
      const NodeId made = box();
      rung_.nodes[made].mark = kExclusive;
      return follow(made);
    }
    const NodeId former = take();
    return combine(logic, former, contact(operands()[0], {}));
  }
  const NodeId right = take();
  const NodeId left = stack_.empty() ? value("STACK") : stack_.back();
  if (!stack_.empty()) stack_.pop_back();
  combine(logic, left, right);
}

// Statements that set RLO.
void Networks::equation() {
  const LowerFn lower = row().lower;
  const bool stores = program_.statements[index_].stack.pushed != kNone;
  if (lower == &lowerLoadBit || lower == &lowerLicence) return load(contact(operands()[0], {}), stores);
  if (lower == &lowerEdge) return load(contact(operands()[0], row().variant != 0 ? "P" : "N"), false);
  if (lower == &lowerJoin) return join(row().variant);
  if (lower == &lowerComplement) return follow(make({.kind = NodeKind::Contact, .mark = "NOT"}));
  if (!has(kReadsDr)) closeData();
  const NodeId node = box();
  if (has(kReadsRlo)) return follow(node);
  load(node, stores);
}

// ---- outputs --------------------------------------------------------------------------------------------------------

std::vector<uint32_t> Networks::outputs() {
  const std::span<const Operand> o = operands();
  std::vector<NodeId> made;
  if (row().lower == &lowerWrite) {
    for (const Operand& bit : o) made.push_back(coil(&bit, {}));
  } else if (row().lower == &lowerFlag) {
    for (const Operand& bit : o.subspan(1)) made.push_back(coil(&bit, o[0].value != 0 ? "S" : "R"));
  } else if (row().lower == &lowerJump) {
    made.push_back(coil(o.data(), std::string(row().info.mnemonic)));
  } else if (has(kWaits) && o.empty()) {
    made.push_back(coil(nullptr, std::string(row().info.mnemonic)));
  } else {
    if (!has(kReadsDr)) closeData();
    made.push_back(box());
  }
  for (size_t i = 1; i < made.size(); ++i) rung_.nodes[made[i]].comment.clear();
  return made;
}

// Statements that depend on RLO.
void Networks::output() {
  const std::vector<NodeId> made = outputs();
  std::vector<NodeId>& all = power().outputs;
  all.insert(all.end(), made.begin(), made.end());
}

// Statements that do not: they are connected to the rail.
void Networks::alone() {
  if (!levels_.empty() && !levels_[0].outputs.empty()) closeEquation();
  if (row().lower == &lowerMoveBit) {
    const NodeId from = contact(operands()[1], {});
    rung_.nodes[from].comment.clear();
    return network(combined(NodeKind::Series, from, coil(operands().data(), {})));
  }
  std::vector<NodeId> made = outputs();
  if (row().lower == &lowerCall) closeEquation(); // RLO goes into the procedure
  network(made.size() == 1 ? made[0] : make({.kind = NodeKind::Outputs, .parts = std::move(made)}));
}

void Networks::closeEquation() {
  while (!levels_.empty()) {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    if (level.outputs.empty()) level.outputs.push_back(make({.kind = NodeKind::Coil, .operands = {{.text = "RLO"}}}));
    const NodeId end = level.outputs.size() == 1 ? level.outputs[0]
                                                 : make({.kind = NodeKind::Outputs, .parts = std::move(level.outputs)});
    const NodeId whole = combined(NodeKind::Series, level.condition, end);
    if (levels_.empty())
      network(whole);
    else
      levels_.back().outputs.push_back(whole);
  }
}

// A single statement is a box of its own; several are one.
void Networks::closeData() {
  if (data_.empty()) return;
  const uint32_t current = std::exchange(index_, data_.back());
  if (data_.size() == 1) {
    data_.clear();
    network(box());
  } else {
    Node node{.kind = NodeKind::Box, .title = "DR"};
    addData(node);
    network(make(std::move(node)));
  }
  index_ = current;
}

void Networks::add(uint32_t index) {
  index_ = index;
  if (row().role != Role::Code) {
    closeData();
    const uint32_t node = box();
    if (operands().empty() && statement().tokenCount != 0)
      rung_.nodes[node].title += " " + spelled(program_.source.operandTokens(statement()));
    return network(node);
  }
  if (has(kSetsRlo) && row().lower != &lowerCall) return equation();
  if (has(kReadsRlo)) return output();
  const bool worksOnDr = has(kSetsDr) || (has(kReadsDr) && row().info.group == "data");
  if (worksOnDr && !has(kWaits) && row().lower != &lowerCall) return data_.push_back(index);
  alone();
}

uint32_t Networks::firstStatement(NodeId node) const {
  const Node& one = rung_.nodes[node];
  uint32_t first = one.statement;
  for (const NodeId part : one.parts) first = std::min(first, firstStatement(part));
  return first;
}

// Values on the stack that nothing has taken are taken by another rung.
void Networks::finish() {
  closeEquation();
  closeData();
  for (const NodeId node : std::exchange(stack_, {}))
    network(combined(NodeKind::Series, node, make({.kind = NodeKind::Coil, .operands = {{.text = "STACK"}}})));
  std::ranges::stable_sort(done_, {}, [&](NodeId node) { return firstStatement(node); });
  rung_.networks.insert(rung_.networks.end(), done_.begin(), done_.end());
}

} // namespace

std::string_view commentAfter(const SourceProgram& program, const Statement& statement) {
  const FileId own = program.files[statement.file].id;
  const std::string_view line = program.sources.lineText(own, statement.line);
  const size_t at = commentOf(line);
  return at == std::string_view::npos ? std::string_view() : text::trimmed(line.substr(at + 1));
}

void addNetworks(const TypedProgram& program, std::span<const uint32_t> statements, chart::Rung& rung) {
  Networks networks(program, rung);
  for (const uint32_t statement : statements) networks.add(statement);
  networks.finish();
}

// ---- as text --------------------------------------------------------------------------------------------------------

namespace {

std::string conditionText(const chart::Rung& rung, uint32_t node);

// Whether one pair of brackets encloses the whole text.
bool isBracketed(std::string_view text) {
  int depth = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth == 0) return i > 0 && i + 1 == text.size();
  }
  return false;
}

std::string inBrackets(std::string text) {
  return text.find(' ') == std::string::npos || isBracketed(text) ? text : "(" + text + ")";
}

// What conducts after these parts if `text` does before them.
std::string seriesText(const chart::Rung& rung, std::span<const uint32_t> parts, std::string text = {}) {
  for (const uint32_t part : parts) {
    const Node& one = rung.nodes[part];
    if (one.kind == NodeKind::Contact && one.mark == "NOT") {
      text = oppositeOf(std::move(text));
    } else if (one.kind == NodeKind::Box && one.mark == kExclusive) {
      const std::string other = one.parts.empty() ? one.operands[0].text : conditionText(rung, one.parts[0]);
      text = inBrackets(std::move(text)) + " \u2295 " + inBrackets(other);
    } else {
      std::string more = conditionText(rung, part);
      const bool isBranch = one.kind == NodeKind::Parallel && (parts.size() > 1 || !text.empty());
      text.append(text.empty() ? "" : " \u00B7 ").append(isBranch ? "(" + more + ")" : more);
    }
  }
  return text;
}

std::string outputText(const Node& node) {
  if (node.kind == NodeKind::Box) return node.text;
  std::string text = node.mark;
  if (!node.operands.empty()) text.append(text.empty() ? "" : " ").append(node.operands[0].text);
  return text;
}

void addOutputs(const chart::Rung& rung, uint32_t node, const std::string& condition, uint32_t without,
                std::vector<std::string>& texts) {
  const Node& one = rung.nodes[node];
  if (one.kind == NodeKind::Series) {
    const std::span parts(one.parts);
    return addOutputs(rung, parts.back(), seriesText(rung, parts.first(parts.size() - 1), condition), without, texts);
  }
  if (one.kind != NodeKind::Outputs) {
    if (one.statement == without) return;
    std::string text = outputText(one);
    if (one.kind == NodeKind::Coil && one.mark.empty() && !condition.empty())
      text += " = " + condition;
    else if (!condition.empty())
      text += " if " + condition;
    return texts.push_back(std::move(text));
  }
  for (const uint32_t part : one.parts) addOutputs(rung, part, condition, without, texts);
}

bool contains(const chart::Rung& rung, uint32_t node, uint32_t statement) {
  const Node& one = rung.nodes[node];
  return one.statement == statement ||
         std::ranges::any_of(one.parts, [&](uint32_t part) { return contains(rung, part, statement); });
}

std::string conditionText(const chart::Rung& rung, uint32_t node) {
  const Node& one = rung.nodes[node];
  switch (one.kind) {
  case NodeKind::Contact: {
    const std::string mark = one.mark == "P" ? "\u2191" : one.mark == "N" ? "\u2193" : one.mark;
    return mark + (one.operands.empty() ? "" : one.operands[0].text);
  }
  case NodeKind::Coil:
  case NodeKind::Box: return "(" + outputText(one) + ")";
  case NodeKind::Series: return seriesText(rung, one.parts);
  case NodeKind::Parallel:
  case NodeKind::Outputs: break;
  }
  std::string text;
  for (const uint32_t part : one.parts) text.append(text.empty() ? "" : " + ").append(conditionText(rung, part));
  return text;
}

} // namespace

std::string oppositeOf(std::string condition) {
  const bool single = condition.find(' ') == std::string::npos || isBracketed(condition);
  if (single && condition.starts_with('/')) return condition.substr(1);
  return single ? "/" + condition : "/(" + condition + ")";
}

std::vector<std::string> outputTexts(const chart::Rung& rung, uint32_t network, uint32_t without) {
  std::vector<std::string> texts;
  addOutputs(rung, network, {}, without, texts);
  return texts;
}

std::string conditionOf(const chart::Rung& rung, uint32_t statement) {
  for (const uint32_t network : rung.networks) {
    std::string condition;
    for (uint32_t node = network; contains(rung, node, statement);) {
      const Node& one = rung.nodes[node];
      if (one.kind == NodeKind::Series) {
        condition = seriesText(rung, std::span(one.parts).first(one.parts.size() - 1), std::move(condition));
        node = one.parts.back();
      } else if (one.kind == NodeKind::Outputs) {
        node = *std::ranges::find_if(one.parts, [&](uint32_t part) { return contains(rung, part, statement); });
      } else {
        return condition;
      }
    }
  }
  return {};
}

} // namespace rung::frontend::technol
