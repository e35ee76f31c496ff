// A profile as JSON (see docs/profile-format.md).
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/report/profile_text.h"

namespace rung::report {
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
  // Titles come from source files of any encoding: what is not UTF-8 is replaced, not thrown.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace rung::report
