// checkProgram: each thing that can be wrong with the tables is found and named.
#include <gtest/gtest.h>

#include "rtlib/load/program_info.h"
#include "tests/support/words.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using rung::runtime::checkProgram;
using rung::test::lacking;
using rung::test::TestProgram;

struct Case {
  const char* name;
  void (*spoil)(TestProgram&); // after link()
  const char* message;
};

// Space X: 4 packed bytes at 0, 4 expanded ones at 64; space Y: 8 packed bytes at 128. MAIN: two parts.
TestProgram soundProgram() {
  TestProgram test;
  test.addSpace("X", 1, {{0, 4, 0, RUNG_REPR_PACKED}, {4, 4, 64, RUNG_REPR_BYTE_PER_BIT}});
  test.addPacked("Y", 2, 8, 128);
  test.addSymbol("A", 0, 1, RUNG_TYPE_I8);
  test.addSymbol("B", 0, 2, RUNG_TYPE_BIT, 3);
  test.addConstant("C", 5);
  test.addSlot("edge", 32, RUNG_TYPE_BIT);
  test.addSlot("since", 40, RUNG_TYPE_I64);
  test.addContinuation("MECH", 48, {"beginning", "open"});
  test.addContinuation("TURN", 52, {"beginning"});
  test.addTimer("TMRB 1", 40, 1000);
  static const uint8_t kData[] = {1, 0, 1, 1, 0, 1, 1, 1, 2};
  test.inits = {{0, 1, kData}, {64, 8, kData}};
  test.retains = {{0, 4}, {72, 16}};
  test.safeSpans = {{0, 4}};
  test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
  test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
  const uint32_t task = test.addTask("MAIN", 0, 1000, {1, RUNG_PC_DONE});
  test.addBeginCopy(task, {RUNG_COPY_MASKED, 0, 128, 130, 2});
  test.addBeginCopy(task, {RUNG_COPY_ALL, 64, 72, 0, 8});
  test.scan = {{RUNG_STEP_RUN, task, 1}};
  test.fast = {{RUNG_STEP_RUN, task, 1}};
  return test;
}

TEST(CheckProgram, SoundProgramPasses) {
  TestProgram test = soundProgram();
  EXPECT_EQ(checkProgram(test.link()), "");
}

class CheckProgram : public testing::TestWithParam<Case> {};

// Each alone lies in the block, and together they have more bytes than a size can say.
TEST(CheckProgram, RetainedSpansTogether) {
  constexpr uint32_t kBytes = 64u << 20;
  TestProgram test;
  test.memorySize = kBytes;
  test.addPacked("K", 1, kBytes, 0);
  test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
  test.addTask("MAIN", 0);
  test.retains = {{0, kBytes}};
  EXPECT_EQ(checkProgram(test.link()), "");
  test.retains.resize(64, {0, kBytes});
  EXPECT_EQ(lacking(checkProgram(test.link()), {"more than 4 GB together"}), "");
}

// In a moment: the gate's time grows with the tables and not with their square, which would be minutes.
TEST(CheckProgram, FiftyThousandRungs) {
  constexpr uint32_t kCount = 50'000;
  TestProgram test;
  test.memorySize = 64 * kCount;
  std::vector<rung_range> ranges;
  for (uint32_t i = 0; i < kCount; ++i)
    ranges.push_back({i, 1, 16 * i, i % 2 == 0 ? RUNG_REPR_PACKED : RUNG_REPR_BYTE_PER_BIT});
  test.addSpace("X", 1, ranges);
  test.addPacked("Y", 1, kCount, 32 * kCount);
  static const uint8_t kByte = 1;
  for (uint32_t i = 0; i < kCount; ++i) {
    test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
    test.retains.push_back({16 * i, i % 2 == 0 ? 1u : 8u});
    test.inits.push_back({16 * i, 1, &kByte});
  }
  const uint32_t task = test.addTask("MAIN", 0);
  for (uint32_t i = 0; i < kCount; i += 2) test.addBeginCopy(task, {RUNG_COPY_ALL, 32 * kCount + i, 16 * i, 0, 1});
  EXPECT_EQ(checkProgram(test.link()), "");
}

TEST_P(CheckProgram, FindsIt) {
  TestProgram test = soundProgram();
  test.link();
  GetParam().spoil(test);
  EXPECT_EQ(lacking(checkProgram(test.program), {GetParam().message}), "");
}

// In the order of rung/program.h.
constexpr Case kCases[] = {
    {"Version", [](TestProgram& t) { t.program.abi_version = 9; }, "ABI version 9"},
    {"Size", [](TestProgram& t) { t.program.size = 8; }, "has 8 bytes"},
    {"NoName", [](TestProgram& t) { t.program.name = nullptr; }, "name, dialect or compiler is missing"},
    {"NoDialect", [](TestProgram& t) { t.program.dialect = nullptr; }, "name, dialect or compiler is missing"},
    {"NoCompiler", [](TestProgram& t) { t.program.compiler = nullptr; }, "name, dialect or compiler is missing"},
    {"Alignment", [](TestProgram& t) { t.program.memory_align = 24; }, "alignment 24, expected a power of two"},
    {"NoAlignment", [](TestProgram& t) { t.program.memory_align = 0; }, "alignment 0, expected"},
    {"LargeAlignment", [](TestProgram& t) { t.program.memory_align = 1u << 31; }, "up to 4096"},
    {"Instrumented", [](TestProgram& t) { t.program.instrumented = 2; }, "`instrumented` is 2"},
    {"MainTask", [](TestProgram& t) { t.program.main_task = 4; }, "the main task is 4, there are 1"},
    {"FastTask", [](TestProgram& t) { t.program.fast_task = 1; }, "the fast task is 1, there are 1"},
    {"NoCode", [](TestProgram& t) { t.program.chunk_fns = nullptr; }, "no code"},
    {"ManyChunks", [](TestProgram& t) { t.program.chunk_count = 0xFFFFFFFF; }, "too many chunks"},

    {"NoSpaces", [](TestProgram& t) { t.program.spaces = nullptr; }, "table of spaces is missing, it has 2"},
    {"NoSymbols", [](TestProgram& t) { t.program.symbols = nullptr; }, "table of symbols is missing"},
    {"NoInits", [](TestProgram& t) { t.program.inits = nullptr; }, "table of initial contents is missing"},
    {"NoRetains", [](TestProgram& t) { t.program.retains = nullptr; }, "table of retained spans is missing"},
    {"NoSafes", [](TestProgram& t) { t.program.safe_spans = nullptr; }, "table of safe spans is missing"},
    {"NoCopies", [](TestProgram& t) { t.program.copies = nullptr; }, "table of copies is missing"},
    {"NoChunks", [](TestProgram& t) { t.program.chunks = nullptr; }, "table of chunks is missing"},
    {"NoRungs", [](TestProgram& t) { t.program.rungs = nullptr; }, "table of rungs is missing"},
    {"NoRoutines", [](TestProgram& t) { t.program.routines = nullptr; }, "table of routines is missing"},
    {"NoFiles", [](TestProgram& t) { t.program.files = nullptr; }, "table of files is missing"},
    {"NoTasks", [](TestProgram& t) { t.program.tasks = nullptr; }, "table of tasks is missing"},
    {"NoPartEnds", [](TestProgram& t) { t.program.part_ends = nullptr; }, "table of parts is missing"},
    {"NoScan", [](TestProgram& t) { t.program.scan = nullptr; }, "table of scan steps is missing"},
    {"NoFast", [](TestProgram& t) { t.program.fast = nullptr; }, "table of fast steps is missing"},
    {"NoFaults", [](TestProgram& t) { t.program.faults = nullptr; }, "table of faults is missing"},
    {"NoServices", [](TestProgram& t) { t.program.services = nullptr; }, "table of services is missing"},
    {"NoTexts", [](TestProgram& t) { t.program.texts = nullptr; }, "table of texts is missing"},

    {"SpaceName", [](TestProgram& t) { t.spaces[1].name = nullptr; }, "space 1 has no name"},
    {"SpaceUnit", [](TestProgram& t) { t.spaces[0].unit_bytes = 3; }, "space 0 has units of 3 bytes"},
    {"SpaceUnitZero", [](TestProgram& t) { t.spaces[0].unit_bytes = 0; }, "space 0 has units of 0 bytes"},
    {"SpacePartOfUnit", [](TestProgram& t) { t.spaces[1].byte_count = 7; }, "space 1 has 7 bytes, part of a unit"},
    {"SpaceFlags", [](TestProgram& t) { t.spaces[1].flags = 16; }, "space 1 has unknown flags 16"},
    {"SpaceRanges", [](TestProgram& t) { t.spaces[1].ranges = nullptr; }, "space 1 has no table of ranges"},
    {"RangeRepr", [](TestProgram& t) { t.ranges[0][1].repr = 2; }, "space 0 has a range of unknown representation 2"},
    {"RangeOutside", [](TestProgram& t) { t.ranges[0][1].offset = 250; }, "space 0 lies outside the memory block"},
    {"RangeFarOutside", [](TestProgram& t) { t.ranges[0][1].offset = 0xFFFFFFF0; }, "space 0 lies outside"},
    {"RangeGap", [](TestProgram& t) { t.ranges[0][1].first_byte = 5; }, "space 0 has ranges that do not cover it"},
    {"RangeEmpty", [](TestProgram& t) { t.ranges[0][0].byte_count = 0; }, "space 0 has ranges that do not cover it"},
    {"SpaceShort", [](TestProgram& t) { t.spaces[0].byte_count = 9; }, "do not cover its 9 bytes"},
    {"RangesTogether", [](TestProgram& t) { t.ranges[1][0].offset = 95; }, "two ranges of spaces lie at offset 95"},

    {"SymbolName", [](TestProgram& t) { t.symbols[1].name = nullptr; }, "symbol 1 has no name"},
    {"SymbolComment", [](TestProgram& t) { t.symbols[0].comment = nullptr; }, "symbol 0 has no comment"},
    {"SymbolOrder", [](TestProgram& t) { std::swap(t.symbols[0], t.symbols[1]); }, "symbol 1 is not sorted"},
    {"SymbolType", [](TestProgram& t) { t.symbols[0].type = 0; }, "symbol 0 has the unknown type 0"},
    {"SymbolTypeAbove", [](TestProgram& t) { t.symbols[2].type = 8; }, "symbol 2 has the unknown type 8"},
    {"SymbolFlags", [](TestProgram& t) { t.symbols[0].flags = 16; }, "symbol 0 has unknown flags 16"},
    {"SymbolBit", [](TestProgram& t) { t.symbols[1].bit = 8; }, "symbol 1 begins at bit 8"},
    {"SymbolBitOfByte", [](TestProgram& t) { t.symbols[0].bit = 1; }, "symbol 0 begins at bit 1"},
    {"SymbolCount", [](TestProgram& t) { t.symbols[0].count = 0; }, "symbol 0 has no elements"},
    {"SymbolSpace", [](TestProgram& t) { t.symbols[0].space = 3; }, "symbol 0 has space 3, there are 2"},
    {"NoSlots", [](TestProgram& t) { t.program.slots = nullptr; }, "table of slots is missing"},
    {"SlotKey", [](TestProgram& t) { t.slots[0].key = nullptr; }, "slot 0 has no name"},
    {"SlotOrder", [](TestProgram& t) { std::swap(t.slots[0], t.slots[1]); }, "slot 1 is not sorted"},
    {"SlotTwice", [](TestProgram& t) { t.slots[1].key = "edge"; }, "slot 1 is not sorted"},
    {"SlotType", [](TestProgram& t) { t.slots[0].type = 9; }, "slot 0 has the unknown type 9"},
    {"SlotText", [](TestProgram& t) { t.slots[0].type = RUNG_TYPE_TEXT; }, "slot 0 has the unknown type 7"},
    {"SlotOutside", [](TestProgram& t) { t.slots[1].offset = 250; }, "slot 1 lies outside the memory block"},
    {"SlotRung", [](TestProgram& t) { t.slots[0].rung = 2; }, "slot 0 has rung 2, there are 2"},
    {"SlotInSpace", [](TestProgram& t) { t.slots[0].offset = 131; }, "slot 0 lies in a space"},
    {"SlotReachesSpace", [](TestProgram& t) { t.slots[1].offset = 57; }, "slot 1 lies in a space"},
    {"SlotsTogether", [](TestProgram& t) { t.slots[0].offset = 47; }, "two slots lie at offset 47"},
    {"NoContinuations", [](TestProgram& t) { t.program.continuations = nullptr; }, "table of continuations is missing"},
    {"ContinuationKey", [](TestProgram& t) { t.continuations[1].key = nullptr; }, "continuation 1 has no name"},
    {"ContinuationOrder", [](TestProgram& t) { t.continuations[1].key = "A"; }, "continuation 1 is not sorted"},
    {"ContinuationOutside", [](TestProgram& t) { t.continuations[0].offset = 253; }, "continuation 0 lies outside"},
    {"ContinuationEmpty", [](TestProgram& t) { t.continuations[0].point_count = 0; }, "continuation 0 has no points"},
    {"ContinuationPoint", [](TestProgram& t) { t.points[0][1] = nullptr; }, "continuation 0 has a point without a key"},

    {"NoTimers", [](TestProgram& t) { t.program.timers = nullptr; }, "table of timers is missing"},
    {"TimerName", [](TestProgram& t) { t.timers[0].name = nullptr; }, "timer 0 has no name"},
    {"TimerFlags", [](TestProgram& t) { t.timers[0].flags = 4; }, "timer 0 has unknown flags 4"},
    {"TimerRung", [](TestProgram& t) { t.timers[0].rung = 99; }, "timer 0 has rung 99"},
    {"TimerUnits", [](TestProgram& t) { t.timers[0].unit_count = 0; }, "timer 0 has no units"},
    {"TimerNoUnits", [](TestProgram& t) { t.timers[0].units = nullptr; }, "timer 0 has no units"},
    {"TimerTime", [](TestProgram& t) { t.timers[0].time_type = 0; }, "timer 0 has no time"},
    {"TimerBit", [](TestProgram& t) { t.timers[0].time_type = RUNG_TYPE_BIT; }, "timer 0 has a cell of type 1"},
    {"TimerOutside", [](TestProgram& t) { t.timers[0].time_at = 249; }, "timer 0 lies outside the memory block"},
    {"TimerRunning", [](TestProgram& t) { t.timers[0].running_at = 256; }, "timer 0 lies outside the memory block"},
    {"TimerSpace", [](TestProgram& t) { t.timers[0].preset_type = RUNG_TYPE_I16, t.timers[0].preset_space = 2; },
     "timer 0 has space 2"},
    {"TimerSpaceEnd", [](TestProgram& t) { t.timers[0].unit_type = RUNG_TYPE_I16, t.timers[0].unit_at = 7; },
     "timer 0 has a cell outside space 0"},

    {"SymbolByte", [](TestProgram& t) { t.symbols[0].byte = 8; }, "symbol 0 lies outside space 0"},
    {"SymbolLong", [](TestProgram& t) { t.symbols[0].count = 0xFFFFFFFF; }, "symbol 0 lies outside space 0"},
    {"SymbolBits", [](TestProgram& t) { t.symbols[1].count = 46; }, "symbol 1 lies outside space 0"},

    {"Init", [](TestProgram& t) { t.inits[0].size = 300; }, "initial contents 0 lies outside"},
    {"InitData", [](TestProgram& t) { t.inits[0].data = nullptr; }, "initial contents 0 has no data"},
    {"InitOfBits", [](TestProgram& t) { t.inits[1].size = 9; }, "initial contents 1 has 2 for a bit"},
    {"Retain", [](TestProgram& t) { t.retains[0].offset = 254; }, "retained span 0 lies outside the memory block"},
    {"RetainNoSpace", [](TestProgram& t) { t.retains[0].offset = 2; }, "retained span 0 lies outside the spaces"},
    {"RetainBits", [](TestProgram& t) { t.retains[1].size = 15; }, "retained span 1 begins or ends within a byte"},
    {"RetainMidst", [](TestProgram& t) { t.retains[1].offset = 76; }, "retained span 1 begins or ends within a byte"},
    {"Safe", [](TestProgram& t) { t.safeSpans[0].offset = 0xFFFFFFFF; }, "safe span 0 lies outside"},

    {"CopyKind", [](TestProgram& t) { t.copies[0].kind = 2; }, "copy 0 has the unknown kind 2"},
    {"CopyFrom", [](TestProgram& t) { t.copies[0].from = 3; },
     "copy 0 has a `from` that does not lie in ranges of one representation"},
    {"CopyTo", [](TestProgram& t) { t.copies[0].to = 255; },
     "copy 0 has a `to` that does not lie in ranges of one representation"},
    {"CopyMask", [](TestProgram& t) { t.copies[0].mask = 0xFFFF0000; },
     "copy 0 has a `mask` that does not lie in ranges of one representation"},
    {"CopySize", [](TestProgram& t) { t.copies[0].size = 0xFFFFFFFF; }, "copy 0 has a `from`"},
    {"CopyRepr", [](TestProgram& t) { t.copies[1].from = 128; }, "copy 1 is between different representations"},
    {"CopyMaskRepr", [](TestProgram& t) { t.copies[0].mask = 64; }, "copy 0 is between different representations"},
    {"CopyOverlap", [](TestProgram& t) { t.copies[1].to = 71; }, "copy 1 overlaps itself"},
    {"CopyMaskOverlap", [](TestProgram& t) { t.copies[0].mask = 129; }, "copy 0 overlaps itself"},
    {"CopyMaskOfItself", [](TestProgram& t) { t.copies[0].mask = 1; }, "copy 0 overlaps itself"},

    {"ChunkRungs", [](TestProgram& t) { t.chunks[0].rung_count = 3; }, "chunk 0 has 3 rungs, there are 2"},
    {"ChunkFirstRung", [](TestProgram& t) { t.chunks[1].first_rung = 2; }, "chunk 1 has first rung 2, there are 2"},
    {"ChunkEmpty", [](TestProgram& t) { t.chunks[1].rung_count = 0; }, "chunk 1 has no rungs"},
    {"ChunkWeight", [](TestProgram& t) { t.chunks[1].weight = 0; }, "chunk 1 has weight 0"},
    {"ChunkCode", [](TestProgram& t) { t.functions[1] = nullptr; }, "chunk 1 has no code"},
    {"ChangesMany", [](TestProgram& t) { t.addChanges(0, std::vector<uint32_t>(RUNG_MOST_CHANGES + 1, 0)), t.link(); },
     "task 0 has too many changes"},
    {"ChangesPlace", [](TestProgram& t) { t.addChanges(0, {t.memorySize - 7}), t.link(); },
     "change 0 lies outside the memory block"},
    {"RungTitle", [](TestProgram& t) { t.rungs[1].title = nullptr; }, "rung 1 has no title"},
    {"RungFile", [](TestProgram& t) { t.rungs[0].file = 1; }, "rung 0 has file 1, there are 1"},
    {"RungLines", [](TestProgram& t) { t.rungs[1].last_line = 19; }, "rung 1 ends before it begins, in line 19"},
    {"RungRoutine", [](TestProgram& t) { t.rungs[0].routine = 1; }, "rung 0 has routine 1, there are 1"},

    {"TaskName", [](TestProgram& t) { t.tasks[0].name = nullptr; }, "task 0 has no name"},
    {"TaskEntry", [](TestProgram& t) { t.tasks[0].entry = 2; }, "task 0 has entry 2, there are 2"},
    {"TaskLoopFree", [](TestProgram& t) { t.tasks[0].loop_free_chunk = 2; },
     "task 0 has loop-free chunk 2, there are 2"},
    {"TaskBudget", [](TestProgram& t) { t.tasks[0].budget = (1u << 26) + 1; },
     "task 0 has too large a budget: 67108865"},
    {"TaskFault", [](TestProgram& t) { t.tasks[0].budget_fault = RUNG_NONE; }, "task 0 has budget fault"},
    {"TaskBegin", [](TestProgram& t) { t.tasks[0].begin_count = 3; }, "task 0 has begin copies 0 + 3, there are 2"},
    {"TaskEnd", [](TestProgram& t) { t.tasks[0].end_first = 3; }, "task 0 has end copies 3 + 0, there are 2"},
    {"TaskParts", [](TestProgram& t) { t.tasks[0].part_first = 1; }, "task 0 has parts 1 + 2, there are 2"},
    {"TaskNoParts", [](TestProgram& t) { t.tasks[0].part_count = 0; }, "task 0 has no parts"},
    {"PartChunk", [](TestProgram& t) { t.partEnds[0] = 2; }, "task 0 has a part that ends before chunk 2, there are 2"},
    {"PartOrder", [](TestProgram& t) { std::swap(t.partEnds[0], t.partEnds[1]); }, "not in order: chunk 1"},
    {"PartLast", [](TestProgram& t) { t.partEnds[1] = 1; }, "task 0 has a last part that does not end with the run"},
    {"StepOp", [](TestProgram& t) { t.fast[0].op = 9; }, "fast step 0 has the unknown operation 9"},
    {"StepTask", [](TestProgram& t) { t.scan[0].task = 1; }, "scan step 0 has task 1, there are 1"},
    {"SlicesOfAnotherTime",
     [](TestProgram& t) {
       static constexpr rung_step kSlices[] = {{RUNG_STEP_ADVANCE, RUNG_NONE, 7}};
       t.program.slices = kSlices;
       t.program.slice_count = 1;
     },
     "the slices take 7 us, a scan 0"},
    {"SliceWithoutTask",
     [](TestProgram& t) {
       static constexpr rung_step kSlices[] = {{RUNG_STEP_RUN, 9, 1}};
       t.program.slices = kSlices;
       t.program.slice_count = 1;
     },
     "slice step 0"},
    {"NoTime", [](TestProgram& t) { t.tasks[0].period_us = 0; }, "the scan list takes no time"},

    {"NoRoutine", [](TestProgram& t) { t.routines[0] = nullptr; }, "routine 0 is missing"},
    {"NoFile", [](TestProgram& t) { t.files[0] = nullptr; }, "file 0 is missing"},
    {"NoFault", [](TestProgram& t) { t.faults[1] = nullptr; }, "fault 1 is missing"},
    {"NoService", [](TestProgram& t) { t.services[1] = nullptr; }, "service 1 is missing"},
    {"NoText", [](TestProgram& t) { t.texts[1].text = nullptr; }, "text 1 is missing"},
};

INSTANTIATE_TEST_SUITE_P(All, CheckProgram, testing::ValuesIn(kCases),
                         [](const auto& tested) { return tested.param.name; });

} // namespace
