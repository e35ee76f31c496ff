// technol: the manual gives no addresses. Every area (see technol/signals.h) is packed in table order: bits of a group
// eight to a byte, all else byte after byte without padding, as DFM and DS do (man. l.105).
#include "rtlib/nc/gen/gen.h"

#include <unordered_map>

namespace rung::nc::gen {

namespace {

bool isWeight(const std::string& index) {
  return index.starts_with("bit ") || index.starts_with("byte ") || index.starts_with("in ");
}

/// "RTM.Servo[x].Edrv" -> "RTM.Servo.Edrv"
std::string withoutIndex(std::string name) {
  if (const size_t open = name.find('['); open != std::string::npos) name.erase(open, name.find(']') - open + 1);
  return name;
}

std::string areaOf(const Row& row) {
  constexpr std::string_view kElement = " element"; // "SHARE PRXWR element"
  const std::string owner = row.symbol.substr(0, row.symbol.find('.'));
  const bool member = owner.size() < row.symbol.size();
  if (row.group.starts_with("RTM.")) return withoutIndex(row.group);
  if (row.group.starts_with("8.3 BLK[n]")) return "BLK";
  if (row.group.ends_with(kElement)) return "SHARE." + row.group.substr(6, row.group.size() - 6 - kElement.size());
  if (row.group.ends_with("(RtmVar)")) return "RtmVar"; // some of its names are under SHARE too
  if (row.group.starts_with("SHARE")) return member && owner.starts_with("Ecat") ? "SHARE." + owner : "SHARE";
  if (isWeight(row.address)) return "W";
  return member ? owner : "I";
}

class TechnolLayout {
public:
  explicit TechnolLayout(const Table& table) : table_(table) {
    for (size_t i = 0; i < table_.rowCount(); ++i) readRow(i);
  }

  std::vector<Row> run() {
    for (size_t i = 0; i < rows_.size(); ++i) areaSize(i, rows_[i].area);
    for (size_t i = 0; i < rows_.size(); ++i)
      if (isInCell(i)) placeInCell(i);
    return std::move(rows_);
  }

private:
  struct Area {
    std::vector<size_t> rows;
    uint32_t size = 0; // bytes so far
    uint32_t freeBits = 0;
    std::string bitGroup; // group whose bits share the last byte
    Direction bitDirection = Direction::In;
    enum { Waiting, Running, Done } state = Waiting;
  };

  [[nodiscard]] bool isInCell(size_t i) const {
    return rows_[i].type == SignalType::Bit && !table_.at(i, "layout").empty();
  }

  void readRow(size_t i) {
    Row row = commonColumns(table_, i);
    row.address = table_.at(i, "index");
    row.group = table_.at(i, "group");
    if (row.type == SignalType::Struct) row.structure = table_.at(i, "layout");
    // The manual does not print these lengths.
    row.inferred = row.type == SignalType::String || row.symbol.find("pINOUT_") != std::string::npos;
    readIndex(i, row);
    row.area = areaOf(row);
    rows_.push_back(std::move(row));
    if (!isInCell(i)) areas_[rows_[i].area].rows.push_back(i);
    if (rows_[i].area == "I") cells_.emplace(rows_[i].symbol, i);
  }

  void readIndex(size_t i, Row& row);
  void readWeight(size_t i, Row& row);
  uint32_t areaSize(size_t user, const std::string& name);
  void append(Area& area, size_t i);
  static void appendBits(Area& area, Row& row);
  void placeInCell(size_t i);

  const Table& table_;
  std::vector<Row> rows_;
  std::unordered_map<std::string, Area> areas_;
  std::unordered_map<std::string, size_t> cells_;
};

/// Reads the index: bounds "0..15", weights, or the name of a family member ("axis 3"), which needs no place.
void TechnolLayout::readIndex(size_t i, Row& row) {
  const std::string& index = row.address;
  size_t pos = 0;
  uint32_t low = 0, high = 0;
  if (isWeight(index)) {
    readWeight(i, row);
  } else if (readNumber(index, pos, low) && index.compare(pos, 2, "..") == 0) {
    pos += 2;
    if (low != 0 || !readNumber(index, pos, high)) table_.fail(i, "bounds are not 0..NUMBER");
    row.count = high + 1;
  } else if (index == "n" || index == "by slave" || index == "weight not printed") {
    row.inferred = true;
  }
}

/// "bit 3", "bit 0 of byte +1", "byte 2 bit 1" (bytes from 1), "in CELL" (numbers not printed: in table order).
void TechnolLayout::readWeight(size_t i, Row& row) {
  const std::string& index = row.address;
  const size_t bit = index.find("bit "), byte = index.find("byte ");
  size_t pos = bit + 4;
  if (bit == std::string::npos) {
    row.inferred = true;
    row.bit = i > 0 && rows_[i - 1].address == index ? rows_[i - 1].bit + 1 : 0;
  } else if (!readNumber(index, pos, row.bit)) {
    table_.fail(i, "no bit number in the index");
  }
  if (byte != std::string::npos) {
    const bool offset = index.compare(byte + 5, 1, "+") == 0;
    pos = byte + (offset ? 6 : 5);
    if (!readNumber(index, pos, row.byteOffset) || (!offset && row.byteOffset == 0))
      table_.fail(i, "no byte number in the index");
    if (!offset) --row.byteOffset;
  }
  if (row.bit > 7) table_.fail(i, "bit is not 0..7");
}

/// Lays the area out at its first use; structures are areas too and may hold others.
uint32_t TechnolLayout::areaSize(size_t user, const std::string& name) {
  const auto found = areas_.find(name);
  if (found == areas_.end()) table_.fail(user, "unknown structure '" + name + "'");
  Area& area = found->second;
  if (area.state == Area::Running) table_.fail(user, "structure '" + name + "' contains itself");
  if (area.state == Area::Waiting) {
    area.state = Area::Running;
    for (const size_t i : area.rows)
      if (name != "W") append(area, i);
    area.state = Area::Done;
  }
  return area.size;
}

void TechnolLayout::append(Area& area, size_t i) {
  Row& row = rows_[i];
  if (row.type == SignalType::Bit) return appendBits(area, row);
  row.strideBytes = row.type == SignalType::Struct ? areaSize(i, row.structure) : elementBytes(row.type);
  row.byteOffset = area.size;
  area.size += row.count * row.strideBytes;
  area.freeBits = 0;
}

void TechnolLayout::appendBits(Area& area, Row& row) {
  // All bits of a byte have one direction, so that the host can copy whole bytes.
  if (area.bitGroup != row.group || area.bitDirection != row.direction) area.freeBits = 0;
  area.bitGroup = row.group;
  area.bitDirection = row.direction;
  row.byteOffset = area.freeBits == 0 ? area.size : area.size - 1;
  row.bit = (8 - area.freeBits) % 8;
  const uint32_t end = row.bit + row.count;
  area.size = row.byteOffset + (end + 7) / 8;
  area.freeBits = (8 - end % 8) % 8;
}

/// Column layout of a bit: "CELL.BIT", or "CELL.BIT?" where only the cell is printed.
void TechnolLayout::placeInCell(size_t i) {
  Row& row = rows_[i];
  const std::string& layout = table_.at(i, "layout");
  const auto cell = cells_.find(layout.substr(0, layout.find('.')));
  size_t pos = layout.find('.') + 1;
  if (cell == cells_.end() || !readNumber(layout, pos, row.bit) || row.bit > 7)
    table_.fail(i, "layout is not CELL.BIT of a known cell");
  row.area = rows_[cell->second].area;
  row.byteOffset = rows_[cell->second].byteOffset;
  row.inferred = layout.ends_with('?');
}

} // namespace

std::vector<Row> layoutTechnol(const Table& table) { return TechnolLayout(table).run(); }

} // namespace rung::nc::gen
