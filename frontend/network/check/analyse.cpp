// Checks across the networks of a program: regions (§7.16), labels and jumps (§7.17), calls (§7.18), numbers.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "frontend/network/check/analyse.h"
#include "frontend/sema/call_graph.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/structure.h"

namespace rung::frontend::network {
namespace {

// The number of a label or subprogram; nullopt if the operand has been rejected.
std::optional<uint32_t> numberOf(const Network& network) {
  if (network.function.params.size() != 1 || network.function.params[0].bad) return std::nullopt;
  return static_cast<uint32_t>(network.function.params[0].value);
}

struct Label {
  uint32_t unit = 0;
  uint32_t network = 0;
  SourceRange range;
  bool used = false;
};

// Checks the regions JMP…JMPE and COM…COME of one unit.
class Regions {
public:
  Regions(Context& context, Unit& unit, bool incomplete)
      : language_(context.language), diagnostics_(context.diagnostics), unit_(unit), incomplete_(incomplete) {}

  void check() {
    for (const Network& network : unit_.networks) count(controlOf(network));
    for (uint32_t i = 0; i < unit_.networks.size(); ++i) visit(i);
    if (incomplete_) return;
    if (jmp_.open != kNone) missing(diag::MissingJmpe, jmp_);
    if (com_.open != kNone) missing(diag::MissingCome, com_);
  }

private:
  // Regions of one kind. A second begin inside a region is always an error; the number of ends in the unit shows
  // whether an end was forgotten or the regions are nested.
  struct Kind {
    Control opens;
    Control closes;
    uint32_t open = kNone;  // network that begins the open region
    int32_t unended = 0;    // begins minus ends, in the whole unit
    uint32_t skip = 0;      // ends of nested regions that are still expected
    uint32_t forgotten = 0; // begins that were treated as regions without an end

    void begin(uint32_t i) {
      if (open == kNone || unended > 0) {
        if (open != kNone) --unended, ++forgotten;
        open = i;
      } else {
        ++skip;
      }
    }
  };

  SourceRange at(uint32_t i) const { return unit_.networks[i].function.range; }
  std::string_view nameOf(Control control) const { return language_.mnemonicOf(control); }

  void count(Control control) {
    for (Kind* kind : {&com_, &jmp_}) kind->unended += control == kind->opens ? 1 : control == kind->closes ? -1 : 0;
  }

  void missing(Diag code, const Kind& kind) {
    diagnostics_.report(code, at(kind.open)) << nameOf(kind.opens) << nameOf(kind.closes);
  }

  void visit(uint32_t i) {
    const Control control = controlOf(unit_.networks[i]);
    if (control == Control::Come && ends(com_, diag::StrayCome, i)) come(i);
    unit_.networks[i].com = com_.open;
    if (control == Control::Com) begin(com_, diag::NestedCom, i);
    if (control == Control::Jmp) begin(jmp_, diag::NestedJmp, i);
    if (control == Control::Jmpe && ends(jmp_, diag::StrayJmpe, i)) jmpe(i);
  }

  void begin(Kind& kind, Diag nested, uint32_t i) {
    if (kind.open != kNone)
      diagnostics_.report(nested, at(i)).note(at(kind.open), "the outer one begins here") << nameOf(kind.opens);
    kind.begin(i);
  }

  // Whether network i ends the open region. Reports an end without a begin.
  bool ends(Kind& kind, Diag stray, uint32_t i) {
    if (kind.skip > 0)
      --kind.skip;
    else if (kind.open != kNone)
      return true;
    else if (kind.forgotten > 0)
      --kind.forgotten;
    else if (!incomplete_)
      diagnostics_.report(stray, at(i)) << nameOf(kind.closes) << nameOf(kind.opens);
    return false;
  }

  // Reports that a jump region and a common line overlap; `note` is the other region.
  void overlap(SourceRange range, const Kind& note, std::string_view what) {
    diagnostics_.report(diag::JumpOutOfCom, range).note(at(note.open), fmt::format("{} is here", nameOf(note.opens)))
        << what << nameOf(com_.opens);
  }

  void come(uint32_t i) {
    if (jmp_.open != kNone && jmp_.open > com_.open) { // the JMP region begins inside the COM region and ends outside
      overlap(at(i), jmp_, fmt::format("the {} region", nameOf(jmp_.opens)));
      overlap_ = true;
    }
    com_.open = kNone;
  }

  void jmpe(uint32_t i) {
    if (com_.open != kNone && com_.open > jmp_.open && !overlap_) overlap(at(jmp_.open), com_, nameOf(jmp_.opens));
    unit_.networks[jmp_.open].target = i;
    jmp_.open = kNone;
    overlap_ = false;
  }

  const Language& language_;
  Diagnostics& diagnostics_;
  Unit& unit_;
  bool incomplete_;
  Kind jmp_{Control::Jmp, Control::Jmpe};
  Kind com_{Control::Com, Control::Come};
  bool overlap_ = false; // whether the overlap of the open JMP region was reported
};

class Analysis {
public:
  Analysis(Context& context, Program& program, bool incomplete)
      : context_(context), language_(context.language), diagnostics_(context.diagnostics), program_(program),
        incomplete_(incomplete), calls_(program.units.size()) {}

  void run() {
    for (Unit& unit : program_.units) Regions(context_, unit, incomplete_).check();
    collect();
    resolveCalls();
    if (findCycles()) checkDepth();
    spread();
    resolveJumps();
    reportUnused();
    if (!diagnostics_.hasErrors()) checkCoils(context_, program_, order_); // errors may hide reads of a bit
    checkNumbers();
    checkOperands();
  }

private:
  void collect();
  void addLabel(uint32_t unit, uint32_t network);
  void resolveCalls();
  bool findCycles();
  void checkDepth();
  void spread();
  void reach(uint32_t unit, uint32_t level);
  bool runsInMainAlone(const Unit& unit) const;
  void resolveJumps();
  void resolveJump(uint32_t unit, Network& network);
  void resolveLeave(Network& network, const Label& label);
  void reportUnused();
  void checkNumbers();
  void checkOperands();

  template <class F>
  void eachNetwork(F f) {
    for (uint32_t u = 0; u < program_.units.size(); ++u)
      for (uint32_t n = 0; n < program_.units[u].networks.size(); ++n) f(u, n, program_.units[u].networks[n]);
  }

  Context& context_;
  const Language& language_;
  Diagnostics& diagnostics_;
  Program& program_;
  bool incomplete_;
  std::map<uint32_t, Label> labels_;
  std::map<uint32_t, uint32_t> subprograms_;
  frontend::CallGraph calls_;   // between units
  std::vector<uint32_t> order_; // callees before their callers
  std::vector<bool> called_;
  bool labelLost_ = false; // a label with a bad operand may be the one that is missing
  bool jumpLost_ = false;
  bool callLost_ = false;
};

void Analysis::addLabel(uint32_t unit, uint32_t index) {
  const Network& network = program_.units[unit].networks[index];
  const auto number = numberOf(network);
  if (!number) {
    labelLost_ = true;
    return;
  }
  const SourceRange range = network.function.params[0].range;
  const auto [at, isNew] = labels_.emplace(*number, Label{unit, index, range});
  if (!isNew)
    diagnostics_.report(diag::DuplicateLabel, range).note(at->second.range, "the first one is here")
        << language_.numbered(Control::Lbl, *number);
}

void Analysis::collect() {
  for (uint32_t u = 0; u < program_.units.size(); ++u)
    if (program_.units[u].kind == UnitKind::Subprogram) subprograms_.emplace(program_.units[u].number, u);
  eachNetwork([&](uint32_t u, uint32_t n, Network& network) {
    if (controlOf(network) == Control::Lbl) addLabel(u, n);
  });
}

void Analysis::resolveCalls() {
  called_.assign(program_.units.size(), false);
  eachNetwork([&](uint32_t u, uint32_t, Network& network) {
    const Control control = controlOf(network);
    if (control != Control::Call && control != Control::CallU) return;
    const auto number = numberOf(network);
    if (!number) {
      callLost_ = true;
      return;
    }
    const auto at = subprograms_.find(*number);
    if (at == subprograms_.end()) {
      if (!incomplete_)
        diagnostics_.report(diag::UndefinedSubprogram, network.function.params[0].range)
            << language_.numbered(Control::Sp, *number);
      return;
    }
    network.callee = at->second;
    called_[at->second] = true;
    calls_.add(u, at->second, network.function.range);
  });
}

// Computes order_ and reports call cycles; false if there is one.
bool Analysis::findCycles() {
  frontend::CallGraph::Order order = calls_.order();
  order_ = std::move(order.calleesFirst);
  const auto nameOfUnit = [&](uint32_t unit) { return nameOf(language_, program_.units[unit]); };
  for (const frontend::CallGraph::Cycle& cycle : order.cycles)
    diagnostics_.report(diag::RecursiveCall, cycle.call.range)
        << nameOfUnit(cycle.call.callee) << frontend::CallGraph::throughText(cycle, nameOfUnit);
  return order.cycles.empty();
}

void Analysis::checkDepth() {
  std::vector<uint32_t> depth(program_.units.size(), 0);
  std::vector<bool> runs(program_.units.size(), false);
  std::fill_n(runs.begin(), language_.levels.size(), true);
  for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
    if (!runs[*at]) continue;
    for (const frontend::CallGraph::Call& call : calls_.of(*at)) {
      runs[call.callee] = true;
      depth[call.callee] = std::max(depth[call.callee], depth[*at] + 1);
      if (depth[*at] == language_.maxCallDepth)
        diagnostics_.report(diag::NestingTooDeep, call.range) << language_.maxCallDepth;
    }
  }
}

void Analysis::reach(uint32_t unit, uint32_t level) {
  if (program_.units[unit].runBy[level]) return;
  program_.units[unit].runBy[level] = true;
  for (const frontend::CallGraph::Call& call : calls_.of(unit)) reach(call.callee, level);
}

// Determines which levels run each unit, and which units a JMPC can leave.
void Analysis::spread() {
  for (Unit& unit : program_.units) unit.runBy.assign(language_.levels.size(), false);
  for (uint32_t level = 0; level < language_.levels.size(); ++level) reach(level, level);
  for (uint32_t u : order_) {
    Unit& unit = program_.units[u];
    if (unit.kind != UnitKind::Subprogram) continue;
    unit.leaves =
        std::any_of(unit.networks.begin(), unit.networks.end(),
                    [](const Network& n) { return controlOf(n) == Control::Jmpc; }) ||
        std::ranges::any_of(calls_.of(u), [&](const auto& call) { return program_.units[call.callee].leaves; });
  }
}

void Analysis::resolveJumps() {
  eachNetwork([&](uint32_t u, uint32_t, Network& network) {
    const Control control = controlOf(network);
    if (control == Control::Jmpc && program_.units[u].kind != UnitKind::Subprogram)
      diagnostics_.report(diag::JmpcOutsideSubprogram, network.function.range) << network.function.row->info.mnemonic;
    if (control == Control::Jmpb || control == Control::Jmpc) resolveJump(u, network);
  });
}

// Whether only the main program runs the unit, or nothing calls it.
bool Analysis::runsInMainAlone(const Unit& unit) const {
  for (uint32_t level = 0; level < unit.runBy.size(); ++level)
    if (unit.runBy[level] && level != language_.mainLevel()) return false;
  return true;
}

void Analysis::resolveJump(uint32_t u, Network& network) {
  const auto number = numberOf(network);
  if (!number) {
    jumpLost_ = true;
    return;
  }
  const SourceRange range = network.function.params[0].range;
  const std::string name = language_.numbered(Control::Lbl, *number);
  const auto at = labels_.find(*number);
  if (at == labels_.end()) {
    if (!incomplete_ && !labelLost_) diagnostics_.report(diag::UndefinedLabel, range) << name << "in this program";
    return;
  }
  at->second.used = true;
  const bool leaves = controlOf(network) == Control::Jmpc;
  const Unit& unit = program_.units[u];
  if (leaves && unit.kind != UnitKind::Subprogram) return; // already reported
  if (leaves ? at->second.unit != language_.mainLevel() || !runsInMainAlone(unit) : at->second.unit != u) {
    diagnostics_.report(diag::JumpAcrossEnd, range).note(at->second.range, "the label is here") << name;
    return;
  }
  const uint32_t targetCom = program_.units[at->second.unit].networks[at->second.network].com;
  if (leaves ? network.com != kNone || targetCom != kNone : network.com != targetCom)
    diagnostics_.report(diag::JumpOutOfCom, range)
        << network.function.row->info.mnemonic << language_.mnemonicOf(Control::Com);
  if (leaves)
    resolveLeave(network, at->second);
  else
    network.target = at->second.network;
}

void Analysis::resolveLeave(Network& network, const Label& label) {
  auto& targets = program_.jumpTargets;
  const auto at = std::find(targets.begin(), targets.end(), label.network);
  network.target = static_cast<uint32_t>(at - targets.begin());
  if (at == targets.end()) targets.push_back(label.network);
}

void Analysis::reportUnused() {
  if (incomplete_) return;
  if (!jumpLost_)
    for (const auto& [number, label] : labels_)
      if (!label.used) diagnostics_.report(diag::LabelUnused, label.range) << language_.numbered(Control::Lbl, number);
  if (callLost_) return;
  for (const auto& [number, unit] : subprograms_)
    if (!called_[unit])
      diagnostics_.report(diag::SubprogramUnused, program_.units[unit].nameRange)
          << language_.numbered(Control::Sp, number);
}

// Reports numbers that are used twice (P24, P29, P39). Timers and counters share their numbers with those of the same
// instruction, edges with all edge instructions.
void Analysis::checkNumbers() {
  std::map<std::pair<int, int64_t>, SourceRange> seen;
  eachNetwork([&](uint32_t, uint32_t, Network& network) {
    const Row* row = network.function.row;
    if (row == nullptr || row->numbers == Row::Numbers::Free || network.function.params.empty() ||
        network.function.params[0].bad)
      return;
    const Diag code = row->numbers == Row::Numbers::Timer     ? diag::DuplicateTimer
                      : row->numbers == Row::Numbers::Counter ? diag::DuplicateCounter
                                                              : diag::DuplicateEdgeNumber;
    const int family = row->numbers == Row::Numbers::Edge ? -1 : row->info.number;
    const Param& number = network.function.params[0];
    if (number.value == 0) return; // the control's compiler gives it one of its own
    const auto [at, isNew] = seen.emplace(std::pair(family, number.value), number.range);
    if (!isNew) diagnostics_.report(code, number.range).note(at->second, "the first one is here") << number.value;
  });
}

void Analysis::checkOperands() {
  eachNetwork([&](uint32_t, uint32_t, Network& network) {
    const Row* row = network.function.row;
    if (row != nullptr && row->check != nullptr) row->check(context_, network);
  });
}

} // namespace

void analyse(Context& context, Program& program, bool incomplete) { Analysis(context, program, incomplete).run(); }

} // namespace rung::frontend::network
