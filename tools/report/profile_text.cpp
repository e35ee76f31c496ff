// What is printed (see text.h).
#include "tools/report/profile_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace rung::report {

DrawnRungs drawnRungs(const ProfileReport& report) {
  std::set<uint32_t> numbers;
  for (const Row& row : report.rows) numbers.insert(row.number);
  numbers.erase(0);
  const size_t ran = numbers.size();
  for (const Row& row : report.never) numbers.insert(row.number);
  numbers.erase(0);
  return {ran, numbers.size()};
}
namespace {

std::string scansText(const Profile& profile) {
  if (profile.scenarios.size() == 1) return fmt::format("{}, {} scans", profile.scenarios[0], profile.scans);
  return fmt::format("{} scenarios, {} scans", profile.scenarios.size(), profile.scans);
}

std::string headText(const Profile& profile) {
  const ProfileReport& report = profile.report;
  const auto [ran, rungs] = drawnRungs(report);
  std::string text = fmt::format("{} ({}): {}, timed in {} runs on {}\n{} of {} rungs ran", report.program,
                                 report.dialect, scansText(profile), profile.repeat, profile.engine, ran, rungs);
  if (rungs > ran) text += fmt::format("; {} never (--never lists them)", rungs - ran);
  return text + "\n";
}

// The measurement says what it costs.
std::string costText(const Profile& profile) {
  return fmt::format("a scan takes {} ({} while measured); the overhead of {} per rung is already subtracted\n",
                     durationText(profile.deadlines[0].ns.median), durationText(profile.measuredScanNs),
                     durationText(profile.report.clock.costNs()));
}

std::string percentText(double ns, double periodUs) {
  return periodUs <= 0 ? "" : fmt::format("{:.3f}% of {}", ns / periodUs / 10, durationText(periodUs * 1000));
}

std::string deadlineTable(const Profile& profile) {
  std::string text =
      fmt::format("{:<24} {:>8} {:>10} {:>10} {:>10} {:>10}\n", "", "runs", "mean", "median", "p99", "worst");
  const Spread& operations = profile.scanOperations;
  text += fmt::format("{:<24} {:>8} {:>10.1f} {:>10.0f} {:>10.0f} {:>10.0f}\n", "operations in a scan",
                      operations.count, operations.mean, operations.median, operations.p99, operations.max);
  for (const Deadline& deadline : profile.deadlines) {
    const Spread& ns = deadline.ns;
    text += fmt::format("{:<24} {:>8} {:>10} {:>10} {:>10} {:>10}  {}\n", deadline.name, ns.count,
                        durationText(ns.mean), durationText(ns.median), durationText(ns.p99), durationText(ns.max),
                        percentText(ns.max, deadline.periodUs));
  }
  return text;
}

template <class Number>
std::string worstText(const char* by, const WorstScan& worst, Number number) {
  if (!worst.known) return {};
  std::string text = fmt::format("most {}: scan {} at {:.3f} s ({}:{}), {}, usually {}\n", by, worst.scan,
                                 static_cast<double>(worst.timeUs) / 1e6, worst.file, worst.line, number(worst.value),
                                 number(worst.usual));
  for (const Cause& cause : worst.causes)
    text += fmt::format("  {}, {}: {}\n", number(cause.value),
                        cause.onlyThen ? "in no other scan" : "usually " + number(cause.usual), placeText(cause.row));
  if (worst.causes.empty()) text += "  no rung took much more than usual\n";
  return text;
}

std::string sumTables(const ProfileReport& report, uint32_t top) {
  std::string text;
  const std::vector<Sum> files = sums(report, SumBy::File);
  const std::vector<Sum> modules = sums(report, SumBy::Module);
  const std::vector<Sum> routines = sums(report, SumBy::Routine);
  if (files.size() > 1) text += sumTable(files, "file", top) + "\n";
  if (modules.size() > 1 && modules.size() != routines.size()) text += sumTable(modules, "module", top) + "\n";
  return text + sumTable(routines, "subprogram", top);
}

std::string neverText(const ProfileReport& report) {
  std::string text = "never ran:\n";
  for (const Row& row : report.never) text += "  " + placeText(row) + "\n";
  return text;
}

// "+12.5%"; nothing when there was nothing before.
std::string growthText(double now, double before) {
  return before <= 0 ? "" : fmt::format(" ({:+.1f}%)", (now / before - 1) * 100);
}

template <class Line>
std::string changesText(const char* title, const std::vector<Change>& changes, uint32_t top, Line line) {
  if (changes.empty()) return {};
  std::string text = std::string(title) + ":\n";
  const size_t shown = top == 0 ? changes.size() : std::min<size_t>(top, changes.size());
  for (size_t i = 0; i < shown; ++i) text += "  " + line(changes[i]) + ": " + placeText(changes[i].row) + "\n";
  if (shown < changes.size()) text += fmt::format("  ... and {} more\n", changes.size() - shown);
  return text;
}

} // namespace

std::string durationText(double ns) {
  if (ns < 1e3) return fmt::format("{:.1f} ns", ns);
  if (ns < 1e6) return fmt::format("{:.3g} us", ns / 1e3);
  return fmt::format("{:.4g} ms", ns / 1e6);
}

std::string profileText(const Profile& profile, const ProfileTextOptions& options) {
  std::string text = headText(profile) + costText(profile) + "\n";
  text += deadlineTable(profile) + "\n";
  text += worstText("operations", profile.worstByOperations,
                    [](double operations) { return fmt::format("{:.0f} operations", operations); });
  text += worstText("time", profile.worstByTime, durationText) + "\n";
  text += sumTables(profile.report, options.top) + "\n";
  text += fmt::format("rungs by {}; times in ns are per scan in which the rung ran\n",
                      profile.report.order == Order::Operations ? "operations" : "time (mean x scans)");
  text += rungTable(profile.report, options.top);
  if (options.never && !profile.report.never.empty()) text += "\n" + neverText(profile.report);
  return text;
}

std::string comparisonText(const Profile& profile, const Comparison& comparison, uint32_t top) {
  const Baseline& old = comparison.old;
  const ProfileReport& now = profile.report;
  const auto operations = [](const Change& c) {
    return fmt::format("{} -> {}{}", c.oldOperations, c.row.operations,
                       growthText(static_cast<double>(c.row.operations), static_cast<double>(c.oldOperations)));
  };
  const auto time = [](const Change& c) {
    return fmt::format("{} -> {} ({:.2f} times)", durationText(c.oldMeanNs), durationText(c.row.meanNs),
                       c.oldMeanNs > 0 ? c.row.meanNs / c.oldMeanNs : 0);
  };
  std::string text = "against the baseline:\n";
  if (old.scenarios != profile.scenarios || old.scans != profile.scans)
    text += fmt::format("  it is of other scenarios ({}; {} scans), which also changes the counts\n",
                        fmt::join(old.scenarios, " "), old.scans);
  text += fmt::format(
      "  operations {} -> {}{}; of a scan, median: {:.0f} -> {:.0f}; time of a scan, median: {} -> {}\n",
      old.operations, now.operations,
      growthText(static_cast<double>(now.operations), static_cast<double>(old.operations)), old.scanOperations.median,
      profile.scanOperations.median, durationText(old.scanMedianNs), durationText(profile.deadlines[0].ns.median));
  text += changesText("more operations", comparison.more, top, operations);
  text += changesText("fewer operations", comparison.fewer, top, operations);
  text += changesText("new", comparison.added, top,
                      [](const Change& c) { return fmt::format("{} operations", c.row.operations); });
  text += changesText("gone", comparison.gone, top,
                      [](const Change& c) { return fmt::format("{} operations", c.oldOperations); });
  text += changesText("slower with the same operations", comparison.slower, top, time);
  text += changesText("faster with the same operations", comparison.faster, top, time);
  return text;
}

} // namespace rung::report
