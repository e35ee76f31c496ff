// The tool management table (man. 6.26.1, l.4315-4442) and its columns, numbered as in the services (l.5100). A row is
// a tool if its info has V; all others are free. Times are in seconds.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/nct/retained.h"

namespace rung::sim::nct {

// Columns are data numbers of MW 106 and MR 107; the execution code for a wrong value is 104 + column.
using ToolColumn = uint32_t;
inline constexpr ToolColumn kToolType = 1;
inline constexpr ToolColumn kToolInfo = 2;
inline constexpr ToolColumn kToolFigure = 3;
inline constexpr ToolColumn kToolStatus = 4;
inline constexpr ToolColumn kToolCounter = 5;
inline constexpr ToolColumn kToolLife = 6;
inline constexpr ToolColumn kToolNotice = 7;
inline constexpr ToolColumn kToolH = 8;
inline constexpr ToolColumn kToolD = 9;
inline constexpr ToolColumn kToolG = 10;
inline constexpr ToolColumn kToolW = 11;
inline constexpr ToolColumn kToolSpeed = 12;
inline constexpr ToolColumn kToolFeed = 13;  // double
inline constexpr ToolColumn kToolUser1 = 14; // 8 bits; columns from 15 on are doubles
inline constexpr ToolColumn kToolColumns = 33;
inline constexpr uint32_t kToolUserColumns = 20;

constexpr bool isRealColumn(ToolColumn column) { return column == kToolFeed || column > kToolUser1; }
constexpr uint32_t columnWords(ToolColumn column) { return isRealColumn(column) ? 2 : 1; }
// NUMBER or the name used by events and quantities; 0: no such column.
ToolColumn toolColumn(std::string_view name);

// Bits of the tool info (l.4342-4368).
inline constexpr uint32_t kInfoValid = 1 << 0;
inline constexpr uint32_t kInfoTime = 1 << 1;
inline constexpr uint32_t kInfoLarge = 1 << 2;
inline constexpr uint32_t kInfoDisabled = 1 << 3;
inline constexpr uint32_t kInfoSearchable = 1 << 4;
inline constexpr uint32_t kInfoBits = 0x1F;

// Life status (l.4385-4403).
inline constexpr int32_t kLifeNotPerformed = 0;
inline constexpr int32_t kLifeNotUsed = 1;
inline constexpr int32_t kLifeUsed = 2;
inline constexpr int32_t kLifeExpired = 3;
inline constexpr int32_t kLifeBroken = 4;

struct ToolDatum {
  int32_t word = 0; // value of an integer column
  double real = 0;
};

class ToolRow {
public:
  int32_t word(ToolColumn column) const { return words_[column]; }
  double real(ToolColumn column) const { return reals_[column]; }
  ToolDatum datum(ToolColumn column) const {
    return isRealColumn(column) ? ToolDatum{0, reals_[column]} : ToolDatum{words_[column], 0};
  }
  void set(ToolColumn column, const ToolDatum& datum) {
    (isRealColumn(column) ? reals_[column] = datum.real : words_[column] = datum.word);
  }
  void setWord(ToolColumn column, int32_t value) { words_[column] = value; }

  bool info(uint32_t bit) const { return (static_cast<uint32_t>(words_[kToolInfo]) & bit) != 0; }
  bool valid() const { return info(kInfoValid); }
  int32_t status() const { return words_[kToolStatus]; }
  // Whether the T code of a program may select this tool (l.4362-4403).
  bool searchable() const;
  // Whether the tool is in life management and has a finite life.
  bool hasLife() const { return status() >= kLifeNotUsed && status() <= kLifeExpired && words_[kToolLife] != 0; }
  // Computes the status of a tool in life management from its counter and life.
  void renewStatus();

  template <class Archive>
  void state(Archive& archive) {
    archive(words_, reals_);
  }

private:
  std::array<int32_t, kToolUser1 + 1> words_{};
  std::array<double, kToolColumns + 1> reals_{};
};

// Limits for values in the machine's tables.
struct ToolLimits {
  uint32_t userColumns = kToolUserColumns;
  uint32_t compensations = 200; // rows of the compensation table
};

// Returns false for execution code 104 + column.
bool acceptable(ToolColumn column, const ToolDatum& datum, const ToolLimits& limits);

// The columns that a record of `words` words (from the type number on) contains; nullopt: not a whole number of
// columns, none, or too many (l.4808).
std::optional<ToolColumn> columnsOfRecord(int64_t words, uint32_t userColumns);

class ToolTable {
public:
  void build(uint32_t rows) { rows_.assign(rows + size_t{1}, {}); }

  uint32_t size() const { return static_cast<uint32_t>(rows_.size() - 1); }
  bool has(int64_t dataNumber) const { return dataNumber >= 1 && dataNumber <= size(); }
  ToolRow& row(uint32_t dataNumber) { return rows_[dataNumber]; }
  const ToolRow& row(uint32_t dataNumber) const { return rows_[dataNumber]; }
  void clear(uint32_t dataNumber) { rows_[dataNumber] = {}; }
  uint32_t firstFree() const; // 0: none
  void retain(Retained& retained) { retained.values(std::span(rows_)); }
  template <class Archive>
  void state(Archive& archive) {
    archive.each(rows_);
  }

private:
  std::vector<ToolRow> rows_ = std::vector<ToolRow>(1); // row 0 is not used
};

// The cartridge management table (man. 6.26.2, l.4443-4497): the data number of the tool in each pot. Cartridges 1-4
// are magazines, 10 * s is spindle s and 10 * s + 1 its standby cartridge; both have one pot.
//
// Invariant: a data number is in at most one pot.

inline constexpr uint32_t kMagazines = 4;

// A chain-type cartridge is a ring with one row; the pots of a matrix are counted row by row.
struct CartridgeShape {
  uint32_t number = 0;
  uint32_t firstPot = 1;
  uint32_t columns = 1;
  uint32_t rows = 1;
  bool matrix = false;

  uint32_t pots() const { return columns * rows; }
  bool magazine() const { return number <= kMagazines; }
};

struct PotPlace {
  uint32_t cartridge = 0;
  uint32_t pot = 0;
  bool operator==(const PotPlace&) const = default;
};

class CartridgeTable {
public:
  // All pots are empty at first. `shapes` are in the order of the table's rows, each number once; data numbers are 1 to
  // `dataNumbers`. The other functions do not allocate.
  void build(std::span<const CartridgeShape> shapes, uint32_t dataNumbers);
  void clear();

  uint32_t size() const { return static_cast<uint32_t>(pots_.size()); } // number of rows: serial numbers 1 to size
  PotPlace place(uint32_t serial) const;

  const CartridgeShape* find(uint32_t cartridge) const;
  bool hasPot(PotPlace place) const { return index(place).has_value(); }

  // 0: no tool, or no such pot.
  uint32_t dataNumber(PotPlace place) const;
  // If another pot has the data number, it is removed there.
  void put(PotPlace place, uint32_t dataNumber);
  void exchange(PotPlace first, PotPlace second);
  std::optional<PotPlace> placeOf(uint32_t dataNumber) const;
  void take(uint32_t dataNumber); // removes it from its pot
  void retain(Retained& retained);

  template <class Archive>
  void state(Archive& archive) {
    archive.each(pots_);
    archive.each(serial_);
    if constexpr (Archive::kLoads) {
      for (const uint32_t dataNumber : pots_) archive.require(dataNumber < serial_.size());
      for (const uint32_t serial : serial_) archive.require(serial <= pots_.size());
      if (!archive.good()) clear();
    }
  }

private:
  struct Cartridge {
    CartridgeShape shape;
    uint32_t first = 0; // index of its first pot in pots_
  };
  std::optional<uint32_t> index(PotPlace place) const;
  void write(uint32_t index, uint32_t dataNumber);

  std::vector<Cartridge> cartridges_;
  std::vector<uint32_t> pots_;   // data numbers
  std::vector<uint32_t> serial_; // by data number: row of its pot, from 1; 0: in no pot
};

// The order in which pots and pallet places are searched: a ring of numbers, in one direction or both (MR 101, man.
// l.4690; MR 308, man. l.5779).

enum class SearchDirection : uint8_t { Both, Positive, Negative };

constexpr SearchDirection searchDirection(int32_t word) {
  return word == 1 ? SearchDirection::Positive : word == 2 ? SearchDirection::Negative : SearchDirection::Both;
}
// The word for a magazine's direction of rotation: 1 or 2.
constexpr int32_t rotationWord(SearchDirection direction) { return direction == SearchDirection::Negative ? 2 : 1; }

// The nearest of `count` places (a ring, from 0) to `start` for which `fits` is true, beginning with `start`; of two at
// the same distance, the one in positive direction. The result includes the direction of rotation: Positive or
// Negative.
template <class Fits>
std::optional<std::pair<uint32_t, SearchDirection>> nearestPlace(uint32_t start, uint32_t count,
                                                                 SearchDirection direction, Fits fits) {
  for (uint32_t step = 0; step < count; ++step) {
    const uint32_t up = (start + step) % count;
    const uint32_t down = (start + count - step) % count;
    if (direction != SearchDirection::Negative && fits(up)) return std::pair{up, SearchDirection::Positive};
    if (direction != SearchDirection::Positive && fits(down)) return std::pair{down, SearchDirection::Negative};
  }
  return std::nullopt;
}

// The tool pattern table (man. 6.26.3, l.4498-4612): the space that oversize tools need around their pot, by figure, in
// half pots. Figure 0 and rows that were never written need one pot.

struct ToolPattern {
  uint32_t left = 0; // towards lower pot numbers
  uint32_t right = 0;
  uint32_t up = 0; // towards lower rows; matrix-type cartridges only
  uint32_t down = 0;
  bool round = false; // geometry B: the corners stay empty

  template <class Archive>
  void state(Archive& archive) {
    archive(left, right, up, down, round);
  }
};

class PatternTable {
public:
  static constexpr uint32_t kRows = 20; // l.4543

  static bool has(uint32_t figure) { return figure >= 1 && figure <= kRows; }
  const ToolPattern& row(uint32_t figure) const { return rows_[figure <= kRows ? figure : 0]; }
  void set(uint32_t figure, const ToolPattern& pattern) {
    if (has(figure)) rows_[figure] = pattern;
  }
  void clear() { rows_.fill({}); }
  void retain(Retained& retained) { retained.value(rows_); }
  template <class Archive>
  void state(Archive& archive) {
    archive(rows_);
  }

private:
  std::array<ToolPattern, kRows + 1> rows_{};
};

// The three tables of tool management (man. 6.26.1-6.26.3), common to all channels.
//
// Invariant: a data number in a pot is a row of the tool table.

// The tool that the NC selects for a T code (l.4362-4372, 10742-10772).
struct ToolPick {
  bool expired = false;    // CN_TLLE: all tools of the type are expired or broken (l.9733)
  uint32_t dataNumber = 0; // 0: no searchable tool is in a pot
  PotPlace place;          // its pot, otherwise 0, 0
};

struct ToolTables {
  ToolTable tools;
  CartridgeTable cartridges;
  PatternTable patterns;

  // The pattern of a tool; normal tools, figure 0 and no tool need one pot (l.4374-4380).
  const ToolPattern& patternOf(uint32_t dataNumber) const;

  // Of the searchable tools with this type number in a pot, the one with the greatest life counter; if equal, the
  // lowest data number.
  ToolPick pick(int32_t type) const;
  // Whether no tool with this type number is searchable, and at least one is expired or broken.
  bool groupExpired(int32_t type) const;

  // Frees the row and its pot.
  void remove(uint32_t dataNumber);

  template <class Archive>
  void state(Archive& archive) {
    archive(tools, cartridges, patterns);
  }
};

// Search for an empty pot for a tool (man. 6.26.3 and 6.26.5, l.4498-4718). Space is counted in cells of half a pot: a
// chain-type cartridge is a ring of cells, a matrix a field with two cells per pot in both directions. A tool fits if
// none of its cells belongs to another tool; a remaining half pot cannot receive a tool, but can serve as the half that
// a neighbour needs.

struct PotSearch {
  uint32_t cartridge = 0;
  uint32_t start = 0; // a pot of the cartridge
  SearchDirection direction = SearchDirection::Both;
  uint32_t tool = 0; // data number of the tool to be placed, whose own cells count as free; 0: needs one pot
};

struct PotFound {
  uint32_t pot = 0;
  SearchDirection rotation = SearchDirection::Positive; // of the magazine, never Both
};

class PotFinder {
public:
  // Allocates for the largest magazine of the table; `find` does not allocate.
  void reserve(const CartridgeTable& table);
  // Finds the nearest empty pot in the direction, beginning with the start; of two at the same distance, the one in
  // positive direction. Pot numbers wrap around. Only magazines are searched (l.4672).
  std::optional<PotFound> find(const ToolTables& tables, const PotSearch& search);

private:
  void markTools(const ToolTables& tables, const CartridgeShape& shape, uint32_t moving);

  std::vector<uint8_t> taken_; // cells
};

} // namespace rung::sim::nct
