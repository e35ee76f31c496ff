// Configuration and operation of the pallet management.
#include "sim/nct/pallets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "rtlib/nc/nct/service_functions.h"
#include "rtlib/text/letters.h"
#include "sim/nct/channels.h"
#include "sim/nct/tool_table.h"

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

// The index, from 0, of PROGRAM, PROGRAM1 … PROGRAM64; 64 for any other name.
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
  settings_.push_back({std::move(name), *number}); // the parameters may be set later
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

// The operator cannot change data that the program has locked (P_PTTAB), nor the working space in automatic mode
// (l.5333).
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
  if (identifier != nullptr && identifier->integer == 0) table_.row(place) = PalletRow(); // removes the pallet
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

// The services of the pallet management: MW 300 to MR 309 and MW 41 (man. 6.27.2-6.27.9, l.5432-5932).

namespace {

constexpr int32_t kWrongNumber = 12;
constexpr int32_t kNoChannel = 41;
constexpr int32_t kNoFile = 45;
constexpr int32_t kProgramRuns = 46;
constexpr int32_t kNoProgram = 47;
constexpr int32_t kNoMagazine = 300;
constexpr int32_t kNoPlace = 301;
constexpr int32_t kNoSecondMagazine = 302;
constexpr int32_t kWrongId = 305;
constexpr int32_t kWrongStatus = 306;
constexpr int32_t kWrongPriority = 307;
constexpr int32_t kWrongExecuted = 308;
constexpr int32_t kWrongAssigned = 309;
constexpr int32_t kNoPallet = 339;
constexpr int32_t kNotFound = 341;
constexpr int32_t kWorkingSpaceEmpty = 342;

constexpr uint32_t kFirstColumnWord = 4; // first column in a record: the identifier, l.5506
// The columns of a record in order, without the programs (l.5523).
constexpr std::array<PalletColumn, 9> kRecord = {
    kPalletId, kPalletStatus, kPalletPriority, kPalletExecuted, kPalletAssigned, kPalletCustom1, 8, 9, 10};

PalletPlace placeAt(const Block& block, uint32_t word) {
  return {static_cast<uint32_t>(block.word(word)), static_cast<uint32_t>(block.word(word + 1))};
}

void readInto(const Block& block, uint32_t word, PalletColumn column, PalletRow& row) {
  if (isRealPalletColumn(column))
    row.customs[column - kPalletCustom1 - 1] = block.real(word);
  else
    row.words[column] = column == kPalletCustom1 ? block.word(word) & 0xFF : block.word(word);
}

void answer(Block& block, uint32_t word, PalletColumn column, const PalletRow& row) {
  if (isRealPalletColumn(column))
    block.setReal(word, row.customs[column - kPalletCustom1 - 1]);
  else
    block.setWord(word, column == kPalletPrograms ? row.programs[0] : row.words[column]);
}

// Whether the datum needs a pallet: without one, only status and identifier can be read and written.
bool needsPallet(int32_t number) {
  return number != static_cast<int32_t>(kPalletId) && number != static_cast<int32_t>(kPalletStatus);
}

} // namespace

bool PalletManagement::serves(bool write, uint32_t function) const {
  switch (function) {
  case 41:
  case 300:
  case 303:
  case 306: return write;
  case 304:
  case 307:
  case 308:
  case 309: return !write;
  default: return false;
  }
}

std::optional<int32_t> PalletManagement::service(uint32_t function, Block& block) {
  if (editing_) return std::nullopt;
  switch (function) {
  case 41: return selectProgram(block);
  case 300: return interchange(block);
  case 303: return writePallet(block);
  case 304: return readPallet(block);
  case 306: return writeDatum(block);
  case 307: return readDatum(block);
  case 308: return search(block);
  case 309: return readColumn(block);
  default: return nc::nct::kBadFunction;
  }
}

int32_t PalletManagement::checkPlace(PalletPlace place) const {
  const PalletPlan machine = plan();
  if (!machine.hasMagazine(place.magazine)) return kNoMagazine;
  return machine.has(place) ? static_cast<int32_t>(nc::nct::kExecuted) : kNoPlace;
}

// Magazine 1: 1, 10 or 11; magazine 2: 0, 10 or 11 (l.5445-5447).
int32_t PalletManagement::interchange(Block& block) {
  if (block.amount() != 3) return nc::nct::kBadAmount;
  if (locked()) return nc::nct::kWriteProtected;
  const PalletPlace first = placeAt(block, 2);
  const auto second = static_cast<uint32_t>(block.word(4));
  if (first.magazine == kVirtualMagazine) return kNoMagazine;
  if (const int32_t code = checkPlace(first); code != nc::nct::kExecuted) return code;
  if (second == kPoolMagazine || second == first.magazine || !plan().hasMagazine(second)) return kNoSecondMagazine;
  PalletPlace other{second, 1};
  if (second == kVirtualMagazine) {
    if (!table_.row(first).hasPallet()) return nc::nct::kExecuted;
    const std::optional<PalletPlace> free = table_.freeVirtual(plan());
    if (!free) return nc::nct::kWriteProtected; // no row left: the manual has no code for it
    other = *free;
  }
  std::swap(table_.row(first), table_.row(other));
  return nc::nct::kExecuted;
}

uint32_t PalletManagement::columnsOfRecord(int64_t words) const {
  int64_t end = 0;
  for (uint32_t i = 0; i < kRecord.size() && hasColumn(static_cast<int32_t>(kRecord[i])); ++i) {
    end += palletColumnWords(kRecord[i]);
    if (end == words) return i + 1;
  }
  return 0;
}

// Limits as printed (l.5553-5557, l.5698-5702). The highest status differs: 9 for MW 303, 10 for MW 306.
int32_t PalletManagement::checkWord(PalletColumn column, int32_t value, PalletPlace place) const {
  switch (column) {
  case kPalletId: {
    if (value < 1 || value > kMaxPalletId) return kWrongId;
    const std::optional<PalletPlace> other = table_.find(plan(), value);
    const bool taken = other && *other != place && other->magazine != kVirtualMagazine;
    return taken ? kWrongId : static_cast<int32_t>(nc::nct::kExecuted); // a pallet can be in one place only
  }
  case kPalletPriority:
    return value < 0 || value > kMaxPriority ? kWrongPriority : static_cast<int32_t>(nc::nct::kExecuted);
  case kPalletAssigned:
    return value < 0 || value > static_cast<int32_t>(kMaxPrograms) ? kWrongAssigned
                                                                   : static_cast<int32_t>(nc::nct::kExecuted);
  default: return nc::nct::kExecuted;
  }
}

void PalletManagement::identify(PalletPlace place, int32_t identifier) {
  const std::optional<PalletPlace> known = table_.find(plan(), identifier);
  if (known && *known != place) std::swap(table_.row(place), table_.row(*known));
  table_.row(place).words[kPalletId] = identifier;
}

int32_t PalletManagement::writePallet(Block& block) {
  const uint32_t columns = columnsOfRecord(int64_t{block.amount()} - 2);
  if (columns == 0) return nc::nct::kBadAmount;
  if (locked()) return nc::nct::kWriteProtected;
  const PalletPlace place = placeAt(block, 2);
  if (const int32_t code = checkPlace(place); code != nc::nct::kExecuted) return code;
  if (!table_.row(place).hasPallet()) return kNoPallet;
  const int32_t identifier = block.word(kFirstColumnWord);
  if (const int32_t code = checkWord(kPalletId, identifier, place); code != nc::nct::kExecuted) return code;
  // The new contents of the place: the pallet's data in the virtual magazine, overwritten by those of the block.
  const std::optional<PalletPlace> known = table_.find(plan(), identifier);
  PalletRow row = table_.row(known ? *known : place);
  uint32_t word = kFirstColumnWord;
  for (uint32_t i = 0; i < columns; word += palletColumnWords(kRecord[i]), ++i) readInto(block, word, kRecord[i], row);
  if (columns >= 2 && static_cast<uint32_t>(row.word(kPalletStatus)) > 9) return kWrongStatus;
  if (const int32_t code = checkWord(kPalletPriority, row.word(kPalletPriority), place); code != nc::nct::kExecuted)
    return code;
  if (static_cast<uint32_t>(row.word(kPalletExecuted)) > static_cast<uint32_t>(row.word(kPalletAssigned)))
    return kWrongExecuted;
  if (const int32_t code = checkWord(kPalletAssigned, row.word(kPalletAssigned), place); code != nc::nct::kExecuted)
    return code;
  identify(place, identifier);
  table_.row(place) = row;
  return nc::nct::kExecuted;
}

int32_t PalletManagement::readPallet(Block& block) {
  const uint32_t columns = columnsOfRecord(int64_t{block.amount()} - 2);
  if (columns == 0) return nc::nct::kBadAmount;
  const PalletPlace place = placeAt(block, 2);
  if (const int32_t code = checkPlace(place); code != nc::nct::kExecuted) return code;
  if (!table_.row(place).hasPallet()) return kNoPallet;
  uint32_t word = kFirstColumnWord;
  for (uint32_t i = 0; i < columns; word += palletColumnWords(kRecord[i]), ++i)
    answer(block, word, kRecord[i], table_.row(place));
  return nc::nct::kExecuted;
}

// Several programs need the number of programs, one does not (l.5661): the amount is 3 plus that number.
int32_t PalletManagement::writePrograms(Block& block, PalletRow& row) {
  const int32_t programs = std::max(row.word(kPalletAssigned), 1);
  if (block.amount() != 3 + programs) return nc::nct::kBadAmount;
  row.programs.fill(0); // the previous ones are overwritten (l.5659)
  row.words[kPalletAssigned] = programs;
  for (int32_t i = 0; i < programs; ++i)
    row.programs[static_cast<uint32_t>(i)] = block.word(5 + static_cast<uint32_t>(i));
  return nc::nct::kExecuted;
}

int32_t PalletManagement::writeDatum(Block& block) {
  const int32_t number = block.word(4);
  const auto column = static_cast<PalletColumn>(number);
  if (block.amount() < 4 || !hasColumn(number)) return nc::nct::kBadAmount; // the manual has no code for a wrong number
  if (column != kPalletPrograms && block.amount() != static_cast<int32_t>(3 + palletColumnWords(column)))
    return nc::nct::kBadAmount;
  if (locked()) return nc::nct::kWriteProtected;
  const PalletPlace place = placeAt(block, 2);
  if (const int32_t code = checkPlace(place); code != nc::nct::kExecuted) return code;
  PalletRow& row = table_.row(place);
  if (needsPallet(number) && !row.hasPallet()) return kNoPallet;
  if (column == kPalletPrograms) {
    if (!programsByNumber()) return nc::nct::kWriteProtected; // l.5414-5416
    return writePrograms(block, row);
  }
  const int32_t value = block.word(5);
  if (const int32_t code = checkWord(column, value, place); code != nc::nct::kExecuted) return code;
  if (column == kPalletStatus && static_cast<uint32_t>(value) > 10) return kWrongStatus;
  if (column == kPalletExecuted && static_cast<uint32_t>(value) > static_cast<uint32_t>(row.word(kPalletAssigned)))
    return kWrongExecuted;
  if (column == kPalletAssigned && row.word(kPalletExecuted) > value) return kWrongExecuted;
  if (column == kPalletId)
    identify(place, value);
  else
    readInto(block, 5, column, row);
  return nc::nct::kExecuted;
}

int32_t PalletManagement::readDatum(Block& block) {
  const int32_t number = block.word(4);
  const auto column = static_cast<PalletColumn>(number);
  if (block.amount() < 4 || !hasColumn(number)) return nc::nct::kBadAmount;
  if (column != kPalletPrograms && block.amount() != static_cast<int32_t>(3 + palletColumnWords(column)))
    return nc::nct::kBadAmount;
  const PalletPlace place = placeAt(block, 2);
  if (const int32_t code = checkPlace(place); code != nc::nct::kExecuted) return code;
  const PalletRow& row = table_.row(place);
  if (number != static_cast<int32_t>(kPalletStatus) && !row.hasPallet()) return kNoPallet;
  if (column != kPalletPrograms) {
    answer(block, 5, column, row);
    return nc::nct::kExecuted;
  }
  if (!programsByNumber()) return nc::nct::kWriteProtected;
  const int32_t programs = std::max(row.word(kPalletAssigned), 1);
  if (block.amount() != 3 + programs) return nc::nct::kBadAmount;
  for (int32_t i = 0; i < programs; ++i)
    block.setWord(5 + static_cast<uint32_t>(i), row.programs[static_cast<uint32_t>(i)]);
  return nc::nct::kExecuted;
}

bool PalletManagement::matches(PalletColumn column, int32_t value, const PalletRow& row) const {
  if (column != kPalletPrograms) return row.word(column) == value;
  const auto* end = row.programs.begin() + row.word(kPalletAssigned);
  return std::find(row.programs.begin(), end, value) != end;
}

// Statuses are searched in all places of the pool, other data only in places with a pallet. Of several pallets that are
// ready for exchange the one with the lowest priority number is found, else the nearest (l.5775-5781).
int32_t PalletManagement::search(Block& block) {
  if (block.amount() != 6) return nc::nct::kBadAmount;
  const int32_t number = block.word(2);
  const auto column = static_cast<PalletColumn>(number);
  if (!hasColumn(number) || isRealPalletColumn(column) || (column == kPalletPrograms && !programsByNumber()))
    return kWrongNumber;
  const uint32_t places = plan().places(kPoolMagazine);
  const auto start = static_cast<uint32_t>(block.word(4));
  if (start < 1 || start > places) return kNoPlace;
  block.setWord(6, 0);
  block.setWord(7, 0);
  const auto rowAt = [&](uint32_t index) -> const PalletRow& { return table_.row({kPoolMagazine, index + 1}); };
  const bool status = column == kPalletStatus;
  const auto fits = [&](uint32_t index) {
    return (status || rowAt(index).hasPallet()) && matches(column, block.word(3), rowAt(index));
  };
  bool any = status;
  int32_t best = INT32_MAX;
  for (uint32_t i = 0; i < places; ++i) {
    any = any || rowAt(i).hasPallet();
    if (fits(i)) best = std::min(best, rowAt(i).word(kPalletPriority));
  }
  if (!any) return kNoPallet;
  const bool byPriority = status && block.word(3) == kPalletReady;
  const auto found = nearestPlace(start - 1, places, searchDirection(block.word(5)), [&](uint32_t index) {
    return fits(index) && (!byPriority || rowAt(index).word(kPalletPriority) == best);
  });
  if (!found) return kNotFound;
  block.setWord(6, static_cast<int32_t>(found->first + 1));
  block.setWord(7, rotationWord(found->second));
  return nc::nct::kExecuted;
}

// The amount includes data number, magazine and place: the example with 10 has seven values (l.5852-5866).
int32_t PalletManagement::readColumn(Block& block) {
  const int32_t number = block.word(2);
  const auto column = static_cast<PalletColumn>(number);
  if (block.amount() < 4) return nc::nct::kBadAmount;
  if (!hasColumn(number) || (column == kPalletPrograms && !programsByNumber())) return kWrongNumber;
  const uint32_t width = palletColumnWords(column);
  const auto words = static_cast<uint32_t>(block.amount() - 3);
  if (words % width != 0 || words > nc::nct::kBlockWords - 5) return nc::nct::kBadAmount;
  PalletPlace place = placeAt(block, 3);
  if (const int32_t code = checkPlace(place); code != nc::nct::kExecuted) return code;
  const uint32_t places = plan().places(place.magazine);
  for (uint32_t word = 5; word < 5 + words; word += width) {
    answer(block, word, column, table_.row(place));
    place.place = place.place % places + 1;
  }
  return nc::nct::kExecuted;
}

int32_t PalletManagement::selectProgram(Block& block) {
  if (block.amount() != 2) return nc::nct::kBadAmount;
  const int32_t channel = block.word(3);
  if (channel < 1 || channel > static_cast<int32_t>(nc::nct::kChannels)) return kNoChannel;
  Channels& channels = *links().channels;
  const auto index = static_cast<uint32_t>(channel - 1);
  if (channels.busy(index)) return kProgramRuns; // l.5892
  if (!plan().enabled) return kWorkingSpaceEmpty;
  const PalletRow& row = table_.row({kWorkingSpace, 1});
  // The identifier must be that of the pallet in the working space (l.5894).
  if (!row.hasPallet() || row.word(kPalletId) != block.word(2)) return kWorkingSpaceEmpty;
  const auto next = static_cast<uint32_t>(row.word(kPalletExecuted));
  if (next >= static_cast<uint32_t>(row.word(kPalletAssigned))) return kNoProgram;
  if (!channels.hasProgram(row.programs[next])) return kNoFile;
  channels.select(index, row.programs[next]);
  return nc::nct::kExecuted;
}

// The pallet management table.

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

void PalletTable::retain(Retained& retained) { retained.values(std::span<PalletRow>(rows_)); }

} // namespace rung::sim::nct
