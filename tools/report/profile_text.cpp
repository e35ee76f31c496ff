// Output of a profile.
#include "tools/report/profile_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <span>

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
  const char* scans = profile.scans == 0 ? "whole scans" : "scans";
  if (profile.scenarios.size() == 1) return fmt::format("{}, {} {}", profile.scenarios[0], profile.scans, scans);
  return fmt::format("{} scenarios, {} {}", profile.scenarios.size(), profile.scans, scans);
}

std::string headText(const Profile& profile) {
  const ProfileReport& report = profile.report;
  const auto [ran, rungs] = drawnRungs(report);
  std::string text = fmt::format("{} ({}): {}, timed in {} runs on {}\n{} of {} rungs ran", report.program,
                                 report.dialect, scansText(profile), profile.repeat, profile.engine, ran, rungs);
  if (rungs > ran) text += fmt::format("; {} never (--never lists them)", rungs - ran);
  return text + "\n";
}

// The overhead of the measurement.
std::string costText(const Profile& profile) {
  if (profile.scans == 0)
    return fmt::format("no scan was timed: only the statements scan and run make whole scans; the overhead of {} per "
                       "rung is already subtracted\n",
                       durationText(profile.report.clock.costNs()));
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
  const bool hasScans = profile.scans != 0;
  if (hasScans)
    text += fmt::format("{:<24} {:>8} {:>10.1f} {:>10.0f} {:>10.0f} {:>10.0f}\n", "operations in a scan",
                        operations.count, operations.mean, operations.median, operations.p99, operations.max);
  // The first is that of scans.
  for (const Deadline& deadline : std::span(profile.deadlines).subspan(hasScans ? 0 : 1)) {
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

// "+12.5%"; nothing if the value before was 0.
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

// A profile as JSON (see docs/profile-format.md).

namespace {

using Json = nlohmann::ordered_json;

std::string keyText(uint64_t key) { return fmt::format("{:016x}", key); }

Json placeJson(const Row& row) {
  return {{"rung", row.number}, {"index", row.rung}, {"key", keyText(row.key)}, {"routine", row.routine},
          {"title", row.title}, {"file", row.file},  {"line", row.line}};
}

Json rowJson(const Row& row) {
  Json json = placeJson(row);
  json.update({{"executions", row.executions},
               {"scans", row.scans},
               {"operations", row.operations},
               {"share", row.share},
               {"min_ns", row.minNs},
               {"median_ns", row.medianNs},
               {"mean_ns", row.meanNs},
               {"p99_ns", row.p99Ns},
               {"max_ns", row.maxNs},
               {"time_ns", row.time}});
  return json;
}

template <class List, class ToJson>
Json listJson(const List& list, ToJson toJson) {
  Json json = Json::array();
  for (const auto& item : list) json.push_back(toJson(item));
  return json;
}

Json spreadJson(const Spread& spread) {
  return {{"count", spread.count},   {"min", spread.min}, {"mean", spread.mean},
          {"median", spread.median}, {"p99", spread.p99}, {"max", spread.max}};
}

Json deadlineJson(const Deadline& deadline) {
  Json json = {{"name", deadline.name}, {"ns", spreadJson(deadline.ns)}};
  if (deadline.periodUs <= 0) return json;
  json["period_us"] = deadline.periodUs;
  json["worst_percent"] = deadline.ns.max / deadline.periodUs / 10;
  return json;
}

Json causeJson(const Cause& cause) {
  Json json = placeJson(cause.row);
  json.update({{"value", cause.value}, {"usual", cause.usual}, {"only_then", cause.onlyThen}});
  return json;
}

Json worstJson(const WorstScan& worst) {
  if (!worst.known) return nullptr;
  return {{"scenario", worst.scenario}, {"file", worst.file},
          {"line", worst.line},         {"scan", worst.scan},
          {"time_us", worst.timeUs},    {"value", worst.value},
          {"usual", worst.usual},       {"causes", listJson(worst.causes, causeJson)}};
}

Json sumJson(const Sum& sum) {
  return {{"name", sum.name},
          {"rungs", sum.rungs},
          {"ran", sum.ran},
          {"executions", sum.executions},
          {"operations", sum.operations},
          {"time_ns", sum.time},
          {"share", sum.share}};
}

Json changeJson(const Change& change) {
  Json json = placeJson(change.row);
  json.update({{"operations", change.row.operations},
               {"old_operations", change.oldOperations},
               {"mean_ns", change.row.meanNs},
               {"old_mean_ns", change.oldMeanNs}});
  return json;
}

Json comparisonJson(const Comparison& comparison) {
  const Baseline& old = comparison.old;
  return {{"program", old.program},
          {"scenarios", old.scenarios},
          {"scans", old.scans},
          {"operations", old.operations},
          {"time_ns", old.time},
          {"more", listJson(comparison.more, changeJson)},
          {"fewer", listJson(comparison.fewer, changeJson)},
          {"slower", listJson(comparison.slower, changeJson)},
          {"faster", listJson(comparison.faster, changeJson)},
          {"new", listJson(comparison.added, changeJson)},
          {"gone", listJson(comparison.gone, changeJson)}};
}

} // namespace

std::string profileJson(const Profile& profile, const Comparison* comparison) {
  const ProfileReport& report = profile.report;
  Json json = {
      {"profile", 1},
      {"program", report.program},
      {"dialect", report.dialect},
      {"code_hash", keyText(profile.codeHash)},
      {"engine", profile.engine},
      {"scenarios", profile.scenarios},
      {"repeat", profile.repeat},
      {"scans", profile.scans},
      {"order", report.order == Order::Operations ? "operations" : "time"},
      {"operations", report.operations},
      {"time_ns", report.time},
      {"cost_ns", report.clock.costNs()},
      {"measured_scan_ns", profile.measuredScanNs},
      {"scan_operations", spreadJson(profile.scanOperations)},
      {"deadlines", listJson(profile.deadlines, deadlineJson)},
      {"worst_by_operations", worstJson(profile.worstByOperations)},
      {"worst_by_time", worstJson(profile.worstByTime)},
      {"subprograms", listJson(sums(report, SumBy::Routine), sumJson)},
      {"modules", listJson(sums(report, SumBy::Module), sumJson)},
      {"files", listJson(sums(report, SumBy::File), sumJson)},
      {"rungs", listJson(report.rows, rowJson)},
      {"added", listJson(report.added, rowJson)},
      {"never", listJson(report.never, placeJson)},
  };
  if (comparison != nullptr) json["baseline"] = comparisonJson(*comparison);
  // Titles come from source files of any encoding: invalid UTF-8 is replaced, and does not throw.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Reading and matching a former profile.

namespace {

using ReadJson = nlohmann::json;

constexpr double kClearShare = 0.01; // share of the whole time: a smaller difference of one rung is noise
constexpr double kClearRatio = 1.25;

Row readRow(const ReadJson& json) {
  Row row;
  row.number = json.at("rung");
  const std::string key = json.at("key");
  std::from_chars(key.data(), key.data() + key.size(), row.key, 16);
  row.routine = json.at("routine");
  row.title = json.at("title");
  row.file = json.at("file");
  row.line = json.at("line");
  row.operations = json.value("operations", uint64_t{0});
  row.scans = json.value("scans", uint64_t{0});
  row.meanNs = json.value("mean_ns", 0.0);
  row.time = json.value("time_ns", 0.0);
  return row;
}

Baseline readProfile(const ReadJson& json) {
  Baseline baseline;
  baseline.program = json.at("program");
  baseline.scenarios = json.at("scenarios");
  baseline.scans = json.at("scans");
  baseline.operations = json.at("operations");
  baseline.time = json.at("time_ns");
  baseline.scanOperations.median = json.at("scan_operations").at("median");
  baseline.scanMedianNs = json.at("deadlines").at(0).at("ns").at("median");
  for (const char* list : {"rungs", "added", "never"})
    for (const ReadJson& row : json.at(list)) baseline.rows.push_back(readRow(row));
  return baseline;
}

std::vector<Row> allRows(const ProfileReport& report) {
  std::vector<Row> rows = report.rows;
  rows.insert(rows.end(), report.added.begin(), report.added.end());
  rows.insert(rows.end(), report.never.begin(), report.never.end());
  return rows;
}

// The rows of both profiles, to be matched by rung. In program order, so that rungs with the same text keep theirs.
class Matching {
public:
  Matching(std::vector<Row> now, std::vector<Row> old) : now_(std::move(now)), old_(std::move(old)) {
    for (std::vector<Row>* rows : {&now_, &old_})
      std::stable_sort(rows->begin(), rows->end(), [](const Row& a, const Row& b) { return a.number < b.number; });
    partner_.assign(now_.size(), nullptr);
    taken_.assign(old_.size(), false);
    match([](const Row& row) { return std::to_string(row.key); });
    match([](const Row& row) { return row.title.empty() ? std::string() : row.routine + '\n' + row.title; });
  }

  template <class Pair, class Gone>
  void forEach(Pair pair, Gone gone) const {
    for (size_t i = 0; i < now_.size(); ++i) pair(now_[i], partner_[i]);
    for (size_t i = 0; i < old_.size(); ++i)
      if (!taken_[i]) gone(old_[i]);
  }

private:
  // Pairs the remaining rows with equal names; an empty name matches nothing.
  template <class Name>
  void match(Name name) {
    std::multimap<std::string, size_t> byName;
    for (size_t i = 0; i < old_.size(); ++i)
      if (!taken_[i]) byName.emplace(name(old_[i]), i);
    for (size_t i = 0; i < now_.size(); ++i) {
      if (partner_[i] != nullptr || name(now_[i]).empty()) continue;
      const auto found = byName.find(name(now_[i])); // the first in program order
      if (found == byName.end()) continue;
      partner_[i] = &old_[found->second];
      taken_[found->second] = true;
      byName.erase(found);
    }
  }

  std::vector<Row> now_;
  std::vector<Row> old_;
  std::vector<const Row*> partner_;
  std::vector<bool> taken_;
};

void sortChanges(Comparison& result) {
  const auto sortBy = [](std::vector<Change>& list, auto measure) {
    std::stable_sort(list.begin(), list.end(),
                     [&](const Change& a, const Change& b) { return measure(a) > measure(b); });
  };
  const auto operations = [](const Change& c) {
    return std::abs(static_cast<double>(c.row.operations) - static_cast<double>(c.oldOperations));
  };
  const auto time = [](const Change& c) {
    return std::abs(c.row.meanNs - c.oldMeanNs) * static_cast<double>(c.row.scans);
  };
  for (std::vector<Change>* list : {&result.more, &result.fewer, &result.added, &result.gone})
    sortBy(*list, operations);
  for (std::vector<Change>* list : {&result.slower, &result.faster}) sortBy(*list, time);
}

} // namespace

Result<Baseline> readBaseline(std::string_view text) {
  const ReadJson json = ReadJson::parse(text, nullptr, false);
  if (json.is_discarded()) return failure("it is not JSON; write it with rungc profile --json");
  if (!json.is_object() || json.value("profile", 0) != 1)
    return failure("it is not a profile; write it with rungc profile --json");
  try {
    return readProfile(json);
  } catch (const ReadJson::exception& error) {
    return failure(std::string("a field of the profile is missing or has another type: ") + error.what());
  }
}

Comparison compare(const ProfileReport& now, Baseline old) {
  Comparison result;
  const Matching matching(allRows(now), old.rows);
  matching.forEach(
      [&](const Row& row, const Row* before) {
        if (before == nullptr) return result.added.push_back({row, 0, 0});
        const Change change{row, before->operations, before->meanNs};
        if (row.operations != before->operations)
          return (row.operations > before->operations ? result.more : result.fewer).push_back(change);
        const double difference = (row.meanNs - before->meanNs) * static_cast<double>(row.scans);
        const double larger = std::max(row.meanNs, before->meanNs);
        const double smaller = std::min(row.meanNs, before->meanNs);
        if (std::abs(difference) < kClearShare * old.time || larger < kClearRatio * smaller) return;
        (difference > 0 ? result.slower : result.faster).push_back(change);
      },
      [&](const Row& before) { result.gone.push_back({before, before.operations, before.meanNs}); });
  sortChanges(result);
  result.old = std::move(old);
  return result;
}

} // namespace rung::report
