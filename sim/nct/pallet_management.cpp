// Configuration and operation of the pallet management (see pallet_management.h).
#include "sim/nct/pallet_management.h"

#include <algorithm>
#include <cmath>

#include "rtlib/text/letters.h"

namespace rung::sim::nct {
namespace {

struct PalletName {
  PalletPlace place;
  std::string_view column;
};

// PALLET.MAGAZINE.PLACE.COLUMN
std::optional<PalletName> palletName(std::string_view name) {
  if (!name.starts_with("PALLET.")) return std::nullopt;
  name.remove_prefix(7);
  PalletName result;
  for (uint32_t* number : {&result.place.magazine, &result.place.place}) {
    const auto taken = takeNumberAndDot(name);
    if (!taken) return std::nullopt;
    *number = *taken;
  }
  result.column = name;
  return result;
}

// PROGRAM, PROGRAM1 … PROGRAM64: from 0; 64 when it is another name.
uint32_t programIndex(std::string_view name) {
  constexpr std::string_view kProgram = "PROGRAM";
  if (!text::takePrefixIgnoringCase(name, kProgram)) return kMaxPrograms;
  if (name.empty()) return 0;
  const uint32_t number = text::numberIn<uint32_t>(name).value_or(0);
  return number >= 1 && number <= kMaxPrograms ? number - 1 : kMaxPrograms;
}

} // namespace

PalletPlan PalletManagement::plan() const {
  const Parameters& parameters = *links().parameters;
  return {.enabled = parameters.bit(control3300_, 0),
          .loadingPoint = parameters.bit(control3300_, 1) || parameters.bit(control3300_, 2),
          .pool = static_cast<uint32_t>(std::max(parameters.dword(poolLength_), 0))};
}

bool PalletManagement::locked() const { return links().signals.get(lockedSignal_); }

bool PalletManagement::programsByNumber() const { return !links().parameters->bit(control3300_, 3); }

bool PalletManagement::hasColumn(int32_t number) const {
  const int32_t customs = std::clamp(links().parameters->dword(customColumns_), 0, 4);
  return number >= 1 && number <= static_cast<int32_t>(kPalletPrograms) + customs;
}

void PalletManagement::powerOn(nc::PowerOn kind) {
  editing_ = false;
  if (kind == nc::PowerOn::Warm) return;
  table_.clear();
  for (const Setting& setting : settings_) setQuantity(setting.name, setting.value);
}

void PalletManagement::cycle() { links().signals.set(editingSignal_, editing_); }

std::string PalletManagement::setColumn(PalletPlace place, std::string_view name, double value) {
  PalletRow& row = table_.row(place);
  const uint32_t program = programIndex(name);
  const PalletColumn column = palletColumn(name);
  if (isRealPalletColumn(column)) {
    row.customs[column - kPalletCustom1 - 1] = value;
    return {};
  }
  if (column == 0 && program == kMaxPrograms) return "no such column";
  constexpr double kMost[] = {kMaxPalletId, kMaxPalletId, 10, kMaxPriority, kMaxPrograms, kMaxPrograms, 0, 0xFF};
  if (value < 0 || value > kMost[column] || value != std::floor(value)) return "the column takes no such value";
  const auto word = static_cast<int32_t>(value);
  if (column == 0) {
    row.programs[program] = word;
    return {};
  }
  if (column == kPalletId && word != 0)
    if (const auto other = table_.find(plan(), word); other && *other != place) return "the pallet is in another place";
  row.words[column] = word;
  return {};
}

Handled PalletManagement::config(std::string_view key, std::string_view value) {
  if (!key.starts_with("pallet.")) return std::nullopt;
  const std::optional<double> number = text::realIn(value);
  if (!number) return "'" + std::string(value) + "' is not a number";
  std::string name = text::upper(key);
  const std::optional<PalletName> pallet = palletName(name);
  if (!pallet) return "a key of a pallet is pallet.MAGAZINE.PLACE.COLUMN";
  if (palletColumn(pallet->column) == 0 && programIndex(pallet->column) == kMaxPrograms) return "no such column";
  settings_.push_back({std::move(name), *number}); // the parameters may come later
  return std::string();
}

std::optional<double> PalletManagement::quantity(std::string_view name) const {
  const std::optional<PalletName> pallet = palletName(name);
  if (!pallet || !plan().has(pallet->place)) return std::nullopt;
  const PalletRow& row = table_.row(pallet->place);
  const PalletColumn column = palletColumn(pallet->column);
  if (isRealPalletColumn(column)) return row.customs[column - kPalletCustom1 - 1];
  if (column != 0) return row.word(column);
  const uint32_t program = programIndex(pallet->column);
  if (program == kMaxPrograms) return std::nullopt;
  return row.programs[program];
}

Handled PalletManagement::setQuantity(std::string_view name, double value) {
  const std::optional<PalletName> pallet = palletName(name);
  if (!pallet) return std::nullopt;
  if (!plan().has(pallet->place)) return "no such pallet place";
  return setColumn(pallet->place, pallet->column, value);
}

// ---- the operator ------------------------------------------------------------------------------------------------

// What the program has locked (P_PTTAB) the operator cannot change, nor the working space in automatic mode (l.5333).
Handled PalletManagement::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (const NcArgument* edit = findKey(keys, "edit")) {
    editing_ = edit->integer != 0;
    return unknownKey(name, keys, {"edit"});
  }
  const PalletPlace place{static_cast<uint32_t>(integerKey(keys, "magazine", kPoolMagazine)),
                          static_cast<uint32_t>(integerKey(keys, "place", 1))};
  for (const NcArgument& key : keys)
    if (key.key != "magazine" && key.key != "place" && palletColumn(key.key) == 0 &&
        programIndex(key.key) == kMaxPrograms)
      return "event pallet does not know '" + key.key + "'";
  if (!plan().has(place)) return "there is no such pallet place";
  bool automatic = false;
  for (uint32_t channel = 0; channel < nc::nct::kChannels; ++channel)
    automatic = automatic || links().signals.get(automatic_, channel);
  if (locked() || (automatic && place.magazine == kWorkingSpace)) return std::string();
  return editPlace(place, keys);
}

std::string PalletManagement::editPlace(PalletPlace place, const std::vector<NcArgument>& keys) {
  const NcArgument* identifier = findKey(keys, "id");
  if (identifier != nullptr && identifier->integer == 0) table_.row(place) = PalletRow(); // taken away
  if (identifier != nullptr && identifier->integer != 0) {
    const auto known = table_.find(plan(), static_cast<int32_t>(identifier->integer));
    if (known && *known != place && known->magazine != kVirtualMagazine) return "the pallet is in another place";
    if (identifier->integer < 1 || identifier->integer > kMaxPalletId) return "id: the column takes no such value";
    identify(place, static_cast<int32_t>(identifier->integer));
  }
  for (const NcArgument& key : keys) {
    if (key.key == "magazine" || key.key == "place" || key.key == "id") continue;
    const double value = key.isReal ? key.real : static_cast<double>(key.integer);
    if (std::string wrong = setColumn(place, key.key, value); !wrong.empty()) return key.key + ": " + wrong;
  }
  return {};
}

} // namespace rung::sim::nct
