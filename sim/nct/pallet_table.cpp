// The pallet management table (see pallet_table.h).
#include "sim/nct/pallet_table.h"

#include <algorithm>
#include <span>
#include <utility>

#include "rtlib/text/letters.h"

namespace rung::sim::nct {

PalletColumn palletColumn(std::string_view name) {
  constexpr std::pair<std::string_view, PalletColumn> kNames[] = {{"ID", kPalletId},
                                                                  {"STATUS", kPalletStatus},
                                                                  {"PRIORITY", kPalletPriority},
                                                                  {"EXECUTED", kPalletExecuted},
                                                                  {"ASSIGNED", kPalletAssigned},
                                                                  {"CUSTOM1", kPalletCustom1},
                                                                  {"CUSTOM2", 8},
                                                                  {"CUSTOM3", 9},
                                                                  {"CUSTOM4", 10}};
  for (const auto& [known, column] : kNames)
    if (text::equalsIgnoringCase(name, known)) return column;
  return 0;
}

uint32_t PalletPlan::places(uint32_t magazine) const {
  if (!enabled) return 0;
  const uint32_t physical = std::min(pool, kPalletRows - 2) + 1 + (loadingPoint ? 1 : 0);
  switch (magazine) {
  case kVirtualMagazine: return kPalletRows - physical;
  case kPoolMagazine: return std::min(pool, kPalletRows - 2);
  case kWorkingSpace: return 1;
  case kLoadingPoint: return loadingPoint ? 1 : 0;
  default: return 0;
  }
}

uint32_t PalletTable::index(PalletPlace place) const {
  switch (place.magazine) {
  case kWorkingSpace: return 0;
  case kLoadingPoint: return 1;
  case kPoolMagazine: return kFirstPool + place.place - 1;
  default: return kFirstVirtual + place.place - 1;
  }
}

PalletRow& PalletTable::row(PalletPlace place) { return rows_[index(place)]; }
const PalletRow& PalletTable::row(PalletPlace place) const { return rows_[index(place)]; }

std::optional<PalletPlace> PalletTable::find(const PalletPlan& plan, int32_t identifier) const {
  for (const uint32_t magazine : {kWorkingSpace, kLoadingPoint, kPoolMagazine, kVirtualMagazine})
    for (uint32_t place = 1; place <= plan.places(magazine); ++place)
      if (row({magazine, place}).word(kPalletId) == identifier) return PalletPlace{magazine, place};
  return std::nullopt;
}

std::optional<PalletPlace> PalletTable::freeVirtual(const PalletPlan& plan) const {
  for (uint32_t place = 1; place <= plan.places(kVirtualMagazine); ++place)
    if (!row({kVirtualMagazine, place}).hasPallet()) return PalletPlace{kVirtualMagazine, place};
  return std::nullopt;
}

void PalletTable::clear() { rows_.fill(PalletRow()); }

void PalletTable::keep(Kept& kept) { kept.values(std::span<PalletRow>(rows_)); }

} // namespace rung::sim::nct
