// Configuration, operation and signals of the tool management.
#include "sim/nct/tool_management.h"

#include <algorithm>
#include <cmath>

#include "rtlib/nc/nct/service_functions.h"
#include "rtlib/text/letters.h"
#include "sim/nct/parameters.h"

namespace rung::sim::nct {

namespace {

// The default is the example of the manual (l.4449-4467): two chains.
constexpr uint32_t kFirstMagazinePots = 24;
constexpr uint32_t kSecondMagazinePots = 16;
constexpr uint32_t kMostPots = 999;
constexpr uint32_t kMostHalfPots = 40; // of a tool pattern, in one direction

uint32_t spindleOf(uint32_t cartridge) { return cartridge / 10 - 1; }

// NUMBER and REST of PREFIX.NUMBER.REST.
std::optional<std::pair<uint32_t, std::string_view>> numberAndRest(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return std::nullopt;
  name.remove_prefix(prefix.size());
  const auto number = takeNumberAndDot(name);
  return number ? std::optional(std::pair{*number, name}) : std::nullopt;
}

double valueOf(const NcArgument& key) { return key.isReal ? key.real : static_cast<double>(key.integer); }

} // namespace

ToolManagement::ToolManagement(Links& links) : Topic(links) {
  magazines_[0] = {.number = 1, .columns = kFirstMagazinePots};
  magazines_[1] = {.number = 2, .columns = kSecondMagazinePots};
  build();
}

void ToolManagement::build() {
  std::vector<CartridgeShape> shapes;
  for (const CartridgeShape& magazine : magazines_)
    if (magazine.number != 0) shapes.push_back(magazine);
  for (uint32_t spindle = 1; spindle <= nc::nct::kSpindles; ++spindle) {
    shapes.push_back({.number = spindle * 10});
    shapes.push_back({.number = spindle * 10 + 1});
  }
  tables_.tools.build(rows_);
  tables_.cartridges.build(shapes, rows_);
  finder_.reserve(tables_.cartridges);
}

void ToolManagement::powerOn(nc::PowerOn kind) {
  life_.clear();
  editing_ = searching_ = modified_ = saving_ = false;
  if (kind == nc::PowerOn::Warm) return;
  tables_.tools.build(rows_);
  tables_.cartridges.clear();
  tables_.patterns.clear();
  for (const Setting& setting : settings_) setQuantity(setting.name, setting.value);
}

void ToolManagement::retain(Retained& retained) {
  tables_.tools.retain(retained);
  tables_.cartridges.retain(retained);
  tables_.patterns.retain(retained);
}

bool ToolManagement::managed() const { return links().parameters->bit(toolConfig_, 0); }

bool ToolManagement::locked() const { return links().signals.get(signals_.locked); }

// N2922 says which cartridges of spindles exist: bit 0 that of the spindle, bit 1 the standby cartridge (l.10744).
bool ToolManagement::exists(uint32_t cartridge) const {
  if (tables_.cartridges.find(cartridge) == nullptr) return false;
  if (cartridge <= kMagazines) return true;
  const uint32_t spindle = spindleOf(cartridge);
  return links().parameters->bit(spindleMagazines_, 0, spindle) &&
         (cartridge % 10 == 0 || links().parameters->bit(spindleMagazines_, 1, spindle));
}

ToolPick ToolManagement::pick(int32_t type) {
  searching_ = true;
  return tables_.pick(type);
}

// ---- signals -----------------------------------------------------------------------------------------------------

void ToolManagement::cycle() {
  const SignalMemory& signals = links().signals;
  const bool operates = managed();
  for (uint32_t i = 0; i < nc::nct::kSpindles; ++i) {
    const uint32_t answers = signals.wordOf(signals_.individualDone, i);
    const ToolRequests& requests = life_.cycle(i,
                                               {.individualDone = signals_.individualDone.in(answers),
                                                .groupDone = signals_.groupDone.in(answers),
                                                .skip = signals_.skip.in(answers),
                                                .countDisabled = signals_.countDisabled.in(answers)},
                                               operates);
    signals.setBits(signals_.individual, i, signals_.requests,
                    signals_.individual.as(requests.individual) | signals_.group.as(requests.group) |
                        signals_.skipDone.as(requests.skipDone) | signals_.notice.as(requests.notice));
  }
  showBusy();
}

// Shows why the tables are occupied (l.8041-8049): search and modification for one PLC cycle, then saving.
void ToolManagement::showBusy() {
  const SignalMemory& signals = links().signals;
  signals.set(signals_.searching, searching_);
  signals.set(signals_.modified, modified_);
  signals.set(signals_.saving, saving_);
  signals.set(signals_.editing, editing_);
  saving_ = modified_;
  searching_ = modified_ = false;
}

// ---- configuration and quantities --------------------------------------------------------------------------------

std::string ToolManagement::configCartridge(uint32_t number, std::string_view value) {
  if (number < 1 || number > kMagazines) return "magazines are cartridge.1 to cartridge.4";
  CartridgeShape shape{.number = number};
  auto count = text::takeNumber<uint32_t>(value);
  if (count && value.starts_with('x')) {
    shape.matrix = true;
    shape.rows = *count;
    value.remove_prefix(1);
    count = text::takeNumber<uint32_t>(value);
  }
  auto firstPot = std::optional(shape.firstPot);
  if (count && value.starts_with('@')) {
    value.remove_prefix(1);
    firstPot = text::takeNumber<uint32_t>(value);
  }
  shape.columns = count.value_or(0);
  shape.firstPot = firstPot.value_or(0);
  if (!count || !firstPot || !value.empty()) return "a cartridge is POTS or ROWSxCOLUMNS, and @FIRSTPOT";
  if (shape.columns > kMostPots || shape.rows > kMostPots || shape.pots() > kMostPots || shape.firstPot > kMostPots)
    return "a cartridge has up to 999 pots";
  magazines_[number - 1] = shape.pots() == 0 ? CartridgeShape{} : shape;
  build();
  return {};
}

std::string ToolManagement::configTables(std::string_view key, double value) {
  if (key == "rows") {
    rows_ = static_cast<uint32_t>(value);
    build();
    return {};
  }
  if (key == "userdata") {
    limits_.userColumns = static_cast<uint32_t>(value);
    return {};
  }
  if (key == "compensations") {
    limits_.compensations = static_cast<uint32_t>(value);
    return {};
  }
  if (key == "increment") {
    if (!(value > 0)) return "tool.increment is above 0";
    increment_ = value;
    return {};
  }
  return "unknown key 'tool." + std::string(key) + "'";
}

Handled ToolManagement::config(std::string_view key, std::string_view value) {
  if (const auto number = numbersAfter(key, "cartridge."); number && number->size() == 1)
    return configCartridge(number->front(), value);
  if (key == "tool.count") {
    countsT_ = value == "T";
    return std::string();
  }
  if (!key.starts_with("tool.") && !key.starts_with("pot.") && !key.starts_with("pattern.")) return std::nullopt;
  const std::optional<double> number = text::realIn(value);
  if (!number) return "'" + std::string(value) + "' is not a number";
  std::string name = text::upper(key);
  if (Handled wrong = setQuantity(name, *number)) {
    if (wrong->empty()) settings_.push_back({std::move(name), *number});
    return wrong;
  }
  return configTables(key.substr(key.find('.') + 1), *number);
}

std::optional<double> ToolManagement::quantity(std::string_view name) const {
  if (const auto place = numbersAfter(name, "POT."); place && place->size() == 2) {
    const PotPlace pot{place->at(0), place->at(1)};
    if (!exists(pot.cartridge) || !tables_.cartridges.hasPot(pot)) return std::nullopt;
    return tables_.cartridges.dataNumber(pot);
  }
  if (const auto part = numberAndRest(name, "TOOL."); part && tables_.tools.has(part->first)) {
    const ToolColumn column = toolColumn(part->second);
    if (column == 0) return std::nullopt;
    const ToolRow& row = tables_.tools.row(part->first);
    return isRealColumn(column) ? row.real(column) : row.word(column);
  }
  if (const auto part = numberAndRest(name, "PATTERN."); part && PatternTable::has(part->first)) {
    const ToolPattern& pattern = tables_.patterns.row(part->first);
    if (part->second == "LEFT") return pattern.left;
    if (part->second == "RIGHT") return pattern.right;
    if (part->second == "UP") return pattern.up;
    if (part->second == "DOWN") return pattern.down;
    if (part->second == "ROUND") return pattern.round ? 1 : 0;
  }
  return std::nullopt;
}

std::string ToolManagement::setColumn(uint32_t dataNumber, ToolColumn column, double value) {
  ToolDatum datum;
  if (isRealColumn(column))
    datum.real = value;
  else if (value != std::floor(value) || value < 0 || value > INT32_MAX)
    return "the column takes whole numbers";
  else
    datum.word = static_cast<int32_t>(value);
  if (column > kToolFeed + limits_.userColumns) return "the table has no such column";
  if (!acceptable(column, datum, limits_)) return "the column takes no such value";
  tables_.tools.row(dataNumber).set(column, datum);
  return {};
}

Handled ToolManagement::setQuantity(std::string_view name, double value) {
  if (const auto place = numbersAfter(name, "POT."); place && place->size() == 2) {
    const PotPlace pot{place->at(0), place->at(1)};
    if (!tables_.cartridges.hasPot(pot)) return "no such pot";
    if (value != 0 && !tables_.tools.has(static_cast<int64_t>(value))) return "no such data number";
    if (value == 0)
      tables_.cartridges.take(tables_.cartridges.dataNumber(pot));
    else
      tables_.cartridges.put(pot, static_cast<uint32_t>(value));
    return std::string();
  }
  if (const auto part = numberAndRest(name, "TOOL.")) {
    const ToolColumn column = toolColumn(part->second);
    if (!tables_.tools.has(part->first)) return "no such data number";
    if (column == 0) return "no such column";
    const int32_t before = tables_.tools.row(part->first).status();
    std::string wrong = setColumn(part->first, column, value);
    life_.written(part->first, before);
    return wrong;
  }
  const auto part = numberAndRest(name, "PATTERN.");
  if (!part) return std::nullopt;
  if (!PatternTable::has(part->first) || value < 0 || value > kMostHalfPots)
    return "patterns are 1 to 20, of 0 to 40 half pots";
  ToolPattern pattern = tables_.patterns.row(part->first);
  const auto halves = static_cast<uint32_t>(value);
  if (part->second == "LEFT")
    pattern.left = halves;
  else if (part->second == "RIGHT")
    pattern.right = halves;
  else if (part->second == "UP")
    pattern.up = halves;
  else if (part->second == "DOWN")
    pattern.down = halves;
  else if (part->second == "ROUND")
    pattern.round = value != 0;
  else
    return "a pattern has LEFT, RIGHT, UP, DOWN, ROUND";
  tables_.patterns.set(part->first, pattern);
  return std::string();
}

// ---- the operator ------------------------------------------------------------------------------------------------

Handled ToolManagement::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (const NcArgument* edit = findKey(keys, "edit")) {
    editing_ = edit->integer != 0;
    return unknownKey(name, keys, {"edit"});
  }
  if (findKey(keys, "pattern") != nullptr) return editPattern(keys);
  return editTool(keys);
}

std::string ToolManagement::editPattern(const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey("tool", keys, {"pattern", "left", "right", "up", "down", "geometry"});
      !wrong.empty())
    return wrong;
  const int64_t figure = integerKey(keys, "pattern", 0);
  if (figure < 1 || !PatternTable::has(static_cast<uint32_t>(figure))) return "patterns are 1 to 20";
  for (const char* side : {"left", "right", "up", "down"})
    if (const int64_t halves = integerKey(keys, side, 0); halves < 0 || halves > kMostHalfPots)
      return "a side of a pattern has 0 to 40 half pots";
  const NcArgument* geometry = findKey(keys, "geometry");
  if (geometry != nullptr && geometry->text != "A" && geometry->text != "B") return "geometry is A or B";
  if (locked()) return {};
  const auto side = [&](const char* key) { return static_cast<uint32_t>(integerKey(keys, key, 0)); };
  tables_.patterns.set(static_cast<uint32_t>(figure), {.left = side("left"),
                                                       .right = side("right"),
                                                       .up = side("up"),
                                                       .down = side("down"),
                                                       .round = geometry != nullptr && geometry->text == "B"});
  modified_ = true;
  return {};
}

// The operator cannot change data locked by the program (P_TLTAB, l.8115) or by the row itself (D, l.4382).
std::string ToolManagement::editTool(const std::vector<NcArgument>& keys) {
  const NcArgument* data = findKey(keys, "data");
  if (data == nullptr) return "event tool needs data=NUMBER, pattern=NUMBER or edit=0|1";
  for (const NcArgument& key : keys)
    if (key.key != "data" && key.key != "cartridge" && key.key != "pot" && key.key != "delete" &&
        toolColumn(key.key) == 0)
      return "event tool does not know '" + key.key + "'";
  if (data->integer != 0 && !tables_.tools.has(data->integer)) return "the tool table has no such data number";
  if (locked()) return {};
  const auto row = static_cast<uint32_t>(data->integer);
  modified_ = true;
  if (integerKey(keys, "delete", 0) != 0) {
    if (!tables_.tools.row(row).info(kInfoDisabled)) tables_.remove(row);
    return {};
  }
  if (std::string wrong = editRow(row, keys); !wrong.empty()) return wrong;
  return placeTool(row, keys);
}

std::string ToolManagement::editRow(uint32_t dataNumber, const std::vector<NcArgument>& keys) {
  if (dataNumber == 0) return {};
  ToolRow& row = tables_.tools.row(dataNumber);
  if (row.info(kInfoDisabled) && findKey(keys, "info") == nullptr) return {};
  const int32_t before = row.status();
  bool any = false;
  for (const NcArgument& key : keys) {
    const ToolColumn column = toolColumn(key.key);
    if (column == 0) continue;
    any = true;
    if (std::string wrong = setColumn(dataNumber, column, valueOf(key)); !wrong.empty()) return key.key + ": " + wrong;
  }
  if (any && !row.valid() && findKey(keys, "info") == nullptr) row.setWord(kToolInfo, kInfoValid | kInfoSearchable);
  if (any && findKey(keys, "status") == nullptr) row.renewStatus();
  life_.written(dataNumber, before);
  return {};
}

std::string ToolManagement::placeTool(uint32_t dataNumber, const std::vector<NcArgument>& keys) {
  const NcArgument* cartridge = findKey(keys, "cartridge");
  if (cartridge == nullptr) return {};
  const PotPlace place{static_cast<uint32_t>(cartridge->integer), static_cast<uint32_t>(integerKey(keys, "pot", 1))};
  if (!exists(place.cartridge) || !tables_.cartridges.hasPot(place)) return "there is no such pot";
  if (dataNumber == 0)
    tables_.cartridges.take(tables_.cartridges.dataNumber(place));
  else
    tables_.cartridges.put(place, dataNumber);
  return {};
}

// The services of the tool management: MW 100 to MR 108 (man. 6.26.4-6.26.12, l.4613-5283).

namespace {

constexpr int32_t kNoCartridge = 100; // + 1: the pot; 102, 103: the second place
constexpr int32_t kNoSecondCartridge = 102;
constexpr int32_t kNoEmptyPot = 104;
constexpr int32_t kWrongColumn = 104; // + column
constexpr int32_t kTableFull = 138;
constexpr int32_t kNoTool = 139;
constexpr int32_t kWrongNumber = 140;
constexpr int32_t kNoMatch = 141;

constexpr uint32_t kFirstColumnWord = 4; // first column in a record: the type number, l.4736

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
  // The tables are occupied (l.8043-8049); with N1274 #0 MRW, MR 101, 104 and 107 still read (l.4674).
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
  // The amount need not be set (l.4680), it is 7 in the answer (l.4700), any other amount is an error (l.4711).
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
  // A row marked as invalid would not be a tool.
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

// An unknown column is a separate error, which is checked after others (l.5217).
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
    return nc::nct::kWriteProtected; // only the info can remove the lock
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
    if (!place) continue; // not in the machine: there is no pot for the answer
    block.setWord(2, static_cast<int32_t>(place->cartridge));
    block.setWord(3, static_cast<int32_t>(place->pot));
    return nc::nct::kExecuted;
  }
  return kNoMatch;
}

} // namespace rung::sim::nct
