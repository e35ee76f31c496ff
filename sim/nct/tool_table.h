// The tool management table (man. 6.26.1, l.4315-4442) and the columns of its rows as the services number them
// (l.5100). A row is a tool if its info says so (V); all others are free. Time is counted in seconds.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/nct/kept.h"

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
inline constexpr ToolColumn kToolUser1 = 14; // 8 bits; from 15 on double
inline constexpr ToolColumn kToolColumns = 33;
inline constexpr uint32_t kToolUserColumns = 20;

constexpr bool isRealColumn(ToolColumn column) { return column == kToolFeed || column > kToolUser1; }
constexpr uint32_t columnWords(ToolColumn column) { return isRealColumn(column) ? 2 : 1; }
// NUMBER or the name that events and quantities use; 0: none such.
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
  int32_t word = 0; // of an integer column
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
  // The T code of a program may get this tool (l.4362-4403).
  bool searchable() const;
  // In life management, with a life that can be reached.
  bool hasLife() const { return status() >= kLifeNotUsed && status() <= kLifeExpired && words_[kToolLife] != 0; }
  // Status of a tool in life management from its counter and life.
  void renewStatus();

private:
  std::array<int32_t, kToolUser1 + 1> words_{};
  std::array<double, kToolColumns + 1> reals_{};
};

// What values the machine's tables allow.
struct ToolLimits {
  uint32_t userColumns = kToolUserColumns;
  uint32_t compensations = 200; // rows of the compensation table
};

// False: execution code 104 + column.
bool acceptable(ToolColumn column, const ToolDatum& datum, const ToolLimits& limits);

// The columns that a record of so many words (from the type number on) fills; nullopt: no whole number of columns,
// none, or more than there are (l.4808).
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
  void keep(Kept& kept) { kept.values(std::span(rows_)); }

private:
  std::vector<ToolRow> rows_ = std::vector<ToolRow>(1); // row 0 is nobody's
};

} // namespace rung::sim::nct
