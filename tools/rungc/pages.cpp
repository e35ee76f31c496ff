// Pages with results of runs (see pages.h).
#include "tools/rungc/pages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <utility>

#include "compiler/compile.h"
#include "tools/report/profile_text.h"
#include "tools/scenario/compile_step.h"
#include "tools/view/drawn_program.h"
#include "tools/view/html.h"
#include "tools/view/overlay.h"

namespace rung::rungc {
namespace {

// A program's page with the results of the overlay on its drawing. The program is read again from its files. `project`:
// the title; "": the names of the files. Fails if a file cannot be read, or the program has errors now.
Result<std::string> pageWith(const view::Overlay& overlay, const std::vector<std::string>& files,
                             const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                             const std::string& project) {
  SourceManager sources;
  const Result<std::vector<FileId>> ids = compiler::addFiles(sources, files, options.config);
  if (!ids.ok()) return ids.failure();
  const std::string changed = fmt::format("{} was changed while its scenarios ran", files.front());
  Diagnostics diagnostics;
  auto drawing = view::drawnProgram(sources, ids.value(), dialect, options, diagnostics);
  if (!drawing) return failure(changed);
  if (!project.empty()) drawing->title = project;
  view::lay(overlay, *drawing);
  return view::renderHtml(*drawing);
}

// A profile on the drawing of its program.

using report::durationText;

view::Run runOf(const report::Row& row) {
  view::Run run;
  run.state = row.executions > 0 ? view::Run::State::Ran : view::Run::State::Never;
  if (row.executions == 0) return run;
  run.heat = row.share;
  run.label =
      fmt::format("{:.1f} %, {} operations, {} a scan", row.share * 100, row.operations, durationText(row.meanNs));
  run.detail =
      fmt::format("{} executions in {} scans; of a scan: least {}, median {}, 99th percentile {}", row.executions,
                  row.scans, durationText(row.minNs), durationText(row.medianNs), durationText(row.p99Ns));
  return run;
}

view::Overlay overlayOf(const report::Profile& profile) {
  const report::ProfileReport& report = profile.report;
  const report::Deadline& scan = profile.deadlines[0];
  view::Overlay overlay;
  overlay.title = "Profile";
  overlay.heat = report.order == report::Order::Operations ? "share of all operations" : "share of the whole time";
  const report::DrawnRungs rungs = report::drawnRungs(report);
  overlay.summary = {
      fmt::format("{}: {} scans, {} operations", fmt::join(profile.scenarios, ", "), profile.scans, report.operations),
      fmt::format("a scan: {:.0f} operations, {}; the longest {} of {}", profile.scanOperations.median,
                  durationText(scan.ns.median), durationText(scan.ns.max), durationText(scan.periodUs * 1000)),
      fmt::format("{} of {} rungs ran", rungs.ran, rungs.all)};
  for (const std::vector<report::Row>* rows : {&report.rows, &report.never})
    for (const report::Row& row : *rows) overlay.rungs.push_back({row.number, {row.file, row.line, 0}, runOf(row)});
  return overlay;
}

// Coverage of a program in terms of its drawing.

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
  // For a box with several pins the first pin gives its state, the others are in its detail.
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

} // namespace

Result<std::string> profilePage(const report::Profile& profile, const scenario::ProfileRequest& request) {
  const scenario::CompileStep step = scenario::compileProgram(request.scenarios[0], request.programs, {});
  if (!step.program) return failure("the program was changed while its scenarios ran");
  const compiler::Compiled& compiled = *step.program;
  return pageWith(overlayOf(profile), compiled.module->files, *compiled.dialect, compiled.options, compiled.project);
}

Result<std::string> coveragePage(const report::Program& program, const frontend::Dialect& dialect,
                                 const frontend::CompileOptions& options, const std::string& project) {
  return pageWith(overlayOf(program), program.files, dialect, options, project);
}

} // namespace rung::rungc
