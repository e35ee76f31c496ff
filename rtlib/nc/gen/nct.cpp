// nct: the manual gives no addresses (l.6448). From word 0002 on: all `in` words and doubles in table order, the
// containers of `in` bits that have no name of their own, then the same for `out`. A symbol with multiplicity m has m
// words (doubles: 2m); a bit lies in its container's words.
#include "rtlib/nc/gen/gen.h"

#include <unordered_map>

namespace rung::nc::gen {

namespace {

constexpr uint32_t kFirstWord = 2;

class NctLayout {
public:
  explicit NctLayout(const Table& table) : table_(table) {
    for (size_t i = 0; i < table_.rowCount(); ++i) readRow(i);
  }

  std::vector<Row> run() {
    for (const Direction direction : {Direction::In, Direction::Out}) {
      placeWords(direction);
      placeContainers(direction);
    }
    for (size_t i = 0; i < rows_.size(); ++i) placeBit(i);
    return std::move(rows_);
  }

private:
  void readRow(size_t i) {
    Row row = commonColumns(table_, i);
    row.address = table_.at(i, "address");
    row.group = table_.at(i, "group");
    row.area = "M";
    row.strideBytes = row.type == SignalType::Real ? 8 : 4;
    const std::string& index = table_.at(i, "index");
    if (const size_t colon = index.find(':'); colon != std::string::npos) {
      size_t pos = colon + 1;
      if (!readNumber(index, pos, row.count) || row.count == 0) table_.fail(i, "multiplicity is not UNIT:NUMBER");
    } else if (index != "none") {
      table_.fail(i, "index is neither none nor UNIT:NUMBER");
    }
    rows_.push_back(std::move(row));
  }

  void placeWords(Direction direction) {
    for (Row& row : rows_) {
      if (row.type == SignalType::Bit || row.direction != direction) continue;
      wordOf_[row.symbol] = word_;
      row.byteOffset = 4 * word_;
      word_ += row.count * row.strideBytes / 4;
    }
  }

  void placeContainers(Direction direction) {
    for (const Row& row : rows_) {
      const std::string container = containerOf(row);
      if (row.direction != direction || !container.starts_with('(') || wordOf_.contains(container)) continue;
      wordOf_[container] = word_;
      word_ += row.count;
    }
  }

  void placeBit(size_t i) {
    Row& row = rows_[i];
    if (row.type != SignalType::Bit) return;
    const std::string container = containerOf(row);
    const auto place = wordOf_.find(container);
    size_t pos = container.size() + 1;
    if (place == wordOf_.end() || !readNumber(row.address, pos, row.bit) || row.bit > 31)
      table_.fail(i, "address is not WORD.BIT of a known word");
    row.inferred = row.address.ends_with('?');
    row.byteOffset = 4 * place->second;
  }

  static std::string containerOf(const Row& row) {
    return row.type == SignalType::Bit ? row.address.substr(0, row.address.find('.')) : std::string();
  }

  const Table& table_;
  std::vector<Row> rows_;
  std::unordered_map<std::string, uint32_t> wordOf_;
  uint32_t word_ = kFirstWord;
};

} // namespace

std::vector<Row> layoutNct(const Table& table) { return NctLayout(table).run(); }

} // namespace rung::nc::gen
