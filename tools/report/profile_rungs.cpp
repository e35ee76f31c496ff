// Rows, their order and their sums.
#include "tools/report/profile_rungs.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <map>

namespace rung::report {

namespace {

Row describe(const rung_program& program, uint32_t rung) {
  const rung_info& info = program.rungs[rung];
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

// Tables for a terminal.

namespace {

constexpr const char* kOutside = "outside of the rungs: clock of timers, starts and ends of modules";

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char text[256];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

std::string moreText(size_t count, uint32_t limit) {
  return limit == 0 || count <= limit ? "" : "  ... and " + std::to_string(count - limit) + " more\n";
}

size_t shownOf(size_t count, uint32_t limit) { return limit == 0 ? count : std::min<size_t>(count, limit); }

std::string rungLine(const Row& row) {
  return format("%6" PRIu32 " %11" PRIu64 " %12" PRIu64 " %6.1f%% %8.1f %8.1f %8.1f %8.1f  ", row.number,
                row.executions, row.operations, row.share * 100, row.minNs, row.medianNs, row.meanNs, row.p99Ns) +
         row.file + ":" + std::to_string(row.line) + (row.title.empty() ? "" : "  " + row.title) + "\n";
}

// One line for all rungs added by the compiler: the times are not those of one rung.
std::string addedLine(const std::vector<Row>& added) {
  Row sum;
  for (const Row& row : added) {
    sum.executions += row.executions;
    sum.operations += row.operations;
    sum.share += row.share;
  }
  return format("     - %11" PRIu64 " %12" PRIu64 " %6.1f%% %8s %8s %8s %8s  ", sum.executions, sum.operations,
                sum.share * 100, "-", "-", "-", "-") +
         kOutside + "\n";
}

} // namespace

std::string placeText(const Row& row) {
  std::string text = row.number != 0 ? "rung " + std::to_string(row.number) : row.routine;
  if (!row.title.empty()) text += " \"" + row.title + "\"";
  return row.file.empty() ? text : text + ", " + row.file + ":" + std::to_string(row.line);
}

std::string rungTable(const ProfileReport& report, uint32_t limit) {
  std::string text = "  rung  executions   operations   share   min ns   median     mean      p99  place\n";
  const size_t shown = shownOf(report.rows.size(), limit);
  for (size_t i = 0; i < shown; ++i) text += rungLine(report.rows[i]);
  text += moreText(report.rows.size(), limit);
  return report.added.empty() ? text : text + addedLine(report.added);
}

std::string sumTable(const std::vector<Sum>& sums, const char* what, uint32_t limit) {
  std::string text = "   ran of    executions   operations   share      time us  ";
  text += std::string(what) + "\n";
  const size_t shown = shownOf(sums.size(), limit);
  for (size_t i = 0; i < shown; ++i) {
    const Sum& sum = sums[i];
    text += format("%6" PRIu32 " %-5" PRIu32 " %11" PRIu64 " %12" PRIu64 " %6.1f%% %12.1f  ", sum.ran, sum.rungs,
                   sum.executions, sum.operations, sum.share * 100, sum.time / 1000) +
            (sum.name.empty() ? kOutside : sum.name) + "\n";
  }
  return text + moreText(sums.size(), limit);
}

// Differences of counters.

namespace {

uint64_t roundedAbove0(double value) { return value <= 0 ? 0 : static_cast<uint64_t>(std::llround(value)); }

} // namespace

// What the counter has counted since the last call, without the cost of measuring; may be negative.
double ProfileCollector::take(size_t rung, const rung_prof& counter) noexcept {
  rung_prof& last = last_[rung];
  const uint64_t executions = counter.count - last.count;
  const double value = static_cast<double>(counter.total - last.total) - cost_ * static_cast<double>(executions);
  last = counter;
  rungs_[rung].executions += executions;
  rungs_[rung].total += value;
  return value;
}

void ProfileCollector::started(std::span<const rung_prof> counters) noexcept {
  std::fill(last_.begin(), last_.end(), rung_prof{});
  for (size_t i = 0; i < rungs_.size() && i < counters.size(); ++i) take(i, counters[i]);
}

void ProfileCollector::scanned(std::span<const rung_prof> counters) noexcept {
  ++scans_;
  scanTotal_ = 0;
  for (size_t i = 0; i < rungs_.size() && i < counters.size(); ++i) {
    scan_[i] = 0;
    if (counters[i].count == last_[i].count) continue;
    const double value = take(i, counters[i]);
    scan_[i] = roundedAbove0(value);
    scanTotal_ += scan_[i];
    ++rungs_[i].scans;
    rungs_[i].perScan.add(roundedAbove0(value + cost_));
  }
}

} // namespace rung::report
