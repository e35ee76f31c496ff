// Tables for a terminal (see profile.h).
#include <algorithm>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>

#include "tools/report/profile_rungs.h"

namespace rung::report {
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

// One line for all rungs of the compiler: their times are not those of one rung.
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

} // namespace rung::report
