// The tool management table (see tool_table.h).
#include "sim/nct/tool_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::sim::nct {
namespace {

constexpr std::string_view kNames[] = {"TYPE", "INFO", "FIGURE", "STATUS", "COUNTER", "LIFE", "NOTICE",
                                       "H",    "D",    "G",      "W",      "S",       "F"};
constexpr int32_t kMaxType = 99'999'999; // 8 digits, l.4338

} // namespace

ToolColumn toolColumn(std::string_view name) {
  const std::string wanted = text::upper(name);
  const auto found = std::ranges::find(kNames, std::string_view(wanted));
  if (found != std::end(kNames)) return static_cast<ToolColumn>(found - std::begin(kNames)) + 1;
  if (!wanted.starts_with("USER")) return 0;
  const std::optional<uint32_t> user = text::numberIn<uint32_t>(std::string_view(wanted).substr(4));
  return user && *user >= 1 && *user <= kToolUserColumns ? kToolUser1 + *user - 1 : 0;
}

bool ToolRow::searchable() const {
  if (!valid() || words_[kToolType] == 0) return false;
  switch (status()) {
  case kLifeNotPerformed: return info(kInfoSearchable);
  case kLifeNotUsed:
  case kLifeUsed: return true;
  default: return false;
  }
}

void ToolRow::renewStatus() {
  if (!hasLife()) return;
  const int32_t counter = words_[kToolCounter];
  words_[kToolStatus] = counter >= words_[kToolLife] ? kLifeExpired : counter == 0 ? kLifeNotUsed : kLifeUsed;
}

bool acceptable(ToolColumn column, const ToolDatum& datum, const ToolLimits& limits) {
  const int32_t word = datum.word;
  if (column == kToolFeed) return std::isfinite(datum.real) && datum.real >= 0;
  if (isRealColumn(column)) return std::isfinite(datum.real);
  if (word < 0) return false;
  switch (column) {
  case kToolType: return word >= 1 && word <= kMaxType;
  case kToolInfo: return static_cast<uint32_t>(word) <= kInfoBits;
  case kToolFigure: return word <= 20;
  case kToolStatus: return word <= kLifeBroken;
  case kToolH:
  case kToolD:
  case kToolG:
  case kToolW: return static_cast<uint32_t>(word) <= limits.compensations;
  case kToolUser1: return word <= 0xFF;
  default: return true;
  }
}

std::optional<ToolColumn> columnsOfRecord(int64_t words, uint32_t userColumns) {
  int64_t end = 0;
  for (ToolColumn column = kToolType; column <= kToolFeed + userColumns; ++column) {
    end += columnWords(column);
    if (end == words) return column;
  }
  return std::nullopt;
}

uint32_t ToolTable::firstFree() const {
  for (uint32_t i = 1; i <= size(); ++i)
    if (!rows_[i].valid()) return i;
  return 0;
}

} // namespace rung::sim::nct
