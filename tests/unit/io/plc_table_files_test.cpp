// The files of PLC tables: what they say, and what is written. What is said about a mistake in them is a golden
// (golden_test.cpp).
#include "machine/io/tables/plc_table_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace rung::host {
namespace {

using testing::HasSubstr;

// ---- definitions ----------------------------------------------------------------------------------------------------

// l.18312-18325: columns after the Definition; here the whole of it.
TEST(PlcTableFiles, Definition) {
  io::TableDefinition found;
  EXPECT_EQ(parseTableDefinition("Sample.PlcTDef", R"(<?xml version="1.0"?>
<PLCTableDef>
<Definition>
<DefinitionID>Materials</DefinitionID>
<ColsCount>4</ColsCount>
</Definition>
<Col No="0"> <!-- Material thickness (mm) -->
<ColID>MaterialThickness</ColID>
<ColType>REAL</ColType>
</Col>
<Col No="3"><ColID>Klíč</ColID><ColType> BINARY </ColType></Col>
<Col No="1"><ColType>INT</ColType><ColID>Count</ColID></Col>
<Col No="2"><ColID>Name</ColID><ColType>STRING</ColType></Col>
</PLCTableDef>)",
                                 found),
            "");
  EXPECT_EQ(found.id, "Materials");
  EXPECT_EQ(found.place, "Sample.PlcTDef:4:1");
  ASSERT_EQ(found.columns.size(), 4u);
  const char* const ids[] = {"MaterialThickness", "Count", "Name", "Klíč"};
  const io::ColumnType types[] = {io::ColumnType::Real, io::ColumnType::Int, io::ColumnType::Text,
                                  io::ColumnType::Binary};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found.columns[i].id, ids[i]);
    EXPECT_EQ(found.columns[i].type, types[i]);
  }
  EXPECT_EQ(found.columns[3].place, "Sample.PlcTDef:11:1");
}

// ---- data -----------------------------------------------------------------------------------------------------------

std::string data(std::string_view lines) {
  return "<PLCTable><Definition><DefinitionID>D</DefinitionID><LinesCount>3</LinesCount></Definition>\n" +
         std::string(lines) + "</PLCTable>";
}

std::string dataMistakes(std::string_view text) {
  io::TableData found{.definition = "before"};
  std::string mistakes = parseTableData("f", text, found);
  EXPECT_EQ(mistakes.empty(), found.definition != "before");
  return mistakes;
}

// l.18383-18412.
TEST(PlcTableFiles, Data) {
  io::TableData found;
  EXPECT_EQ(parseTableData("Sample1.PlcT", R"(<PLCTable>
<Definition>
<DefinitionID>Materials</DefinitionID>
<LinesCount>5</LinesCount>
</Definition>
<Line No="0">
<Col ColID="MaterialThickness">1</Col>
<Col ColID="Feed"> 2000 </Col>
</Line>
<Line No="4"><Col ColID="Name"> a&amp;b&#13;&lt;</Col></Line>
<Line No="1"/>
</PLCTable>)",
                           found),
            "");
  EXPECT_EQ(found.definition, "Materials");
  EXPECT_EQ(found.place, "Sample1.PlcT:3:1");
  EXPECT_EQ(found.lineCount, 5u);
  EXPECT_EQ(found.selected, 0u);
  ASSERT_EQ(found.lines.size(), 3u);
  ASSERT_EQ(found.lines[0].elements.size(), 2u);
  EXPECT_EQ(found.lines[0].elements[1].column, "Feed");
  EXPECT_EQ(found.lines[0].elements[1].value, " 2000 ");
  EXPECT_EQ(found.lines[0].elements[1].place, "Sample1.PlcT:8:1");
  EXPECT_EQ(found.lines[1].number, 4u);
  EXPECT_EQ(found.lines[1].elements[0].value, " a&b\r<");
  EXPECT_EQ(found.lines[2].number, 1u);
}

TEST(PlcTableFiles, ATextInWindows1250) {
  io::TableData found;
  EXPECT_EQ(parseTableData("f",
                           "<?xml version='1.0' encoding='windows-1250'?>" +
                               data("<Line No='0'><Col ColID='N'>\xF8\xE8</Col></Line>"),
                           found),
            "");
  EXPECT_EQ(found.lines[0].elements[0].value, "řč");
}

TEST(PlcTableFiles, TruncatedAnywhereIsAMistake) {
  const std::string whole = data("<Line No='1'><Col ColID='A'>12</Col></Line>");
  EXPECT_EQ(dataMistakes(whole), "");
  for (size_t i = 0; i < whole.size(); ++i)
    EXPECT_THAT(dataMistakes(std::string_view(whole).substr(0, i)), HasSubstr("not well-formed")) << i;
}

TEST(PlcTableFiles, FilesThatAreNot) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  io::TableDefinition found;
  io::TableData contents;
  EXPECT_EQ(readTableDefinition(folder, found), folder + ": cannot be read: it is a folder");
  EXPECT_THAT(readTableData(folder + "/there-is-no-such-file", contents), HasSubstr("cannot be read"));
}

// ---- writing --------------------------------------------------------------------------------------------------------

TEST(PlcTableFiles, WhatIsWritten) {
  const io::TableData contents{
      .definition = "Mate<rials",
      .lineCount = 2,
      .selected = 1,
      .lines = {{.number = 0, .elements = {{"Feed", "1000", {}}, {"A\"B", "", {}}}, .place = {}},
                {.number = 1, .elements = {{"Feed", " a\r\n&", {}}}, .place = {}}}};
  const std::string text = R"(<?xml version="1.0" encoding="utf-8"?>
<PLCTable>
  <Definition>
    <DefinitionID>Mate&lt;rials</DefinitionID>
    <LinesCount>2</LinesCount>
    <SelLine>1</SelLine>
  </Definition>
  <Line No="0">
    <Col ColID="Feed">1000</Col>
    <Col ColID="A&quot;B"></Col>
  </Line>
  <Line No="1">
    <Col ColID="Feed"> a&#13;&#10;&amp;</Col>
  </Line>
</PLCTable>
)";
  EXPECT_EQ(tableDataText(contents), text);
  io::TableData again;
  EXPECT_EQ(parseTableData("f", text, again), "");
  EXPECT_EQ(tableDataText(again), text);
  EXPECT_EQ(again.lines[1].elements[0].value, " a\r\n&");
}

TEST(PlcTableFiles, LineZeroIsNotWrittenAsSelected) {
  EXPECT_THAT(io::tableDataText({.definition = "D", .lineCount = 2}), testing::Not(HasSubstr("SelLine")));
}

} // namespace
} // namespace rung::host
