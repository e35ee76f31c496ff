// PLC tables from the contents of their files and back. What is said about wrong contents is a golden
// (golden_test.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "machine/io/tables/plc_tables.h"
#include "tests/unit/io/materials.h"

namespace rung::io {
namespace {

using test::dataOf;
using test::definitionOf;
using testing::HasSubstr;

std::string lines(std::string_view count, std::string_view lines) {
  return "<PLCTable>\n<Definition><DefinitionID>Materials</DefinitionID><LinesCount>" + std::string(count) +
         "</LinesCount></Definition>\n" + std::string(lines) + "</PLCTable>";
}

std::string mistakes(std::string_view elements) {
  PlcTables tables;
  std::string found = tables.load(0, definitionOf(test::kMaterials),
                                  dataOf(lines("1", "<Line No='0'>" + std::string(elements) + "</Line>")));
  EXPECT_EQ(tables.exists(0), found.empty());
  return found;
}

std::string column(std::string_view id, std::string_view value) {
  return "<Col ColID='" + std::string(id) + "'>" + std::string(value) + "</Col>";
}

TEST(PlcTablesLoad, ManyMistakesAreCounted) {
  std::string many;
  for (int i = 0; i < 150; ++i) many += column("C" + std::to_string(i), "1");
  EXPECT_THAT(mistakes(many), HasSubstr("\nand 50 more mistakes"));
}

TEST(PlcTablesLoad, TheMemoryOfAllTables) {
  PlcTables tables;
  const TableDefinition definition = definitionOf(test::kMaterials); // 28 bytes a line, and 65536 for texts
  for (uint32_t i = 2; i < 19; ++i) EXPECT_EQ(tables.load(i, definition, dataOf(lines("65535", ""))), "");
  EXPECT_EQ(tables.load(0, definition, dataOf(lines("38000", ""))), "");
  EXPECT_EQ(tables.load(1, definition, dataOf(lines("2000", ""))),
            "t:2:13: the table needs 128704 bytes, for 2000 lines and 256 more; 108956 of the 33554432 of all tables "
            "are left");
  EXPECT_EQ(tables.load(0, definition, dataOf(lines("2000", ""))), ""); // in the place of the former one
  EXPECT_EQ(tables.load(1, definition, dataOf(lines("2000", ""))), "");
  tables.remove(1);
  EXPECT_FALSE(tables.exists(1));
  tables.remove(300);
}

TEST(PlcTablesLoad, TheMostLines) {
  PlcTables tables;
  EXPECT_EQ(tables.load(0, definitionOf(test::kMaterials),
                        dataOf(lines("65535", "<Line No='65534'>" + column("Název", "x") + "</Line>"))),
            "");
  std::string_view text;
  EXPECT_EQ(tables.getText(0, 65534, 2, text), TableError::None);
  EXPECT_EQ(text, "x");
  EXPECT_EQ(tables.getText(0, 65533, 2, text), TableError::None);
  EXPECT_EQ(text, "");
}

TEST(PlcTablesLoad, Boundaries) {
  PlcTables tables;
  const TableDefinition definition{
      .id = "D", .columns = {{.id = "A", .type = ColumnType::Int, .place = {}}}, .place = {}};
  TableData most{.definition = "D", .lineCount = 65535, .selected = 65534, .place = "t:1:1"};
  EXPECT_EQ(tables.load(255, definition, most), "");
  EXPECT_EQ(tables.setInt(255, 65534, 0, 7), TableError::None);
  EXPECT_EQ(tables.setInt(255, 65535, 0, 7), TableError::NoLine);
  EXPECT_EQ(tables.addLine(255), "PLC table 255 has 65535 lines, and there is no memory for another: it is full");
  EXPECT_EQ(tables.load(256, definition, most), "t:1:1: there is no PLC table 256, expected 0 to 255");
  EXPECT_EQ(tables.load(3, {.id = "D"}, {.definition = "D", .lineCount = 2}), ""); // no columns
  EXPECT_EQ(tables.removeLine(3, 0), "");
  EXPECT_EQ(tables.contents(3)->lines.size(), 1u);
}

TEST(PlcTablesLoad, WhatIsWrittenIsReadAgain) {
  PlcTables tables;
  test::loadMaterials(tables);
  std::string everything = "\t\n\r";
  for (int c = 0x20; c < 0x100; ++c) everything += static_cast<char>(c);
  EXPECT_EQ(tables.setText(0, 1, 2, everything), TableError::None);
  EXPECT_EQ(tables.setText(0, 0, 2, " \r\n "), TableError::None);
  const double reals[] = {-0.0, 1.0 / 3, 5e-324, 1.7976931348623157e308};
  for (const double real : reals) {
    EXPECT_EQ(tables.setReal(0, 1, 0, real), TableError::None);
    EXPECT_EQ(tables.select(0, 2), TableError::None);
    const std::string text = io::tableDataText(*tables.contents(0));
    PlcTables again;
    EXPECT_EQ(again.load(0, definitionOf(test::kMaterials), dataOf(text)), "");
    EXPECT_EQ(io::tableDataText(*again.contents(0)), text);
    std::string_view found;
    EXPECT_EQ(again.getText(0, 1, 2, found), TableError::None);
    EXPECT_EQ(found, everything);
    double value = 0;
    EXPECT_EQ(again.getReal(0, 1, 0, value), TableError::None);
    EXPECT_EQ(value, real);
    uint32_t line = 0;
    EXPECT_EQ(again.selectedLine(0, line), TableError::None);
    EXPECT_EQ(line, 2u);
  }
  EXPECT_FALSE(tables.contents(1).has_value());
}

} // namespace
} // namespace rung::io
