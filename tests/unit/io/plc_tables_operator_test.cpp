// What an operator does with PLC tables, and what PLCT_CHANGED then gives (l.19007-19012). What is said about mistakes
// is a golden (golden_test.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "machine/io/tables/plc_tables.h"
#include "tests/unit/io/materials.h"

namespace rung::io {
namespace {

using testing::HasSubstr;
using enum TableChange;

class PlcTablesOperator : public testing::Test {
protected:
  void SetUp() override { test::loadMaterials(tables_); }

  TableChange change() {
    TableChange change{};
    EXPECT_EQ(tables_.takeChange(0, change), TableError::None);
    return change;
  }
  uint32_t lines() const {
    uint32_t count = 0;
    EXPECT_EQ(tables_.lineCount(0, count), TableError::None);
    return count;
  }
  uint32_t selected() const {
    uint32_t line = 99;
    tables_.selectedLine(0, line);
    return line;
  }
  int32_t countAt(uint32_t line) const {
    int32_t value = 0;
    EXPECT_EQ(tables_.getInt(0, line, 1, value), TableError::None);
    return value;
  }
  std::string written(uint32_t line, size_t column) const {
    return tables_.contents(0)->lines.at(line).elements.at(column).value;
  }

  PlcTables tables_;
};

TEST_F(PlcTablesOperator, EditsByText) {
  EXPECT_EQ(tables_.edit(0, 2, "Feed", "750"), "");
  EXPECT_EQ(tables_.edit(0, 2, "Count", " 0xFFFFFFFF "), "");
  EXPECT_EQ(tables_.edit(0, 2, "Název", " příliš žluťoučký\r\n"), "");
  EXPECT_EQ(tables_.edit(0, 2, "Key", "01 0203fE"), "");
  EXPECT_EQ(written(2, 0), "750");
  EXPECT_EQ(countAt(2), -1);
  EXPECT_EQ(written(2, 2), " příliš žluťoučký\r\n");
  EXPECT_EQ(written(2, 3), "010203FE");
  EXPECT_EQ(tables_.edit(0, 2, "Key", ""), "");
  EXPECT_EQ(written(2, 3), "");
}

TEST_F(PlcTablesOperator, EditsByNumber) {
  EXPECT_EQ(tables_.edit(0, 1, "Feed", 0.1), "");
  EXPECT_EQ(tables_.edit(0, 1, "Count", 4294967295.0), "");
  EXPECT_EQ(written(1, 0), "0.1");
  EXPECT_EQ(countAt(1), -1);
  EXPECT_EQ(tables_.edit(0, 1, "Count", -2147483648.0), "");
  EXPECT_EQ(countAt(1), INT32_MIN);
  EXPECT_NE(tables_.edit(0, 1, "Count", 1.5), "");
  EXPECT_NE(tables_.edit(0, 1, "Count", 4294967296.0), "");
  EXPECT_EQ(countAt(1), INT32_MIN);
}

TEST_F(PlcTablesOperator, WrongEdits) {
  EXPECT_NE(tables_.edit(1, 0, "Feed", "1"), "");
  EXPECT_NE(tables_.edit(0, 3, "Feed", "1"), "");
  EXPECT_NE(tables_.edit(0, 0, "feed", "1"), "");
  EXPECT_NE(tables_.edit(0, 0, "Feed", "fast"), "");
  EXPECT_NE(tables_.edit(0, 0, "Count", "1e3"), "");
  EXPECT_THAT(tables_.edit(0, 0, "Název", "a\x02"), HasSubstr("expected no control characters but tab and line ends"));
  for (const char* wrong : {"1", "010", "0g", "01 2", "-1", "0x01"}) EXPECT_NE(tables_.edit(0, 0, "Key", wrong), "");
  EXPECT_EQ(written(0, 3), "0102FF");
  EXPECT_EQ(change(), None);
  EXPECT_FALSE(tables_.isDirty(0));
}

TEST_F(PlcTablesOperator, ChangesElementsFirst) {
  EXPECT_EQ(tables_.selectByOperator(0, 2), "");
  EXPECT_EQ(tables_.edit(0, 0, "Count", "1"), "");
  EXPECT_EQ(tables_.edit(0, 1, "Count", "1"), "");
  EXPECT_EQ(change(), Element);
  EXPECT_EQ(change(), SelectedLine);
  EXPECT_EQ(change(), None);
  EXPECT_EQ(tables_.edit(0, 1, "Count", "1"), ""); // also of the same value
  EXPECT_EQ(change(), Element);
  EXPECT_EQ(change(), None);
}

TEST_F(PlcTablesOperator, SelectsLines) {
  EXPECT_EQ(tables_.selectByOperator(0, 0), ""); // the same line
  EXPECT_EQ(change(), None);
  EXPECT_FALSE(tables_.isDirty(0));
  EXPECT_EQ(tables_.selectByOperator(0, 2), "");
  EXPECT_EQ(selected(), 2u);
  EXPECT_TRUE(tables_.isDirty(0));
  EXPECT_NE(tables_.selectByOperator(0, 3), "");
  EXPECT_NE(tables_.selectByOperator(9, 0), "");
  EXPECT_EQ(selected(), 2u);
}

TEST_F(PlcTablesOperator, AddsLines) {
  EXPECT_EQ(tables_.addLine(0), "");
  EXPECT_EQ(lines(), 4u);
  EXPECT_EQ(change(), Element);
  EXPECT_EQ(change(), None);
  EXPECT_EQ(tables_.setInt(0, 3, 1, 5), TableError::None);
  EXPECT_EQ(tables_.removeLine(0, 3), "");
  EXPECT_EQ(tables_.addLine(0), "");
  EXPECT_EQ(countAt(3), 0); // not what was there
  for (uint32_t i = 1; i < PlcTables::kMoreLines; ++i) EXPECT_EQ(tables_.addLine(0), "");
  EXPECT_EQ(tables_.addLine(0), "PLC table 0 has 259 lines, and there is no memory for another; a restart makes room");
  EXPECT_EQ(lines(), 259u);
  EXPECT_NE(tables_.addLine(1), "");
}

TEST_F(PlcTablesOperator, RemovesLines) {
  EXPECT_EQ(tables_.selectByOperator(0, 1), "");
  EXPECT_EQ(change(), SelectedLine);
  EXPECT_EQ(tables_.removeLine(0, 2), ""); // after the selected one
  EXPECT_EQ(selected(), 1u);
  EXPECT_EQ(change(), Element);
  EXPECT_EQ(change(), None);
  EXPECT_NE(tables_.removeLine(0, 2), "");
}

TEST_F(PlcTablesOperator, TheSelectedLineMovesUp) {
  EXPECT_EQ(tables_.selectByOperator(0, 2), "");
  EXPECT_EQ(change(), SelectedLine);
  EXPECT_EQ(tables_.removeLine(0, 0), "");
  EXPECT_EQ(selected(), 1u); // what was line 2
  EXPECT_EQ(countAt(1), 16);
  EXPECT_EQ(change(), Element);
  EXPECT_EQ(change(), SelectedLine);
}

TEST_F(PlcTablesOperator, RemovesTheSelectedLine) {
  EXPECT_EQ(tables_.removeLine(0, 0), "");
  EXPECT_EQ(selected(), 0u);
  EXPECT_EQ(change(), Element);
  EXPECT_EQ(change(), SelectedLine);
  EXPECT_EQ(tables_.selectByOperator(0, 1), "");
  EXPECT_EQ(tables_.removeLine(0, 1), ""); // the last one
  EXPECT_EQ(selected(), 0u);
  EXPECT_EQ(tables_.removeLine(0, 0), "");
  EXPECT_EQ(lines(), 0u);
  uint32_t line = 5;
  EXPECT_EQ(tables_.selectedLine(0, line), TableError::NoLine); // l.19130
  EXPECT_NE(tables_.removeLine(0, 0), "");
  EXPECT_EQ(tables_.addLine(0), "");
  EXPECT_EQ(selected(), 0u);
}

} // namespace
} // namespace rung::io
