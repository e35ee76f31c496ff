// Coverage of a program in the terms of its drawing (see coverage_overlay.h).
#include "tools/rungc/coverage_overlay.h"

#include <fmt/format.h>
#include <map>
#include <utility>

namespace rung::rungc {
namespace {

using Element = view::ElementOverlay;

std::string summaryLine(std::string_view what, const report::Share& share) {
  return fmt::format("{}: {} of {}, {}", what, share.seen, share.all, report::percentText(share));
}

void say(Element& element, const std::string& text) {
  if (text.empty()) return;
  element.detail += element.detail.empty() ? text : "; " + text;
}

// The elements of one rung by line and column: the inputs of a box and its result are one element.
class Elements {
public:
  explicit Elements(const report::Rung& rung) : rung_(rung) {
    for (const report::Output& output : rung.outputs) add(output);
    for (const report::Condition& condition : rung.conditions) add(condition);
    for (const report::Decision& decision : rung.decisions)
      for (const report::Deciding& deciding : decision.by) add(decision, deciding);
  }
  void appendTo(std::vector<Element>& all) const {
    for (const auto& [place, element] : byPlace_) all.push_back(element);
  }

private:
  template <class Part>
  std::pair<Element&, bool> at(const Part& part) {
    const auto [found, isNew] = byPlace_.try_emplace({part.line, part.column});
    found->second.place = {rung_.file, part.line, part.column};
    return {found->second, isNew};
  }
  // Of a box with several pins the first gives its state, the others are in its detail.
  void add(const report::Output& output) {
    const auto [element, isNew] = at(output);
    if (!isNew) return say(element, named(output.text, report::missingOf(output)));
    element.kind = output.coil ? Element::Kind::Coil : Element::Kind::Box;
    element.off = output.off;
    element.on = output.on;
  }
  void add(const report::Condition& condition) {
    const auto [element, isNew] = at(condition);
    if (!isNew) return say(element, named("its result", report::missingOf(condition)));
    element.kind = condition.contact ? Element::Kind::Contact : Element::Kind::Box;
    element.off = condition.open;
    element.on = condition.closed;
  }
  void add(const report::Decision& decision, const report::Deciding& deciding) {
    if (deciding.bothWays()) return;
    Element& element = at(rung_.conditions[deciding.condition]).first;
    element.decided = false;
    say(element, report::missingOf(deciding, rung_.outputs[decision.outputs[0]].text));
  }
  static std::string named(std::string_view what, const std::string& missing) {
    return missing.empty() ? std::string() : fmt::format("{}: {}", what, missing);
  }

  const report::Rung& rung_;
  std::map<std::pair<uint32_t, uint32_t>, Element> byPlace_;
};

view::Run runOf(const report::Rung& rung) {
  view::Run run;
  run.state = rung.runs > 0 ? view::Run::State::Ran : view::Run::State::Never;
  if (rung.runs > 0) run.label = rung.runs == 1 ? "ran once" : fmt::format("ran {} times", rung.runs);
  return run;
}

} // namespace

view::Overlay overlayOf(const report::Program& program) {
  const report::Totals totals = report::totalsOf(program.rungs);
  view::Overlay overlay;
  overlay.title = "Coverage";
  overlay.summary = {summaryLine("rungs run", totals.rungs), summaryLine("contacts open and closed", totals.contacts),
                     summaryLine("coils on and off", totals.coils),
                     summaryLine("conditions shown to decide", totals.decided)};
  for (const report::Rung& rung : program.rungs) {
    overlay.rungs.push_back({rung.number, {rung.file, rung.line, 0}, runOf(rung)});
    Elements(rung).appendTo(overlay.elements);
  }
  return overlay;
}

} // namespace rung::rungc
