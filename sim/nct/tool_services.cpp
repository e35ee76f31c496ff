// The services of the tool management: MW 100 to MR 108 (man. 6.26.4-6.26.12, l.4613-5283).
#include <cmath>

#include "rtlib/nc/nct/service_functions.h"
#include "sim/nct/parameters.h"
#include "sim/nct/tool_management.h"

namespace rung::sim::nct {
namespace {

constexpr int32_t kNoCartridge = 100; // then the pot; 102, 103 of the second place
constexpr int32_t kNoSecondCartridge = 102;
constexpr int32_t kNoEmptyPot = 104;
constexpr int32_t kWrongColumn = 104; // + column
constexpr int32_t kTableFull = 138;
constexpr int32_t kNoTool = 139;
constexpr int32_t kWrongNumber = 140;
constexpr int32_t kNoMatch = 141;

constexpr uint32_t kFirstColumnWord = 4; // of a record: the type number, l.4736

PotPlace placeAt(const Block& block, uint32_t word) {
  return {static_cast<uint32_t>(block.word(word)), static_cast<uint32_t>(block.word(word + 1))};
}

ToolDatum datumAt(const Block& block, uint32_t word, ToolColumn column) {
  if (isRealColumn(column)) return {0, block.real(word)};
  return {block.word(word), 0};
}

void putDatum(Block& block, uint32_t word, ToolColumn column, const ToolDatum& datum) {
  if (isRealColumn(column))
    block.setReal(word, datum.real);
  else
    block.setWord(word, datum.word);
}

bool isColumn(int32_t number, uint32_t userColumns) {
  return number >= 1 && number <= static_cast<int32_t>(kToolFeed + userColumns);
}

} // namespace

bool ToolManagement::serves(bool write, uint32_t function) const {
  switch (function) {
  case 100:
  case 102:
  case 103:
  case 105:
  case 106: return write;
  case 101:
  case 104:
  case 107:
  case 108: return !write;
  default: return false;
  }
}

std::optional<int32_t> ToolManagement::service(uint32_t function, Block& block) {
  // The tables are occupied (l.8043-8049). N1274 #0 MRW lets MR 101, 104 and 107 read all the same (l.4674).
  const bool searchesByPot = function == 101 || function == 104 || function == 107;
  if (editing_ && !(searchesByPot && links().parameters->bit(programConfig_, 0))) return std::nullopt;
  switch (function) {
  case 100: return exchange(block);
  case 101: return searchPot(block);
  case 102: return registerTool(block);
  case 103: return writeTool(block);
  case 104: return readTool(block);
  case 105: return deleteTool(block);
  case 106: return writeDatum(block);
  case 107: return readDatum(block);
  case 108: return searchUser(block);
  default: return nc::nct::kBadFunction;
  }
}

int32_t ToolManagement::checkPlace(PotPlace place, int32_t firstCode) const {
  if (!exists(place.cartridge)) return firstCode;
  return tables_.cartridges.hasPot(place) ? nc::nct::kExecuted : firstCode + 1;
}

int32_t ToolManagement::findTool(const Block& block, uint32_t& tool) const {
  const PotPlace place = placeAt(block, 2);
  if (const int32_t code = checkPlace(place, kNoCartridge); code != nc::nct::kExecuted) return code;
  tool = tables_.cartridges.dataNumber(place);
  return tool == 0 ? kNoTool : nc::nct::kExecuted;
}

int32_t ToolManagement::exchange(Block& block) {
  if (block.amount() != 4) return nc::nct::kBadAmount;
  if (locked()) return nc::nct::kWriteProtected;
  if (const int32_t code = checkPlace(placeAt(block, 2), kNoCartridge); code != nc::nct::kExecuted) return code;
  if (const int32_t code = checkPlace(placeAt(block, 4), kNoSecondCartridge); code != nc::nct::kExecuted) return code;
  tables_.cartridges.exchange(placeAt(block, 2), placeAt(block, 4));
  modified_ = true;
  return nc::nct::kExecuted;
}

int32_t ToolManagement::searchPot(Block& block) {
  // The amount need not be set (l.4680), the answer says 7 (l.4700), another one is an error (l.4711).
  if (block.amount() != 7 && block.amount() != 0) return nc::nct::kBadAmount;
  block.setWord(nc::nct::kAmountWord, 7);
  const PotPlace target = placeAt(block, 2);
  const PotPlace source = placeAt(block, 5);
  if (const int32_t code = checkPlace(target, kNoCartridge); code != nc::nct::kExecuted) return code;
  if (const int32_t code = checkPlace(source, kNoSecondCartridge); code != nc::nct::kExecuted) return code;
  searching_ = true;
  const auto found = finder_.find(tables_, {.cartridge = target.cartridge,
                                            .start = target.pot,
                                            .direction = searchDirection(block.word(4)),
                                            .tool = tables_.cartridges.dataNumber(source)});
  block.setWord(7, found ? static_cast<int32_t>(found->pot) : 0);
  block.setWord(8, found ? rotationWord(found->rotation) : 0);
  return found ? nc::nct::kExecuted : kNoEmptyPot;
}

int32_t ToolManagement::checkRecord(const Block& block, ToolColumn columns) const {
  uint32_t word = kFirstColumnWord;
  for (ToolColumn column = kToolType; column <= columns; word += columnWords(column), ++column)
    if (!acceptable(column, datumAt(block, word, column), limits_)) return kWrongColumn + static_cast<int32_t>(column);
  return nc::nct::kExecuted;
}

void ToolManagement::writeRecord(const Block& block, ToolColumn columns, uint32_t dataNumber) {
  ToolRow& row = tables_.tools.row(dataNumber);
  const int32_t before = row.status();
  uint32_t word = kFirstColumnWord;
  for (ToolColumn column = kToolType; column <= columns; word += columnWords(column), ++column)
    row.set(column, datumAt(block, word, column));
  life_.written(dataNumber, before);
  modified_ = true;
}

int32_t ToolManagement::registerTool(Block& block) {
  const auto columns = columnsOfRecord(int64_t{block.amount()} - 2, limits_.userColumns);
  if (!columns) return nc::nct::kBadAmount;
  if (locked()) return nc::nct::kWriteProtected;
  const PotPlace place = placeAt(block, 2);
  if (const int32_t code = checkPlace(place, kNoCartridge); code != nc::nct::kExecuted) return code;
  if (const int32_t code = checkRecord(block, *columns); code != nc::nct::kExecuted) return code;
  // A row that is registered as invalid would not be a tool.
  if (*columns >= kToolInfo && (static_cast<uint32_t>(block.word(5)) & kInfoValid) == 0)
    return kWrongColumn + static_cast<int32_t>(kToolInfo);
  const uint32_t row = tables_.tools.firstFree();
  if (row == 0) return kTableFull;
  tables_.remove(row); // an invalid row may still be in a pot
  tables_.tools.row(row).setWord(kToolInfo, kInfoValid | kInfoSearchable);
  tables_.cartridges.put(place, row);
  writeRecord(block, *columns, row);
  return nc::nct::kExecuted;
}

int32_t ToolManagement::writeTool(Block& block) {
  const auto columns = columnsOfRecord(int64_t{block.amount()} - 2, limits_.userColumns);
  if (!columns) return nc::nct::kBadAmount;
  if (locked()) return nc::nct::kWriteProtected;
  uint32_t tool = 0;
  if (const int32_t code = findTool(block, tool); code != nc::nct::kExecuted) return code;
  if (tables_.tools.row(tool).info(kInfoDisabled)) return nc::nct::kWriteProtected;
  if (const int32_t code = checkRecord(block, *columns); code != nc::nct::kExecuted) return code;
  writeRecord(block, *columns, tool);
  return nc::nct::kExecuted;
}

int32_t ToolManagement::readTool(Block& block) {
  const auto columns = columnsOfRecord(int64_t{block.amount()} - 2, limits_.userColumns);
  if (!columns) return nc::nct::kBadAmount;
  uint32_t tool = 0;
  if (const int32_t code = findTool(block, tool); code != nc::nct::kExecuted) return code;
  uint32_t word = kFirstColumnWord;
  for (ToolColumn column = kToolType; column <= *columns; word += columnWords(column), ++column)
    putDatum(block, word, column, tables_.tools.row(tool).datum(column));
  return nc::nct::kExecuted;
}

int32_t ToolManagement::deleteTool(Block& block) {
  if (block.amount() != 2) return nc::nct::kBadAmount;
  if (locked()) return nc::nct::kWriteProtected;
  uint32_t tool = 0;
  if (const int32_t code = findTool(block, tool); code != nc::nct::kExecuted) return code;
  if (tables_.tools.row(tool).info(kInfoDisabled)) return nc::nct::kWriteProtected;
  tables_.remove(tool);
  modified_ = true;
  return nc::nct::kExecuted;
}

// A column that does not exist is an error of its own, which comes after others (l.5217).
bool ToolManagement::hasDatumAmount(const Block& block) const {
  if (block.amount() != 4 && block.amount() != 5) return false;
  const int32_t number = block.word(4);
  return !isColumn(number, limits_.userColumns) ||
         block.amount() == static_cast<int32_t>(3 + columnWords(static_cast<ToolColumn>(number)));
}

int32_t ToolManagement::writeDatum(Block& block) {
  if (!hasDatumAmount(block)) return nc::nct::kBadAmount;
  const int32_t number = block.word(4);
  const auto column = static_cast<ToolColumn>(number);
  if (locked()) return nc::nct::kWriteProtected;
  uint32_t tool = 0;
  if (const int32_t code = findTool(block, tool); code != nc::nct::kExecuted) return code;
  if (!isColumn(number, limits_.userColumns)) return kWrongNumber;
  ToolRow& row = tables_.tools.row(tool);
  if (row.info(kInfoDisabled) && column != kToolInfo)
    return nc::nct::kWriteProtected; // the info takes the lock away again
  const ToolDatum datum = datumAt(block, 5, column);
  if (!acceptable(column, datum, limits_)) return kWrongColumn + number;
  const int32_t before = row.status();
  row.set(column, datum);
  if (column == kToolCounter || column == kToolLife) row.renewStatus();
  life_.written(tool, before);
  modified_ = true;
  return nc::nct::kExecuted;
}

int32_t ToolManagement::readDatum(Block& block) {
  if (!hasDatumAmount(block)) return nc::nct::kBadAmount;
  const int32_t number = block.word(4);
  const auto column = static_cast<ToolColumn>(number);
  uint32_t tool = 0;
  if (const int32_t code = findTool(block, tool); code != nc::nct::kExecuted) return code;
  if (!isColumn(number, limits_.userColumns)) return kWrongNumber;
  putDatum(block, 5, column, tables_.tools.row(tool).datum(column));
  return nc::nct::kExecuted;
}

bool ToolManagement::sameDatum(ToolColumn column, const ToolRow& row, const Block& block) const {
  if (!isRealColumn(column)) return row.word(column) == block.word(5);
  return std::abs(row.real(column) - block.real(5)) < increment_; // l.5247
}

int32_t ToolManagement::searchUser(Block& block) {
  if (block.amount() != 4 && block.amount() != 5) return nc::nct::kBadAmount;
  const int32_t number = block.word(4);
  const auto column = static_cast<ToolColumn>(number);
  if (!isColumn(number, limits_.userColumns) || column < kToolUser1) return kWrongNumber;
  if (block.amount() != static_cast<int32_t>(3 + columnWords(column))) return nc::nct::kBadAmount;
  searching_ = true;
  for (uint32_t tool = 1; tool <= tables_.tools.size(); ++tool) {
    const ToolRow& row = tables_.tools.row(tool);
    if (!row.valid() || !sameDatum(column, row, block)) continue;
    const std::optional<PotPlace> place = tables_.cartridges.placeOf(tool);
    if (!place) continue; // not in the machine: there is no pot to answer with
    block.setWord(2, static_cast<int32_t>(place->cartridge));
    block.setWord(3, static_cast<int32_t>(place->pot));
    return nc::nct::kExecuted;
  }
  return kNoMatch;
}

} // namespace rung::sim::nct
