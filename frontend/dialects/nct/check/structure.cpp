// Checks the structure of a module (see structure.h).
#include "frontend/dialects/nct/check/structure.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "frontend/dialects/nct/rows/operand_kinds.h"
#include "frontend/sema/call_graph.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/structure.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::nct {
namespace {

// A JMP or SBS with its target number.
struct Reference {
  uint32_t number = 0;
  uint32_t rung = 0;
  SourceRange range;
};

constexpr std::string_view kStructural[] = {"END", "JMP", "JME", "SBS", "SBN", "RET"};

bool looksStructural(std::string_view mnemonic) { return !text::mostSimilar(mnemonic, kStructural).empty(); }

// Whether an unreadable element of the rung may be an END, a jump, a label, or the begin or end of a subroutine.
bool hidesStructure(const TypedRung& rung, const SourceManager& sources) {
  const auto hides = [&](const TypedElement& element) {
    if (element.element->kind == ladder::ElementKind::Error)
      return std::ranges::any_of(ladder::boxWords(sources.text(element.element->range)), looksStructural);
    if (element.row == nullptr) return looksStructural(element.element->mnemonic);
    return element.row->info.operands.size() == 1 &&
           kindOf(element.row->info.operands[0]).parse == OperandClass::Label && !element.label;
  };
  return std::ranges::any_of(rung.elements, hides);
}

class StructureChecker {
public:
  StructureChecker(TypedModule& module, const SourceManager& sources, Diagnostics& diagnostics)
      : module_(module), sources_(sources), diagnostics_(diagnostics) {}

  void run() {
    incomplete_ = module_.partial;
    errors_ = diagnostics_.errorCount();
    module_.bodies.push_back({.first = 0, .end = 0, .number = {}});
    for (uint32_t i = 0; i < module_.rungs.size(); ++i) {
      incomplete_ |= hides(module_.rungs[i]);
      rungBegins(i);
      for (const TypedElement& element : module_.rungs[i].elements)
        if (element.row != nullptr) visit(i, element);
    }
    closeBody(static_cast<uint32_t>(module_.rungs.size()));
    // A broken rung may define what seems to be missing.
    if (!incomplete_) {
      for (const Reference& jump : jumps_) checkJump(jump);
      for (const Reference& call : calls_) checkCall(call);
      warnUnused();
      if (!misplaced_) checkRecursion();
      if (diagnostics_.errorCount() == errors_) warnShared();
    }
  }

private:
  bool hides(const TypedRung& rung) const { return rung.bad && hidesStructure(rung, sources_); }

  void rungBegins(uint32_t rung) {
    const auto& elements = module_.rungs[rung].elements;
    const bool startsBody =
        !elements.empty() && elements[0].row != nullptr && elements[0].row->flow == Flow::Subroutine;
    const bool isEnd = !elements.empty() && elements[0].row != nullptr && elements[0].row->flow == Flow::End;
    if (!ended_ || inSubroutine() || startsBody || isEnd || reportedAfterEnd_) return;
    reportedAfterEnd_ = true;
    diagnostics_.report(diag::CodeAfterEnd, module_.rungs[rung].rung->statement).note(endRange_, "the module's END");
  }

  bool inSubroutine() const { return module_.bodies.size() > 1; }

  void visit(uint32_t rung, const TypedElement& element) {
    const SourceRange range = element.element->range;
    switch (element.row->flow) {
    case Flow::None:
    case Flow::Section: return;
    case Flow::End: return end(range, module_.rungs[rung].bad);
    case Flow::Return: return ret(range);
    case Flow::Label:
      if (element.label) label(*element.label, rung, range);
      return;
    case Flow::Jump:
      if (element.label) jumps_.push_back({*element.label, rung, range});
      if (element.label) reserve(*element.label, false, range);
      return;
    case Flow::Subroutine:
      if (element.label) subroutine(*element.label, rung, range);
      return;
    case Flow::Call:
      if (element.label) calls_.push_back({*element.label, rung, range});
      if (element.label) reserve(*element.label, true, range);
      return;
    }
  }

  // Jumps and subroutines share one set of numbers (l.2942, l.2996).
  void reserve(uint32_t number, bool forSubroutine, SourceRange range) {
    Use& use = uses_[number];
    SourceRange& mine = forSubroutine ? use.subroutine : use.jump;
    const SourceRange other = forSubroutine ? use.jump : use.subroutine;
    if (!mine.valid()) mine = range;
    if (!other.valid() || use.conflict) return;
    use.conflict = true;
    diagnostics_.report(diag::LabelConflict, range).note(other, "the other use") << number;
  }

  // Records an END. `bad`: it may be in the wrong place, so code after it is not reported.
  void end(SourceRange range, bool bad) {
    if (ended_) {
      diagnostics_.report(diag::DuplicateEnd, range).note(endRange_, "the first one");
      return;
    }
    ended_ = true;
    reportedAfterEnd_ = bad;
    endRange_ = range;
  }

  void ret(SourceRange range) {
    if (inSubroutine())
      hasRet_ = true;
    else if (!incomplete_)
      diagnostics_.report(diag::RetOutsideSubroutine, range);
  }

  void label(uint32_t number, uint32_t rung, SourceRange range) {
    reserve(number, false, range);
    std::optional<uint32_t>& place = module_.labels[number];
    if (place)
      diagnostics_.report(diag::DuplicateLabel, range).note(labelRange_[number], "here") << number;
    else
      labelRange_[number] = range;
    if (!place) place = rung;
  }

  void subroutine(uint32_t number, uint32_t rung, SourceRange range) {
    reserve(number, true, range);
    if (!ended_ && !incomplete_) {
      misplaced_ = true;
      diagnostics_.report(diag::SubroutineBeforeEnd, range) << number;
    }
    closeBody(rung);
    module_.bodies.push_back({.first = rung, .end = rung, .number = number});
    bodyRange_ = range;
    hasRet_ = false;
    std::optional<uint32_t>& place = module_.subroutines[number];
    if (place)
      diagnostics_.report(diag::DuplicateSubroutine, range).note(subroutineRange_[number], "here") << number;
    else
      subroutineRange_[number] = range;
    if (!place) place = static_cast<uint32_t>(module_.bodies.size() - 1);
  }

  void closeBody(uint32_t rung) {
    Body& body = module_.bodies.back();
    body.end = rung;
    if (!body.number) return;
    const auto rungs = std::span(module_.rungs).subspan(body.first, body.end - body.first);
    if (!hasRet_ && std::ranges::none_of(rungs, [&](const TypedRung& r) { return hides(r); }))
      diagnostics_.report(diag::MissingRet, bodyRange_) << *body.number;
  }

  uint32_t bodyOf(uint32_t rung) const {
    const auto after = std::ranges::upper_bound(module_.bodies, rung, {}, [](const Body& b) { return b.first; });
    // The main part begins with rung 0 even if a subroutine does, too.
    return after == module_.bodies.begin() ? 0 : static_cast<uint32_t>(after - module_.bodies.begin() - 1);
  }

  void checkJump(const Reference& jump) {
    if (uses_[jump.number].conflict) return;
    const std::optional<uint32_t> target = module_.labels[jump.number];
    if (!target) {
      diagnostics_.report(diag::UndefinedLabel, jump.range) << jump.number << "in this module";
    } else if (misplaced_) {
      // The bounds of the bodies are unknown.
    } else if (bodyOf(*target) != bodyOf(jump.rung)) {
      diagnostics_.report(diag::JumpAcrossSubroutine, jump.range).note(labelRange_[jump.number], "its target")
          << jump.number;
    } else if (*target <= jump.rung) {
      diagnostics_.report(diag::BackwardJump, jump.range).note(labelRange_[jump.number], "its target") << jump.number;
    }
    uses_[jump.number].referenced = true;
  }

  void checkCall(const Reference& call) {
    if (uses_[call.number].conflict) return;
    if (!module_.subroutines[call.number]) diagnostics_.report(diag::UndefinedSubroutine, call.range) << call.number;
    uses_[call.number].referenced = true;
  }

  void warnUnused() {
    for (uint32_t n = 0; n < kLabels; ++n) {
      if (uses_[n].referenced || uses_[n].conflict) continue;
      if (module_.labels[n]) diagnostics_.report(diag::LabelUnused, labelRange_[n]) << n;
      if (module_.subroutines[n] && !misplaced_) diagnostics_.report(diag::SubroutineUnused, subroutineRange_[n]) << n;
    }
  }

  void checkRecursion() {
    frontend::CallGraph graph(module_.bodies.size());
    for (const Reference& call : calls_)
      if (const auto& callee = module_.subroutines[call.number]) graph.add(bodyOf(call.rung), *callee, call.range);
    const auto nameOf = [&](uint32_t body) { return fmt::format("{}", numberOf(module_.bodies[body])); };
    for (const frontend::CallGraph::Cycle& cycle : graph.order().cycles)
      diagnostics_.report(diag::RecursiveCall, cycle.call.range)
          << "subroutine " + nameOf(cycle.call.callee) << frontend::CallGraph::throughText(cycle, nameOf);
  }

  // Number of a subroutine's body. The main part, which has no number, is never called.
  static uint32_t numberOf(const Body& body) { return body.number.value_or(0); }

  // Warns of boxes with state in a body that is reached by several calls, directly or through such a body: they have
  // only one state.
  void warnShared() {
    std::vector<const Reference*> second(module_.bodies.size(), nullptr);
    std::vector<uint32_t> callers(module_.bodies.size(), 0);
    for (const Reference& call : calls_) {
      const std::optional<uint32_t>& callee = module_.subroutines[call.number];
      if (callee && ++callers[*callee] == 2) second[*callee] = &call;
    }
    // Whatever a shared body calls is shared as well; each round goes one call level deeper.
    for (bool changed = true; changed;) {
      changed = false;
      for (const Reference& call : calls_) {
        const std::optional<uint32_t>& callee = module_.subroutines[call.number];
        if (!callee || second[bodyOf(call.rung)] == nullptr || second[*callee] != nullptr) continue;
        second[*callee] = &call;
        changed = true;
      }
    }
    for (uint32_t body = 1; body < module_.bodies.size(); ++body)
      if (second[body] != nullptr) warnShared(module_.bodies[body], *second[body]);
  }

  // Reports one warning per body, at its first element with state.
  void warnShared(const Body& body, const Reference& call) {
    for (uint32_t i = body.first; i < body.end; ++i) {
      const TypedRung& rung = module_.rungs[i];
      for (const TypedElement& element : rung.elements) {
        if (element.row == nullptr) continue;
        const bool edge = element.row->shape == Shape::Contact;
        if (edge ? rung.operandsOf(element)[0].edge == 0 : !element.row->info.stateful) continue;
        diagnostics_.report(diag::SharedState, element.element->range).note(call.range, "one of the calls")
            << (edge ? "the edge" : element.row->info.mnemonic) << numberOf(body);
        return;
      }
    }
  }

  struct Use {
    SourceRange jump;
    SourceRange subroutine;
    bool conflict = false;
    bool referenced = false;
  };

  TypedModule& module_;
  const SourceManager& sources_;
  Diagnostics& diagnostics_;
  size_t errors_ = 0; // error count before this check
  std::vector<Reference> jumps_;
  std::vector<Reference> calls_;
  std::array<Use, kLabels> uses_{};
  std::array<SourceRange, kLabels> labelRange_{};
  std::array<SourceRange, kLabels> subroutineRange_{};
  bool incomplete_ = false; // an unreadable rung may contain what is missing
  bool misplaced_ = false;  // a subroutine begins before END
  bool ended_ = false;
  bool reportedAfterEnd_ = false;
  bool hasRet_ = false;
  SourceRange endRange_;
  SourceRange bodyRange_;
};

bool begins(const TypedRung& rung, Flow flow) {
  return !rung.elements.empty() && rung.elements[0].row != nullptr && rung.elements[0].row->flow == flow;
}

} // namespace

void arrangeParts(TypedModule& module) {
  std::vector<TypedRung>& rungs = module.rungs;
  const auto end = std::ranges::find_if(rungs, [](const TypedRung& rung) { return begins(rung, Flow::End); });
  const auto endAt = static_cast<uint32_t>(end - rungs.begin());
  std::vector<TypedRung> first, last;
  for (size_t part = 0; part < module.parts.size(); ++part) {
    const uint32_t from = module.parts[part];
    const auto to = part + 1 < module.parts.size() ? module.parts[part + 1] : static_cast<uint32_t>(rungs.size());
    const bool moves = from < to && to <= endAt && end != rungs.end() && begins(rungs[from], Flow::Subroutine);
    std::vector<TypedRung>& target = moves ? last : first;
    std::move(rungs.begin() + from, rungs.begin() + to, std::back_inserter(target));
  }
  std::ranges::move(last, std::back_inserter(first));
  rungs = std::move(first);
}

void checkStructure(TypedModule& module, const SourceManager& sources, Diagnostics& diagnostics) {
  StructureChecker(module, sources, diagnostics).run();
}

std::vector<bool> evaluatedOncePerRun(const TypedModule& module) {
  std::vector<bool> once(module.rungs.size(), false);
  const Body& main = module.bodies.front();
  std::fill(once.begin() + main.first, once.begin() + main.end, true);
  for (uint32_t from = main.first; from < main.end; ++from)
    for (const TypedElement& element : module.rungs[from].elements) {
      if (element.row->flow != Flow::Jump) continue;
      const uint32_t to = module.labels[element.label.value_or(0)].value_or(from);
      // The rung with the jump is evaluated to its end; the run continues at the rung with the label.
      const auto [first, end] = to > from ? std::pair(from + 1, to) : std::pair(to, from + 1);
      std::fill(once.begin() + first, once.begin() + end, false);
    }
  return once;
}

} // namespace rung::frontend::nct
