// The files of PLC tables: what they say, where they are wrong, and what is written.
#include "tools/control-files/plc_table_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace rung::control_files {
namespace {

using testing::HasSubstr;

// ---- definitions ----------------------------------------------------------------------------------------------------

std::string definition(std::string_view inside) {
  return "<PLCTableDef><Definition><DefinitionID>D</DefinitionID>\n" + std::string(inside) +
         "</Definition></PLCTableDef>";
}

std::string definitionMistakes(std::string_view text) {
  TableDefinition found{.id = "before"};
  std::string mistakes = parseTableDefinition("f", text, found);
  EXPECT_EQ(mistakes.empty(), found.id != "before");
  return mistakes;
}

constexpr std::string_view kCol = "<ColsCount>1</ColsCount><Col No='0'><ColID>A</ColID><ColType>INT</ColType></Col>";

// l.18312-18325: columns after the Definition; here the whole of it.
TEST(PlcTableFiles, Definition) {
  TableDefinition found;
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
  const ColumnType types[] = {ColumnType::Real, ColumnType::Int, ColumnType::Text, ColumnType::Binary};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found.columns[i].id, ids[i]);
    EXPECT_EQ(found.columns[i].type, types[i]);
  }
  EXPECT_EQ(found.columns[3].place, "Sample.PlcTDef:11:1");
}

TEST(PlcTableFiles, ColumnsInsideTheDefinition) {
  EXPECT_EQ(definitionMistakes(definition(kCol)), "");
  EXPECT_EQ(definitionMistakes(definition("<ColsCount>0</ColsCount>")), "");
}

TEST(PlcTableFiles, WrongDefinitions) {
  EXPECT_EQ(definitionMistakes("<PLCTable/>"), "f:1:1: found <PLCTable>, expected <PLCTableDef>");
  EXPECT_EQ(definitionMistakes("<PLCTableDef/>"), "f:1:15: <PLCTableDef> lacks its <Definition>");
  EXPECT_EQ(definitionMistakes("<PLCTableDef><Definition/></PLCTableDef>"),
            "f:1:27: <Definition> lacks its <DefinitionID>\nf:1:27: <Definition> lacks its <ColsCount>");
  EXPECT_EQ(definitionMistakes(definition("<Column/>")),
            "f:2:1: <Definition> holds no <Column>, expected <DefinitionID>, <ColsCount> or <Col>\n"
            "f:2:10: <Definition> lacks its <ColsCount>");
  EXPECT_EQ(definitionMistakes(definition(std::string(kCol) + "<ColsCount>1</ColsCount>")),
            "f:2:81: <Definition> has a second <ColsCount>");
  EXPECT_EQ(definitionMistakes(definition("<ColsCount Most='1'>0</ColsCount>")),
            "f:2:1: <ColsCount> has no attribute 'Most'; expected none");
  EXPECT_EQ(definitionMistakes(definition("words" + std::string(kCol))),
            "f:2:6: <Definition> holds the text 'words', expected elements or nothing");
  EXPECT_EQ(definitionMistakes(definition("<ColsCount><b/></ColsCount>")),
            "f:2:12: <ColsCount> holds no <b>, but a text\nf:2:16: <ColsCount> is '', expected 0 to 65535");
  EXPECT_THAT(definitionMistakes("<PLCTableDef><Definition><DefinitionID> </DefinitionID></Definition></PLCTableDef>"),
              HasSubstr("<DefinitionID> is empty"));
}

TEST(PlcTableFiles, WrongColumns) {
  const auto mistakes = [](std::string_view columns) { return definitionMistakes(definition(columns)); };
  EXPECT_EQ(mistakes("<ColsCount>1</ColsCount><Col><ColID>A</ColID><ColType>INT</ColType></Col>"),
            "f:2:25: <Col> lacks the attribute No\n"
            "f:2:1: <ColsCount> is 1, expected 0, as many columns have a number of their own");
  EXPECT_THAT(mistakes("<ColsCount>1</ColsCount><Col No='-1'><ColID>A</ColID><ColType>INT</ColType></Col>"),
              HasSubstr("f:2:25: attribute No is '-1', expected 0 to 65534"));
  EXPECT_EQ(mistakes("<ColsCount>1</ColsCount><Col No='0'><ColType>INT</ColType></Col>"),
            "f:2:59: <Col> lacks its <ColID>");
  EXPECT_EQ(mistakes("<ColsCount>1</ColsCount><Col No='0'><ColID>A</ColID><ColType>DWORD</ColType></Col>"),
            "f:2:67: <ColType> is 'DWORD', expected INT, REAL, STRING or BINARY");
  EXPECT_EQ(mistakes(std::string(kCol) + "\n<Col No='0'><ColID>B</ColID><ColType>INT</ColType></Col>"),
            "f:3:1: column 0 is defined again; the first definition is at f:2:25");
  EXPECT_EQ(mistakes("<ColsCount>2</ColsCount><Col No='0'><ColID>A</ColID><ColType>INT</ColType></Col>\n"
                     "<Col No='1'><ColID>A</ColID><ColType>REAL</ColType></Col>"),
            "f:3:1: the column ID 'A' is used again; the first use is at f:2:25");
}

TEST(PlcTableFiles, TheCountOfColumns) {
  const auto counted = [](std::string_view count, std::string_view number = "0") {
    return definitionMistakes(definition("<ColsCount>" + std::string(count) + "</ColsCount><Col No='" +
                                         std::string(number) + "'><ColID>A</ColID><ColType>INT</ColType></Col>"));
  };
  EXPECT_EQ(counted("0x1"), "");
  EXPECT_EQ(counted("2"), "f:2:1: <ColsCount> is 2, expected 1, as many columns have a number of their own");
  EXPECT_EQ(counted("1", "1"), "f:2:1: <ColsCount> is 1, but there is a column 1; columns are numbered from 0");
  EXPECT_EQ(counted("many"), "f:2:16: <ColsCount> is 'many', expected 0 to 65535");
  EXPECT_EQ(definitionMistakes(definition("<Col No='0'><ColID>A</ColID><ColType>INT</ColType></Col>")),
            "f:2:57: <Definition> lacks its <ColsCount>");
  EXPECT_THAT(counted("65536"), HasSubstr("<ColsCount> is '65536', expected 0 to 65535"));
  EXPECT_THAT(counted("99999999999999999999"), HasSubstr("expected 0 to 65535"));
  EXPECT_THAT(counted("-1"), HasSubstr("<ColsCount> is '-1', expected 0 to 65535"));
}

// ---- data -----------------------------------------------------------------------------------------------------------

std::string data(std::string_view lines, std::string_view count = "3") {
  return "<PLCTable><Definition><DefinitionID>D</DefinitionID><LinesCount>" + std::string(count) +
         "</LinesCount></Definition>\n" + std::string(lines) + "</PLCTable>";
}

std::string dataMistakes(std::string_view text) {
  TableData found{.definition = "before"};
  std::string mistakes = parseTableData("f", text, found);
  EXPECT_EQ(mistakes.empty(), found.definition != "before");
  return mistakes;
}

// l.18383-18412.
TEST(PlcTableFiles, Data) {
  TableData found;
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
  TableData found;
  EXPECT_EQ(parseTableData("f",
                           "<?xml version='1.0' encoding='windows-1250'?>" +
                               data("<Line No='0'><Col ColID='N'>\xF8\xE8</Col></Line>"),
                           found),
            "");
  EXPECT_EQ(found.lines[0].elements[0].value, "řč");
}

TEST(PlcTableFiles, WrongData) {
  EXPECT_EQ(dataMistakes("<PLCTableDef/>"), "f:1:1: found <PLCTableDef>, expected <PLCTable>");
  EXPECT_EQ(dataMistakes("<PLCTable/>"), "f:1:12: <PLCTable> lacks its <Definition>");
  EXPECT_EQ(dataMistakes(data("", "65535")), "");
  EXPECT_EQ(dataMistakes(data("", "0")), "");
  EXPECT_EQ(dataMistakes(data("", "65536")), "f:1:70: <LinesCount> is '65536', expected 0 to 65535");
  EXPECT_EQ(dataMistakes(data("", "1.5")), "f:1:68: <LinesCount> is '1.5', expected 0 to 65535");
  EXPECT_EQ(dataMistakes(data("<Line/>")), "f:2:1: <Line> lacks the attribute No");
  EXPECT_EQ(dataMistakes(data("<Line No='3'/>")), "f:2:1: there is no line 3: <LinesCount> is 3");
  EXPECT_EQ(dataMistakes(data("<Line No='65535'/>")), "f:2:1: attribute No is '65535', expected 0 to 65534");
  EXPECT_EQ(dataMistakes(data("<Line No='x'/>")), "f:2:1: attribute No is 'x', expected 0 to 65534");
  EXPECT_EQ(dataMistakes(data("<Line No='1'/>\n<Line No='1'/>")),
            "f:3:1: line 1 is given again; the first time is at f:2:1");
  EXPECT_EQ(dataMistakes(data("<Line No='1'><Col>1</Col></Line>")), "f:2:14: <Col> lacks the attribute ColID");
  EXPECT_EQ(dataMistakes(data("<Line No='1'><Col ColID='A'>1</Col>\n<Col ColID='A'>2</Col></Line>")),
            "f:3:1: column 'A' is given again in this line; the first time is at f:2:14");
  EXPECT_EQ(dataMistakes(data("<Line No='1'>1</Line>")),
            "f:2:15: <Line> holds the text '1', expected elements or nothing");
  EXPECT_EQ(dataMistakes(data("<Row/>")), "f:2:1: <PLCTable> holds no <Row>, expected <Definition> or <Line>");
}

TEST(PlcTableFiles, TheSelectedLine) {
  const auto selected = [](std::string_view line, std::string_view count) {
    return dataMistakes("<PLCTable><Definition><DefinitionID>D</DefinitionID><LinesCount>" + std::string(count) +
                        "</LinesCount><SelLine>" + std::string(line) + "</SelLine></Definition></PLCTable>");
  };
  EXPECT_EQ(selected("2", "3"), "");
  EXPECT_EQ(selected("0", "0"), "");
  EXPECT_EQ(selected("3", "3"), "f:1:79: <SelLine> is 3, but <LinesCount> is 3");
}

TEST(PlcTableFiles, TruncatedAnywhereIsAMistake) {
  const std::string whole = data("<Line No='1'><Col ColID='A'>12</Col></Line>");
  EXPECT_EQ(dataMistakes(whole), "");
  for (size_t i = 0; i < whole.size(); ++i)
    EXPECT_THAT(dataMistakes(std::string_view(whole).substr(0, i)), HasSubstr("not well-formed")) << i;
  EXPECT_THAT(dataMistakes(whole.substr(0, 70)), HasSubstr("expected the end of <LinesCount> of line 1"));
}

TEST(PlcTableFiles, FilesThatAreNot) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  TableDefinition found;
  TableData contents;
  EXPECT_EQ(readTableDefinition(folder, found), folder + ": this is a folder, expected a file");
  EXPECT_THAT(readTableData(folder + "/there-is-no-such-file", contents), HasSubstr("cannot be read"));
}

// ---- writing --------------------------------------------------------------------------------------------------------

TEST(PlcTableFiles, WhatIsWritten) {
  const TableData contents{.definition = "Mate<rials",
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
  TableData again;
  EXPECT_EQ(parseTableData("f", text, again), "");
  EXPECT_EQ(tableDataText(again), text);
  EXPECT_EQ(again.lines[1].elements[0].value, " a\r\n&");
}

TEST(PlcTableFiles, LineZeroIsNotWrittenAsSelected) {
  EXPECT_THAT(tableDataText({.definition = "D", .lineCount = 2}), testing::Not(HasSubstr("SelLine")));
}

} // namespace
} // namespace rung::control_files
