// Rows, their order and their sums (see profile.h).
#include "tools/report/profile_rungs.h"

#include <algorithm>
#include <map>

namespace rung::report {
namespace {

Row describe(const rung_program& program, uint32_t rung) {
  const rung_rung_info& info = program.rungs[rung];
  Row row;
  row.rung = rung;
  row.number = info.number;
  row.key = info.key;
  row.routine = info.routine < program.routine_count ? program.routines[info.routine] : "";
  row.title = info.title != nullptr ? info.title : "";
  row.file = info.file < program.file_count ? program.files[info.file] : "";
  row.line = info.first_line;
  return row;
}

void setTimes(Row& row, const ProfileCollector& ticks, double scale) {
  const runtime::Histogram& perScan = ticks.rungs()[row.rung].perScan;
  const auto ns = [&](double value) { return std::max(0.0, value - ticks.cost()) * scale; };
  row.minNs = ns(static_cast<double>(perScan.min()));
  row.medianNs = ns(perScan.quantile(0.5));
  row.meanNs = ns(perScan.trimmedMean());
  row.p99Ns = ns(perScan.quantile(0.99));
  row.maxNs = ns(static_cast<double>(perScan.max()));
  row.time = static_cast<double>(row.scans) * row.meanNs;
}

Row makeRow(const rung_program& program, uint32_t rung, const ProfileCollector* operations,
            const ProfileCollector* ticks, double scale) {
  Row row = describe(program, rung);
  const ProfileCollector::Rung& counted = (operations != nullptr ? operations : ticks)->rungs()[rung];
  row.executions = counted.executions;
  row.scans = counted.scans;
  if (operations != nullptr) row.operations = static_cast<uint64_t>(counted.total);
  if (ticks != nullptr) setTimes(row, *ticks, scale);
  return row;
}

double measureOf(Order order, uint64_t operations, double time) {
  return order == Order::Operations ? static_cast<double>(operations) : time;
}

template <class Line>
void sortByMeasure(std::vector<Line>& lines, Order order) {
  std::stable_sort(lines.begin(), lines.end(), [&](const Line& a, const Line& b) {
    const double left = measureOf(order, a.operations, a.time);
    const double right = measureOf(order, b.operations, b.time);
    return left != right ? left > right : a.executions > b.executions;
  });
}

template <class Line>
void setShares(std::vector<Line>& lines, const ProfileReport& report) {
  const double whole = measureOf(report.order, report.operations, report.time);
  if (whole <= 0) return;
  for (Line& line : lines) line.share = measureOf(report.order, line.operations, line.time) / whole;
}

std::string sumName(const Row& row, SumBy by) {
  if (by == SumBy::File) return row.file;
  return by == SumBy::Module ? row.routine.substr(0, row.routine.find('.')) : row.routine;
}

} // namespace

ProfileReport makeReport(const rung_program& program, const ProfileCollector* operations, const ProfileCollector* ticks,
                         const runtime::ProfileClock& clock, Order order) {
  ProfileReport report;
  report.program = program.name;
  report.dialect = program.dialect;
  report.order = operations == nullptr ? Order::Time : order;
  report.clock = clock;
  for (uint32_t i = 0; (operations != nullptr || ticks != nullptr) && i < program.rung_count; ++i) {
    Row row = makeRow(program, i, operations, ticks, clock.nsPerTick);
    report.operations += row.operations;
    report.time += row.time;
    const bool added = row.number == 0;
    if (row.executions == 0 && added) continue;
    (added ? report.added : row.executions == 0 ? report.never : report.rows).push_back(std::move(row));
  }
  for (std::vector<Row>* rows : {&report.rows, &report.added}) {
    setShares(*rows, report);
    sortByMeasure(*rows, report.order);
  }
  return report;
}

std::vector<Sum> sums(const ProfileReport& report, SumBy by) {
  std::map<std::string, Sum> byName;
  for (const std::vector<Row>* rows : {&report.rows, &report.added, &report.never})
    for (const Row& row : *rows) {
      Sum& sum = byName[sumName(row, by)];
      sum.rungs += 1;
      sum.ran += row.executions != 0 ? 1 : 0;
      sum.executions += row.executions;
      sum.operations += row.operations;
      sum.time += row.time;
    }
  std::vector<Sum> sums;
  for (auto& [name, sum] : byName) {
    sum.name = name;
    sums.push_back(std::move(sum));
  }
  setShares(sums, report);
  sortByMeasure(sums, report.order);
  return sums;
}

} // namespace rung::report
