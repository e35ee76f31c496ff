// A profile on the drawing of its program (see profile_page.h).
#include "tools/rungc/profile_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/report/profile_text.h"
#include "tools/rungc/page_with.h"
#include "tools/scenario/compile_step.h"
#include "tools/view/overlay.h"

namespace rung::rungc {
namespace {

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

} // namespace

Result<std::string> profilePage(const report::Profile& profile, const scenario::ProfileRequest& request) {
  const scenario::CompileStep step = scenario::compileProgram(request.scenarios[0], request.programs, {});
  if (!step.program) return failure("the program was changed while its scenarios ran");
  const compiler::Compiled& compiled = *step.program;
  return pageWith(overlayOf(profile), compiled.module->files, *compiled.dialect, compiled.options, compiled.project);
}

} // namespace rung::rungc
