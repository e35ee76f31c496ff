// checkProgram: each thing that can be wrong with the tables is found and named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "rtlib/host/program_info.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using rung::host::checkProgram;
using rung::test::TestProgram;
using testing::HasSubstr;

struct Case {
  const char* name;
  std::function<void(TestProgram&)> spoil; // after link()
  const char* message;
};

TestProgram soundProgram() {
  TestProgram test;
  test.addSpace("X", 1, {{0, 4, 0, RUNG_REPR_PACKED}, {4, 4, 64, RUNG_REPR_BYTE_PER_BIT}});
  test.addSymbol("A", 0, 1, RUNG_TYPE_I8);
  test.addSymbol("B", 0, 2, RUNG_TYPE_BIT, 3);
  static const uint8_t kOne = 1;
  test.inits = {{0, 1, &kOne}};
  test.retains = {{0, 4}};
  test.safeSpans = {{0, 4}};
  test.addChunk([](uint8_t*, rung_ctx*) { return RUNG_PC_DONE; });
  const uint32_t task = test.addTask("MAIN", 0);
  test.addBeginCopy(task, {RUNG_COPY_MASKED, 0, 4, 8, 2});
  test.scan = {{RUNG_STEP_RUN, task, 1}};
  test.fast = {{RUNG_STEP_RUN, task, 1}};
  return test;
}

TEST(CheckProgram, SoundProgramPasses) {
  TestProgram test = soundProgram();
  EXPECT_EQ(checkProgram(test.link()), "");
}

class CheckProgram : public testing::TestWithParam<Case> {};

TEST_P(CheckProgram, FindsIt) {
  TestProgram test = soundProgram();
  test.link();
  GetParam().spoil(test);
  EXPECT_THAT(checkProgram(test.program), HasSubstr(GetParam().message));
}

const Case kCases[] = {
    {"Version", [](TestProgram& t) { t.program.abi_version = 9; }, "ABI version 9"},
    {"Size", [](TestProgram& t) { t.program.size = 8; }, "has 8 bytes"},
    {"Alignment", [](TestProgram& t) { t.program.memory_align = 24; }, "power of two"},
    {"Name", [](TestProgram& t) { t.program.dialect = nullptr; }, "is missing"},
    {"NoCode", [](TestProgram& t) { t.program.chunk_fns = nullptr; }, "no code"},
    {"NullChunk", [](TestProgram& t) { t.functions[0] = nullptr; }, "chunk 0 has no code"},
    {"NullTable", [](TestProgram& t) { t.program.rungs = nullptr; }, "table of rungs is missing"},
    {"SpaceOutside", [](TestProgram& t) { t.ranges[0][1].offset = 250; }, "outside the memory block"},
    {"SpaceGap", [](TestProgram& t) { t.ranges[0][1].first_byte = 5; }, "do not cover"},
    {"SpaceShort", [](TestProgram& t) { t.spaces[0].byte_count = 9; }, "do not cover"},
    {"SymbolSpace", [](TestProgram& t) { t.symbols[0].space = 3; }, "space of symbol"},
    {"SymbolType", [](TestProgram& t) { t.symbols[0].type = 0; }, "bad type"},
    {"SymbolOrder", [](TestProgram& t) { std::swap(t.symbols[0], t.symbols[1]); }, "not sorted"},
    {"Init", [](TestProgram& t) { t.inits[0].size = 300; }, "initial contents 0"},
    {"Retain", [](TestProgram& t) { t.retains[0].offset = 254; }, "retained span 0"},
    {"Safe", [](TestProgram& t) { t.safeSpans[0].offset = 0xFFFFFFFF; }, "safe span 0"},
    {"CopyTo", [](TestProgram& t) { t.copies[0].to = 255; }, "copy 0"},
    {"CopyMask", [](TestProgram& t) { t.copies[0].mask = 255; }, "copy 0"},
    {"ChunkRungs", [](TestProgram& t) { t.chunks[0].rung_count = 2; }, "rungs that do not exist"},
    {"RungFile", [](TestProgram& t) { t.rungs[0].file = 1; }, "file of rung"},
    {"RungRoutine", [](TestProgram& t) { t.rungs[0].routine = 1; }, "routine of rung"},
    {"TaskEntry", [](TestProgram& t) { t.tasks[0].entry = 1; }, "entry of task"},
    {"TaskFault", [](TestProgram& t) { t.tasks[0].budget_fault = RUNG_NONE; }, "budget fault"},
    {"TaskCopies", [](TestProgram& t) { t.tasks[0].begin_count = 2; }, "begin copies"},
    {"TaskParts", [](TestProgram& t) { t.tasks[0].part_first = 1; }, "parts of task"},
    {"ScanTask", [](TestProgram& t) { t.scan[0].task = 1; }, "scan step"},
    {"FastOp", [](TestProgram& t) { t.fast[0].op = 9; }, "fast step 0 is unknown"},
    {"MainTask", [](TestProgram& t) { t.program.main_task = 4; }, "main task"},
    {"Texts", [](TestProgram& t) { t.program.text_count = 3; }, "not pairs"},
};

INSTANTIATE_TEST_SUITE_P(All, CheckProgram, testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

} // namespace
