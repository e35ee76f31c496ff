// Counters to rows, rows to text and JSON.
#include "rtlib/profile/profile.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "rtlib/core/ticks.h"

namespace rung::profile {

namespace {

int64_t monotonicNs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

double calibrate() {
  constexpr int64_t kMeasureNs = 10'000'000;
  const int64_t startNs = monotonicNs();
  const uint64_t startTicks = rt::readTicks();
  int64_t endNs = startNs;
  while (endNs - startNs < kMeasureNs) endNs = monotonicNs();
  const uint64_t ticks = rt::readTicks() - startTicks;
  return ticks == 0 ? 1.0 : static_cast<double>(endNs - startNs) / static_cast<double>(ticks);
}

Row makeRow(const rung_program& program, uint32_t rung, const rung_prof& counter, double scale) {
  const rung_rung_info& info = program.rungs[rung];
  Row row;
  row.rung = rung;
  row.routine = info.routine < program.routine_count ? program.routines[info.routine] : "";
  row.title = info.title != nullptr ? info.title : "";
  row.file = info.file < program.file_count ? program.files[info.file] : "";
  row.line = info.first_line;
  row.executions = counter.count;
  row.totalNs = static_cast<double>(counter.total) * scale;
  row.meanNs = row.totalNs / static_cast<double>(counter.count);
  row.maxNs = static_cast<double>(counter.max) * scale;
  return row;
}

std::string lineText(const Row& row) {
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, "%6u %12llu %12.3f %10.1f %10.1f %6.1f%%  ", row.rung,
                static_cast<unsigned long long>(row.executions), row.totalNs / 1000, row.meanNs, row.maxNs,
                row.share * 100);
  std::string text = numbers;
  if (row.file.empty())
    text += "added by the compiler to " + row.routine;
  else
    text += row.file + ":" + std::to_string(row.line);
  if (!row.title.empty()) text += "  " + row.title;
  return text + "\n";
}

} // namespace

double nsPerTick() {
  static const double scale = calibrate();
  return scale;
}

Report makeReport(const rung_program& program, std::span<const rung_prof> counters, double nanosecondsPerTick) {
  Report report;
  report.program = program.name;
  report.dialect = program.dialect;
  report.rungs = program.rung_count;
  for (uint32_t i = 0; i < program.rung_count && i < counters.size(); ++i) {
    if (counters[i].count == 0) continue;
    report.rows.push_back(makeRow(program, i, counters[i], nanosecondsPerTick));
    report.totalNs += report.rows.back().totalNs;
  }
  for (Row& row : report.rows) row.share = report.totalNs > 0 ? row.totalNs / report.totalNs : 0;
  std::sort(report.rows.begin(), report.rows.end(), [](const Row& a, const Row& b) {
    if (a.totalNs != b.totalNs) return a.totalNs > b.totalNs;
    return a.executions != b.executions ? a.executions > b.executions : a.rung < b.rung;
  });
  return report;
}

std::string reportText(const Report& report, uint32_t limit) {
  std::string text = report.program + " (" + report.dialect + "): " + std::to_string(report.rows.size()) + " of " +
                     std::to_string(report.rungs) + " rungs ran\n";
  text += "  rung   executions     total us    mean ns     max ns   share  place\n";
  const size_t shown = limit == 0 ? report.rows.size() : std::min<size_t>(limit, report.rows.size());
  for (size_t i = 0; i < shown; ++i) text += lineText(report.rows[i]);
  if (shown < report.rows.size()) text += "  ... and " + std::to_string(report.rows.size() - shown) + " more\n";
  return text;
}

std::string reportJson(const Report& report) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Row& row : report.rows) {
    rows.push_back({{"rung", row.rung},
                    {"routine", row.routine},
                    {"title", row.title},
                    {"file", row.file},
                    {"line", row.line},
                    {"executions", row.executions},
                    {"total_ns", row.totalNs},
                    {"mean_ns", row.meanNs},
                    {"max_ns", row.maxNs},
                    {"share", row.share}});
  }
  const nlohmann::ordered_json json = {{"program", report.program},
                                       {"dialect", report.dialect},
                                       {"total_ns", report.totalNs},
                                       {"rung_count", report.rungs},
                                       {"rungs", std::move(rows)}};
  // Titles come from source files of any encoding: what is no UTF-8 is replaced, not thrown.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace rung::profile
