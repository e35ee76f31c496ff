// The table of materials of the manual (l.18312-18413), with a column of each type.
#pragma once
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "machine/io/tables/plc_tables.h"

namespace rung::test {

inline constexpr std::string_view kMaterials = R"(<PLCTableDef>
<Definition><DefinitionID>Materials</DefinitionID><ColsCount>4</ColsCount></Definition>
<Col No="0"><ColID>Feed</ColID><ColType>REAL</ColType></Col>
<Col No="1"><ColID>Count</ColID><ColType>INT</ColType></Col>
<Col No="2"><ColID>Název</ColID><ColType>STRING</ColType></Col>
<Col No="3"><ColID>Key</ColID><ColType>BINARY</ColType></Col>
</PLCTableDef>)";

inline constexpr std::string_view kThreeLines = R"(<PLCTable>
<Definition><DefinitionID>Materials</DefinitionID><LinesCount>3</LinesCount></Definition>
<Line No="0"><Col ColID="Feed">2000</Col><Col ColID="Count">-7</Col><Col ColID="Název">měď</Col><Col ColID="Key">0102fF</Col></Line>
<Line No="2"><Col ColID="Feed"> 100.2 </Col><Col ColID="Count">0x10</Col></Line>
</PLCTable>)";

inline io::TableDefinition definitionOf(std::string_view text) {
  io::TableDefinition definition;
  EXPECT_EQ(io::parseTableDefinition("d", text, definition), "");
  return definition;
}

inline io::TableData dataOf(std::string_view text) {
  io::TableData data;
  EXPECT_EQ(io::parseTableData("t", text, data), "");
  return data;
}

inline void loadMaterials(io::PlcTables& tables, uint32_t number = 0) {
  EXPECT_EQ(tables.load(number, definitionOf(kMaterials), dataOf(kThreeLines)), "");
}

} // namespace rung::test
