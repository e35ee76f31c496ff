// The services of the pallet management: MW 300 to MR 309 and MW 41 (man. 6.27.2-6.27.9, l.5432-5932).
#include <algorithm>
#include <array>
#include <utility>

#include "rtlib/nc/nct/service_functions.h"
#include "sim/nct/channels.h"
#include "sim/nct/pallet_management.h"
#include "sim/nct/ring_search.h"

namespace rung::sim::nct {
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

constexpr uint32_t kFirstColumnWord = 4; // of a record: the identifier, l.5506
// The order of the columns in a record: without the programs (l.5523).
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

// The status of a place without a pallet can be read and written, its pallet be named.
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
    return taken ? kWrongId : static_cast<int32_t>(nc::nct::kExecuted); // a pallet is in one place
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
  // What the place will hold: the data that the virtual magazine has of the pallet, then those of the block.
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

// One program needs no number of programs, several do (l.5661): the amount is 3 and that number.
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
  if (block.amount() < 4 || !hasColumn(number)) return nc::nct::kBadAmount; // no code is printed for a wrong number
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

// Statuses are searched in all places of the pool, other data in those with a pallet. Of several pallets that are ready
// for exchange the one with the lowest priority number is taken, else the nearest (l.5775-5781).
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

// The amount counts the data number, magazine and place too: the example with 10 has seven values (l.5852-5866).
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
  // Always the identifier of the pallet in the working space (l.5894): another one is not there.
  if (!row.hasPallet() || row.word(kPalletId) != block.word(2)) return kWorkingSpaceEmpty;
  const auto next = static_cast<uint32_t>(row.word(kPalletExecuted));
  if (next >= static_cast<uint32_t>(row.word(kPalletAssigned))) return kNoProgram;
  if (!channels.hasProgram(row.programs[next])) return kNoFile;
  channels.select(index, row.programs[next]);
  return nc::nct::kExecuted;
}

} // namespace rung::sim::nct
