// Tables of the simulated CNC (see tables.h).
#include "sim/gsk/tables.h"

namespace rung::sim::gsk {
namespace {

// Of a machine nobody has set up. An axis parameter that has no value of its own takes that of the first axis.
int64_t defaultOf(uint32_t parameter) {
  switch (parameter) {
  case kParamDryRun: return 3000;
  case kParamRapid: return 12000;
  case kParamRapidF0: return 600;
  case kParamReturn: return 6000;
  case kParamSafeFeed: return 3000;
  case kParamGearSpeed: return 50;
  case kParamMaxSpindle: return 6000;
  case kParamPlcMaxSpeed: return 12000;
  default: return 0;
  }
}

} // namespace

int64_t Tables::get(Table table, uint32_t number, uint32_t attribute) const {
  const auto found = cells_.find({table, number, attribute});
  if (found != cells_.end()) return found->second;
  if (table == Table::Parameter && attribute != 0 && number != kParamPlcGroup) return get(table, number);
  return table == Table::Parameter ? defaultOf(number) * kTableScale : 0;
}

void Tables::set(Table table, uint32_t number, uint32_t attribute, int64_t value) {
  cells_.insert_or_assign(Key{table, number, attribute}, value);
}

double Tables::parameterReal(uint32_t number, uint32_t axis) const {
  return static_cast<double>(get(Table::Parameter, number, axis)) / static_cast<double>(kTableScale);
}

int64_t Tables::parameter(uint32_t number, uint32_t axis) const {
  return static_cast<int64_t>(parameterReal(number, axis));
}

void Tables::clearVolatile() {
  cells_.erase(cells_.lower_bound({Table::Macro, 100, 0}), cells_.lower_bound({Table::Macro, 200, 0}));
}

} // namespace rung::sim::gsk
