// Look-ups in the tables of a program.
#include "rtlib/load/program_info.h"

#include <gtest/gtest.h>

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;

TEST(ProgramInfo, LookUps) {
  TestProgram test;
  test.addPacked("D", 1, 4, 0);
  test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
  test.addTask("MAIN", 0);
  test.link();
  EXPECT_EQ(findSpace(test.program, "D"), 0u);
  EXPECT_EQ(findSpace(test.program, "E"), RUNG_NONE);
  EXPECT_EQ(findTask(test.program, "MAIN"), 0u);
  EXPECT_EQ(findService(test.program, "WINDW"), 1u);
  EXPECT_EQ(serviceName(test.program, 0), "WINDR");
  EXPECT_EQ(serviceName(test.program, 9), "");
  EXPECT_EQ(messageText(test.program, 23), "LUBRICATION");
  EXPECT_EQ(messageText(test.program, 2), "");
  EXPECT_EQ(scanPeriodUs(test.program), 8000u);
}

TEST(ProgramInfo, Symbols) {
  TestProgram test;
  const uint32_t area = test.addPacked("D", 1, 4, 0);
  test.addSymbol("B", area, 1, RUNG_TYPE_I8);
  test.addSymbol("D", area, 2, RUNG_TYPE_I8);
  test.link();
  ASSERT_NE(findSymbol(test.program, "B"), nullptr);
  EXPECT_EQ(findSymbol(test.program, "B")->byte, 1u);
  for (const char* name : {"", "A", "BB", "C", "E"}) EXPECT_EQ(findSymbol(test.program, name), nullptr) << name;
  for (const char* name : {"BB", "C", "D"}) {
    ASSERT_NE(firstSymbolFrom(test.program, name), nullptr) << name;
    EXPECT_EQ(firstSymbolFrom(test.program, name)->byte, 2u) << name;
  }
  EXPECT_EQ(firstSymbolFrom(test.program, "E"), nullptr);
}

TEST(ProgramInfo, FaultTexts) {
  TestProgram test;
  for (int i = 0; i < 4; ++i) test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
  test.link();
  EXPECT_EQ(faultText(test.program, {0, 3, 12, 0}), "dead-loop (rung 4 \"title\", main.pmc:12)");
  EXPECT_EQ(faultText(test.program, {1, 0, 0, 0}), "division by zero (rung 1, main.pmc:10)");
  test.rungs[0].number = 0;
  EXPECT_EQ(faultText(test.program, {1, 0, 0, 0}), "division by zero (MAIN, main.pmc:10)");
  EXPECT_EQ(faultText(test.program, {7, 99, 0, 0}), "undescribed fault (unknown rung)");
  EXPECT_EQ(faultText(test.program, {RUNG_NONE, RUNG_NONE, 0, RUNG_NONE}), "");
}

} // namespace
