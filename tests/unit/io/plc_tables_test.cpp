// What a program asks of PLC tables (man. ch. 17.4).
#include "machine/io/tables/plc_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/unit/io/materials.h"

namespace rung::io {
namespace {

using enum TableError;
constexpr uint32_t kFeed = 0, kCount = 1, kName = 2, kKey = 3;

class PlcTablesTest : public testing::Test {
protected:
  void SetUp() override { test::loadMaterials(tables_); }

  int32_t intAt(uint32_t line) const {
    int32_t value = 0;
    EXPECT_EQ(tables_.getInt(0, line, kCount, value), None);
    return value;
  }
  double realAt(uint32_t line) const {
    double value = 0;
    EXPECT_EQ(tables_.getReal(0, line, kFeed, value), None);
    return value;
  }
  std::string_view textAt(uint32_t line) const {
    std::string_view text;
    EXPECT_EQ(tables_.getText(0, line, kName, text), None);
    return text;
  }
  std::vector<uint8_t> bytesAt(uint32_t line) const {
    std::span<const uint8_t> bytes;
    EXPECT_EQ(tables_.getBinary(0, line, kKey, bytes), None);
    return {bytes.begin(), bytes.end()};
  }

  PlcTables tables_;
};

TEST_F(PlcTablesTest, Elements) {
  EXPECT_EQ(realAt(0), 2000.0);
  EXPECT_EQ(intAt(0), -7);
  EXPECT_EQ(textAt(0), "m\xEC\xEF"); // Windows-1250
  EXPECT_EQ(bytesAt(0), (std::vector<uint8_t>{1, 2, 255}));
  EXPECT_EQ(realAt(2), 100.2);
  EXPECT_EQ(intAt(2), 16);
}

TEST_F(PlcTablesTest, ElementsThatALineDoesNotMention) {
  EXPECT_EQ(realAt(1), 0.0);
  EXPECT_EQ(intAt(1), 0);
  EXPECT_EQ(textAt(1), "");
  EXPECT_TRUE(bytesAt(2).empty());
}

TEST_F(PlcTablesTest, SetAndGet) {
  const std::vector<uint8_t> key{0, 9, 0};
  EXPECT_EQ(tables_.setInt(0, 1, kCount, INT32_MIN), None);
  EXPECT_EQ(tables_.setReal(0, 1, kFeed, -0.1), None);
  EXPECT_EQ(tables_.setText(0, 1, kName, "Novy text"), None); // l.18747
  EXPECT_EQ(tables_.setBinary(0, 1, kKey, key), None);
  EXPECT_EQ(intAt(1), INT32_MIN);
  EXPECT_EQ(realAt(1), -0.1);
  EXPECT_EQ(textAt(1), "Novy text");
  EXPECT_EQ(bytesAt(1), key);
  EXPECT_EQ(tables_.setText(0, 1, kName, "x"), None);
  EXPECT_EQ(textAt(1), "x");
  EXPECT_EQ(textAt(0), "m\xEC\xEF"); // the other lines stay
  EXPECT_EQ(intAt(2), 16);
}

TEST_F(PlcTablesTest, TheElementItselfMayBeSet) {
  EXPECT_EQ(tables_.setText(0, 0, kName, textAt(0).substr(1)), None);
  EXPECT_EQ(textAt(0), "\xEC\xEF");
}

TEST_F(PlcTablesTest, ErrorsInTheirOrder) {
  int32_t value = 5;
  EXPECT_EQ(tables_.getInt(1, 9, 9, value), NoTable);
  EXPECT_EQ(tables_.getInt(256, 0, kCount, value), NoTable);
  EXPECT_EQ(tables_.getInt(UINT32_MAX, 0, kCount, value), NoTable);
  EXPECT_EQ(tables_.getInt(0, 3, 9, value), NoLine);
  EXPECT_EQ(tables_.getInt(0, UINT32_MAX, kCount, value), NoLine);
  EXPECT_EQ(tables_.getInt(0, 2, 4, value), NoColumn);
  EXPECT_EQ(tables_.getInt(0, 2, kFeed, value), OtherType);
  EXPECT_EQ(tables_.setInt(0, 2, kName, 1), OtherType);
  EXPECT_EQ(value, 5);
  EXPECT_EQ(tables_.getInt(0, 2, kCount, value), None);
}

TEST_F(PlcTablesTest, EveryTypeIsOnlyItsOwn) {
  double real = 5;
  std::string_view text = "before";
  std::span<const uint8_t> bytes;
  for (uint32_t column = 0; column < 4; ++column) {
    EXPECT_EQ(tables_.getReal(0, 0, column, real), column == kFeed ? None : OtherType);
    EXPECT_EQ(tables_.getText(0, 0, column, text), column == kName ? None : OtherType);
    EXPECT_EQ(tables_.getBinary(0, 0, column, bytes), column == kKey ? None : OtherType);
    EXPECT_EQ(tables_.setReal(0, 0, column, 1), column == kFeed ? None : OtherType);
    EXPECT_EQ(tables_.setText(0, 0, column, "a"), column == kName ? None : OtherType);
    EXPECT_EQ(tables_.setBinary(0, 0, column, {}), column == kKey ? None : OtherType);
  }
}

TEST_F(PlcTablesTest, WhatCannotBeStored) {
  const std::vector<uint8_t> most(kElementBytes, 7), more(kElementBytes + 1, 7);
  EXPECT_EQ(tables_.setBinary(0, 0, kKey, most), None);
  EXPECT_EQ(tables_.setBinary(0, 0, kKey, more), CannotBeStored);
  EXPECT_EQ(bytesAt(0), most);
  EXPECT_EQ(tables_.setBinary(0, 0, kKey, {}), None);
  EXPECT_EQ(tables_.setText(0, 0, kName, std::string(kElementBytes, 'x')), None);
  EXPECT_EQ(tables_.setText(0, 0, kName, std::string(kElementBytes + 1, 'y')), CannotBeStored);
  EXPECT_EQ(tables_.setText(0, 0, kName, "a\x01"), CannotBeStored);
  EXPECT_EQ(tables_.setText(0, 0, kName, std::string_view("a\0", 2)), CannotBeStored);
  EXPECT_EQ(textAt(0), std::string(kElementBytes, 'x'));
  EXPECT_EQ(tables_.setText(0, 0, kName, "\t\r\n\x7F\x98\xFF"), None);
  for (const double value : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(tables_.setReal(0, 0, kFeed, value), CannotBeStored);
  EXPECT_EQ(realAt(0), 2000.0);
}

TEST_F(PlcTablesTest, TheRoomForTexts) {
  const std::string half(PlcTables::kMoreTextBytes / 2, 'x');
  EXPECT_EQ(tables_.setText(0, 0, kName, half), None);
  EXPECT_EQ(tables_.setText(0, 1, kName, half), None);
  EXPECT_EQ(tables_.setText(0, 2, kName, half), CannotBeStored);
  EXPECT_EQ(textAt(2), "");
  EXPECT_EQ(bytesAt(0), (std::vector<uint8_t>{1, 2, 255}));
  EXPECT_EQ(tables_.removeLine(0, 1), ""); // gives its texts back
  EXPECT_EQ(tables_.setText(0, 1, kName, half), None);
  EXPECT_EQ(tables_.setText(0, 1, kName, "short"), None);
  EXPECT_EQ(tables_.setText(0, 0, kName, std::string_view(half).substr(1)), None);
  EXPECT_EQ(textAt(0), std::string_view(half).substr(1));
  EXPECT_EQ(textAt(1), "short");
  EXPECT_EQ(intAt(1), 16);
  EXPECT_EQ(bytesAt(0), (std::vector<uint8_t>{1, 2, 255}));
}

// Longer and shorter texts in turn, which fill the room many times over.
TEST_F(PlcTablesTest, TextsThatChangeOften) {
  std::string expected[3];
  for (uint32_t i = 0; i < 5000; ++i) {
    const uint32_t line = i % 3;
    expected[line] = std::string(i * 37 % 2000, static_cast<char>('a' + i % 26));
    ASSERT_EQ(tables_.setText(0, line, kName, expected[line]), None);
    for (uint32_t other = 0; other < 3; ++other)
      if (i > 2) ASSERT_EQ(textAt(other), expected[other]) << i;
  }
}

// l.18785-18860
TEST_F(PlcTablesTest, Columns) {
  uint32_t column = 9;
  EXPECT_EQ(tables_.columnIndex(0, "Count", column), None);
  EXPECT_EQ(column, kCount);
  EXPECT_EQ(tables_.columnIndex(0, "N\xE1zev", column), None);
  EXPECT_EQ(column, kName);
  EXPECT_EQ(tables_.columnIndex(0, "count", column), NoColumn);
  EXPECT_EQ(tables_.columnIndex(0, "", column), NoColumn);
  EXPECT_EQ(tables_.columnIndex(1, "Count", column), NoTable);
  EXPECT_EQ(column, kName);
  std::string_view id;
  EXPECT_EQ(tables_.columnId(0, kKey, id), None);
  EXPECT_EQ(id, "Key");
  EXPECT_EQ(tables_.columnId(0, 4, id), NoColumn);
  EXPECT_EQ(tables_.columnId(1, 0, id), NoTable);
  EXPECT_EQ(id, "Key");
}

// l.18893-18906
TEST_F(PlcTablesTest, TypesOfColumns) {
  const int types[] = {2, 1, 3, 4};
  for (uint32_t column = 0; column < 4; ++column) {
    ColumnType type{};
    EXPECT_EQ(tables_.columnType(0, column, type), None);
    EXPECT_EQ(static_cast<int>(type), types[column]);
  }
  ColumnType type = ColumnType::Binary;
  EXPECT_EQ(tables_.columnType(0, 4, type), NoColumn);
  EXPECT_EQ(tables_.columnType(7, 0, type), NoTable);
  EXPECT_EQ(type, ColumnType::Binary);
}

// l.18941-18993
TEST_F(PlcTablesTest, TheSelectedLine) {
  uint32_t line = 9;
  EXPECT_EQ(tables_.selectedLine(0, line), None);
  EXPECT_EQ(line, 0u);
  EXPECT_EQ(tables_.select(0, 2), None);
  EXPECT_EQ(tables_.select(0, 3), NoLine);
  EXPECT_EQ(tables_.select(1, 0), NoTable);
  EXPECT_EQ(tables_.selectedLine(0, line), None);
  EXPECT_EQ(line, 2u);
  EXPECT_EQ(tables_.selectedLine(1, line), NoTable);
}

TEST_F(PlcTablesTest, LineCount) {
  uint32_t count = 9;
  EXPECT_EQ(tables_.lineCount(0, count), None);
  EXPECT_EQ(count, 3u);
  EXPECT_EQ(tables_.lineCount(255, count), NoTable);
}

TEST_F(PlcTablesTest, TheProgramsOwnWritesAreNoChanges) {
  TableChange change = TableChange::Element;
  EXPECT_EQ(tables_.setInt(0, 0, kCount, 1), None);
  EXPECT_EQ(tables_.select(0, 1), None);
  EXPECT_EQ(tables_.takeChange(0, change), None);
  EXPECT_EQ(change, TableChange::None);
  EXPECT_EQ(tables_.takeChange(1, change), NoTable);
}

TEST_F(PlcTablesTest, WhatIsToBeStored) {
  const auto dirtyAfter = [&](TableError error) {
    const bool dirty = tables_.isDirty(0);
    tables_.stored(0);
    return dirty && error == None;
  };
  EXPECT_FALSE(tables_.isDirty(0));
  EXPECT_TRUE(dirtyAfter(tables_.setInt(0, 0, kCount, 1)));
  EXPECT_TRUE(dirtyAfter(tables_.setReal(0, 0, kFeed, 1)));
  EXPECT_TRUE(dirtyAfter(tables_.setText(0, 0, kName, "a")));
  EXPECT_TRUE(dirtyAfter(tables_.setBinary(0, 0, kKey, {})));
  EXPECT_TRUE(dirtyAfter(tables_.select(0, 1)));
  EXPECT_FALSE(dirtyAfter(tables_.select(0, 1)));
  EXPECT_FALSE(dirtyAfter(tables_.setInt(0, 3, kCount, 1)));
  EXPECT_FALSE(tables_.isDirty(0));
}

} // namespace
} // namespace rung::io
