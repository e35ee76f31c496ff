// What a new program finds of the old one's state.
#include "rtlib/change/state_transfer.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "rtlib/load/program_info.h"
#include "rtlib/load/ref.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung;
using runtime::StateChange;
using runtime::StateTransfer;
using test::TestProgram;

// A program with its memory.
struct Running {
  TestProgram program;
  std::vector<uint8_t> block;

  core::Memory memory() { return {program.program, block.data()}; }
  uint64_t read(const char* name) {
    return runtime::readRaw(memory(), runtime::refOf(*runtime::findSymbol(program.program, name)));
  }
  void write(const char* name, uint64_t value) {
    runtime::writeRaw(memory(), runtime::refOf(*runtime::findSymbol(program.program, name)), value);
  }
  // Initial contents: every byte of the block is `fill`.
  void start(uint8_t fill = 0) {
    program.memorySize = 1024;
    EXPECT_EQ(runtime::checkProgram(program.link()), "");
    block.assign(program.memorySize, fill);
  }
};

// D packed, R as bits, Y for the machine, X from it.
void addSpaces(TestProgram& program) {
  program.addPacked("D", 1, 32, 64);
  program.addSpace("R", 1, {{0, 8, 128, RUNG_REPR_BYTE_PER_BIT}});
  program.addSpace("X", 1, {{0, 4, 256, RUNG_REPR_PACKED}}, RUNG_SPACE_INPUT);
  program.addTask("MAIN",
                  program.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }));
}
constexpr uint32_t kD = 0, kR = 1, kX = 2;

class Transfer : public testing::Test {
protected:
  void SetUp() override {
    addSpaces(old.program);
    addSpaces(fresh.program);
  }
  // Runs the plan; kept, moved and so on, each "kind name".
  std::set<std::string> run(const runtime::Naming& naming = {}) {
    const StateTransfer plan(old.program.program, fresh.program.program, naming);
    plan.run(old.block.data(), fresh.block.data());
    std::set<std::string> lines;
    for (const StateChange& change : plan.changes()) {
      static constexpr const char* kWords[] = {"new", "removed", "moved", "renamed", "retyped", "released", "cut"};
      lines.insert(kWords[static_cast<int>(change.kind)] + std::string(change.slot ? " slot " : " ") + change.name +
                   (change.formerName.empty() ? "" : " from " + change.formerName));
    }
    kept = plan.keptCells();
    keptSlots = plan.keptSlots();
    return lines;
  }
  using Lines = std::set<std::string>;

  Running old, fresh;
  uint32_t kept = 0;
  uint32_t keptSlots = 0;
};

TEST_F(Transfer, CellsKeepTheirContentsByAddress) {
  old.program.addSymbol("COUNT", kD, 4, RUNG_TYPE_I32);
  fresh.program.addSymbol("COUNT", kD, 4, RUNG_TYPE_I32);
  old.start();
  fresh.start();
  old.write("COUNT", 70000);
  old.memory().writeBit(kR, 3, 5, true);
  EXPECT_EQ(run(), Lines());
  EXPECT_EQ(fresh.read("COUNT"), 70000u);
  EXPECT_TRUE(fresh.memory().readBit(kR, 3, 5));
  EXPECT_EQ(kept, 1u);
}

TEST_F(Transfer, ANameTakesItsContentsAlong) {
  old.program.addSymbol("A", kD, 4, RUNG_TYPE_I16);
  old.program.addSymbol("LAMP", kR, 1, RUNG_TYPE_BIT, 2);
  fresh.program.addSymbol("A", kD, 9, RUNG_TYPE_I16);
  fresh.program.addSymbol("LAMP", kD, 30, RUNG_TYPE_BIT, 7); // another space, another representation
  old.start();
  fresh.start();
  old.write("A", 0x1234);
  old.write("LAMP", 1);
  EXPECT_EQ(run(), (Lines{"moved A", "moved LAMP"}));
  EXPECT_EQ(fresh.read("A"), 0x1234u);
  EXPECT_EQ(fresh.read("LAMP"), 1u);
  EXPECT_EQ(fresh.memory().readByte(kD, 4), 0) << "its former place starts anew";
  EXPECT_FALSE(fresh.memory().readBit(kR, 1, 2));
}

// NCT has all of its words in one area, those of the NC and the program's own.
TEST_F(Transfer, InAnAreaOfInputsAndOutputsNamesGoAsInMemory) {
  const uint32_t both = RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT;
  const uint32_t area = old.program.addSpace("M", 4, {{0, 16, 512, RUNG_REPR_PACKED}}, both);
  fresh.program.addSpace("M", 4, {{0, 16, 512, RUNG_REPR_PACKED}}, both);
  old.program.addSymbol("TIME", area, 0, RUNG_TYPE_I32);
  fresh.program.addSymbol("TIME", area, 8, RUNG_TYPE_I32);
  old.start();
  fresh.start();
  old.write("TIME", 1200);
  EXPECT_EQ(run(), Lines{"moved TIME"});
  EXPECT_EQ(fresh.read("TIME"), 1200u);
  EXPECT_EQ(fresh.memory().readByte(area, 0), 0) << "its former place starts anew";
}

TEST_F(Transfer, WhatLiesInThePlaceOfANameThatStaysBelongsToIt) {
  old.program.addSymbol("WIDE", kD, 0, RUNG_TYPE_I16);
  old.program.addSymbol("LIST", kD, 4, RUNG_TYPE_I8, 0, 2);
  for (Running* program : {&old, &fresh}) {
    program->program.addSymbol("STAYS", kD, 10, RUNG_TYPE_I8);
    program->program.addSymbol("BIT", kD, 21, RUNG_TYPE_BIT, 7);
  }
  fresh.program.addSymbol("WIDE", kD, 10, RUNG_TYPE_I16);
  fresh.program.addSymbol("LIST", kD, 20, RUNG_TYPE_I8, 0, 2);
  old.start();
  fresh.start();
  old.write("WIDE", 0x1234);
  old.memory().writeByte(kD, 5, 0xFF);
  old.write("STAYS", 5);
  EXPECT_EQ(run(), (Lines{"cut LIST", "cut WIDE"}));
  EXPECT_EQ(fresh.read("STAYS"), 5u);
  EXPECT_EQ(fresh.read("WIDE"), 5u) << "no half of it";
  EXPECT_EQ(fresh.memory().readByte(kD, 21), 0x7F);
}

TEST_F(Transfer, WhereAnAreaBeginsItsNameKeepsNothing) {
  old.program.addSymbol("FIRST", kD, 10, RUNG_TYPE_I32);
  fresh.program.addSymbol("FIRST", kD, 4, RUNG_TYPE_I32);
  for (Running* program : {&old, &fresh}) {
    program->program.addSymbol("AREA", kD, 4, RUNG_TYPE_I32);
    program->program.symbols.back().flags = RUNG_SYMBOL_AREA;
  }
  old.start();
  fresh.start();
  old.write("FIRST", 111);
  EXPECT_EQ(run(), Lines{"moved FIRST"});
  EXPECT_EQ(fresh.read("FIRST"), 111u);
}

TEST_F(Transfer, AVariableThatIsPutBetweenOthersIsNew) {
  old.program.addSymbol("A", kD, 0, RUNG_TYPE_I32);
  old.program.addSymbol("B", kD, 4, RUNG_TYPE_I32);
  fresh.program.addSymbol("A", kD, 0, RUNG_TYPE_I32);
  fresh.program.addSymbol("MIDDLE", kD, 4, RUNG_TYPE_I32);
  fresh.program.addSymbol("B", kD, 8, RUNG_TYPE_I32);
  old.start();
  fresh.start();
  fresh.write("MIDDLE", 5); // its initial contents
  old.write("A", 1);
  old.write("B", 2);
  EXPECT_EQ(run(), (Lines{"moved B", "new MIDDLE"}));
  EXPECT_EQ(fresh.read("A"), 1u);
  EXPECT_EQ(fresh.read("MIDDLE"), 5u);
  EXPECT_EQ(fresh.read("B"), 2u);
}

TEST_F(Transfer, ACellWithAnotherNameKeepsItsContents) {
  old.program.addSymbol("CLAMP", kD, 4, RUNG_TYPE_I16);
  old.program.addSymbol("GONE", kD, 8, RUNG_TYPE_I16);
  fresh.program.addSymbol("CHUCK", kD, 4, RUNG_TYPE_I16);
  fresh.program.addSymbol("FIRST", kD, 12, RUNG_TYPE_I16); // had no name
  old.start();
  fresh.start();
  old.write("CLAMP", 3);
  old.memory().writeByte(kD, 12, 9);
  EXPECT_EQ(run(), (Lines{"renamed CHUCK from CLAMP", "removed GONE"}));
  EXPECT_EQ(fresh.read("CHUCK"), 3u);
  EXPECT_EQ(fresh.read("FIRST"), 9u);
}

TEST_F(Transfer, AnotherTypeStartsAnew) {
  old.program.addSymbol("N", kD, 4, RUNG_TYPE_I16);
  old.program.addSymbol("OTHER", kD, 8, RUNG_TYPE_I16);
  fresh.program.addSymbol("N", kD, 4, RUNG_TYPE_I32);
  fresh.program.addSymbol("NEW", kD, 8, RUNG_TYPE_I8); // where a cell of another extent was, which is gone
  old.start();
  fresh.start();
  old.write("N", 77);
  old.write("OTHER", 0xFFFF);
  EXPECT_EQ(run(), (Lines{"retyped N", "new NEW", "removed OTHER"}));
  EXPECT_EQ(fresh.read("N"), 0u);
  EXPECT_EQ(fresh.read("NEW"), 0u);
}

TEST_F(Transfer, ArraysKeepWhatFits) {
  old.program.addSymbol("LONGER", kD, 0, RUNG_TYPE_I16, 0, 2);
  old.program.addSymbol("SHORTER", kD, 8, RUNG_TYPE_TEXT, 0, 8);
  fresh.program.addSymbol("LONGER", kD, 0, RUNG_TYPE_I16, 0, 3);
  fresh.program.addSymbol("SHORTER", kD, 8, RUNG_TYPE_TEXT, 0, 2);
  old.start();
  fresh.start();
  for (uint32_t i = 0; i < 16; ++i) old.memory().writeByte(kD, i, static_cast<uint8_t>(i + 1));
  EXPECT_EQ(run(), (Lines{"moved LONGER", "moved SHORTER"}));
  const uint8_t wanted[] = {1, 2, 3, 4, 0, 0, 7, 8, 9, 10, 0};
  for (uint32_t i = 0; i < std::size(wanted); ++i) EXPECT_EQ(fresh.memory().readByte(kD, i), wanted[i]) << i;
}

// Y lies at 512 (a byte a bit) and IMAGE, which is copied to it, at 640; LATCH is not an output.
void addOutputs(TestProgram& program, std::vector<rung_written> writes) {
  const uint32_t y = program.addSpace("Y", 1, {{0, 4, 512, RUNG_REPR_BYTE_PER_BIT}}, RUNG_SPACE_OUTPUT);
  const uint32_t image = program.addSpace("IMAGE", 1, {{0, 4, 640, RUNG_REPR_BYTE_PER_BIT}}, RUNG_SPACE_HIDDEN);
  program.addPacked("LATCH", 1, 4, 768);
  program.addSymbol("COOLANT", y, 1, RUNG_TYPE_BIT, 2);
  program.addSymbol("LAMP", y, 1, RUNG_TYPE_BIT, 3);
  program.addSymbol("HIDDEN_LAMP", image, 1, RUNG_TYPE_BIT, 3);
  program.addEndCopy(0, {RUNG_COPY_ALL, 640, 512, 0, 32});
  program.writes = std::move(writes);
}

TEST_F(Transfer, WhatIsNoLongerWrittenIsReleased) {
  addOutputs(old.program,
             {{640, 1, 255}, {650, 2, 255}, {656, 8, 255}, {768, 4, 255}}); // IMAGE+0.0, 1.2, 1.3, byte 2; LATCH
  addOutputs(fresh.program, {{650, 1, 255}});                               // IMAGE+1.2
  old.start(1);
  fresh.start();
  EXPECT_EQ(run(), (Lines{"released LAMP", "released Y+0.0", "released Y+2"}));
  EXPECT_EQ(fresh.read("COOLANT"), 1u);
  EXPECT_EQ(fresh.read("LAMP"), 0u);
  EXPECT_EQ(fresh.read("HIDDEN_LAMP"), 0u) << "else it would come again";
  EXPECT_EQ(fresh.memory().readByte(3, 0), 0xFE) << "the host's own";
  EXPECT_EQ(fresh.memory().readByte(3, 2), 0);
  EXPECT_EQ(fresh.memory().readByte(5, 0), 1) << "no output";
}

TEST_F(Transfer, ABitOfAByteIsReleased) {
  for (Running* side : {&old, &fresh})
    side->program.addSpace("Y", 1, {{0, 2, 512, RUNG_REPR_PACKED}}, RUNG_SPACE_OUTPUT);
  old.program.writes = {{512, 1, 0x3C}, {513, 1, 255}};
  fresh.program.writes = {{512, 1, 0x0C}};
  old.start();
  fresh.start();
  old.memory().write(3, 0, 2, 0xFFFF);
  EXPECT_EQ(run(), (Lines{"released Y+0.4", "released Y+0.5", "released Y+1"}));
  EXPECT_EQ(fresh.memory().read(3, 0, 2), 0x00CFu);
}

TEST_F(Transfer, TwoNamesOfOneCellDoNotMoveIt) {
  old.program.addSymbol("A", kD, 4, RUNG_TYPE_I8);
  old.program.addSymbol("B", kD, 4, RUNG_TYPE_I8);
  fresh.program.addSymbol("A", kD, 4, RUNG_TYPE_I8);
  fresh.program.addSymbol("B", kD, 5, RUNG_TYPE_I8);
  fresh.program.addSymbol("C", kD, 4, RUNG_TYPE_I8); // one more
  old.start();
  fresh.start();
  old.write("A", 6);
  EXPECT_EQ(run(), Lines{"moved B"});
  EXPECT_EQ(fresh.read("A"), 6u);
  EXPECT_EQ(fresh.read("B"), 6u);
  EXPECT_EQ(fresh.read("C"), 6u);
}

TEST_F(Transfer, WhereCaseDoesNotCountANameIsFoundInEitherCase) {
  old.program.addSymbol("Count", kD, 4, RUNG_TYPE_I16);
  old.program.addSymbol("Lamp", kR, 1, RUNG_TYPE_BIT, 2);
  fresh.program.addSymbol("COUNT", kD, 8, RUNG_TYPE_I16);
  fresh.program.addSymbol("lamp", kR, 1, RUNG_TYPE_BIT, 2);
  old.start();
  fresh.start();
  old.write("Count", 7);
  EXPECT_EQ(run({.ignoresCase = true}), Lines{"moved COUNT"});
  EXPECT_EQ(fresh.read("COUNT"), 7u);
  EXPECT_EQ(kept, 1u);
  EXPECT_EQ(run(), (Lines{"removed Count", "renamed lamp from Lamp"})) << "where it counts";
}

TEST_F(Transfer, RetainedContentsWithoutAPlaceAreLost) {
  old.program.addSpace("K", 1, {{0, 4, 512, RUNG_REPR_PACKED}, {4, 4, 520, RUNG_REPR_BYTE_PER_BIT}});
  old.program.addPacked("C", 1, 2, 600);
  old.program.retains = {{64 + 4, 12}, {512, 4}, {520, 32}, {600, 2}};
  old.program.addSymbol("MOVES", 3, 3, RUNG_TYPE_I16);
  old.program.addSymbol("GOES", 3, 6, RUNG_TYPE_I8);
  fresh.program.addPacked("K", 1, 2, 512);
  fresh.program.retains = {{64 + 6, 2}, {64 + 12, 4}, {512, 2}};
  fresh.program.addSymbol("MOVES", kD, 14, RUNG_TYPE_I16);
  old.start();
  fresh.start();
  EXPECT_EQ(run(), (Lines{"moved MOVES", "removed C+0 to C+1", "removed D+4 to D+5", "removed D+8 to D+11",
                          "removed GOES", "removed K+2", "removed K+5 to K+7"}))
      << "K+3 and K+4 go with a name to what is retained";
}

TEST_F(Transfer, WhatTheCompilerPlacedIsKnownByItsName) {
  for (Running* side : {&old, &fresh}) side->program.spaces[kD].flags = RUNG_SPACE_ALLOCATED;
  old.program.addSymbol("A", kD, 0, RUNG_TYPE_I8);
  old.program.addSymbol("GONE", kD, 2, RUNG_TYPE_I8);
  fresh.program.addSymbol("A", kD, 0, RUNG_TYPE_I8);
  fresh.program.addSymbol("INSTEAD", kD, 2, RUNG_TYPE_I8);
  old.start();
  fresh.start();
  for (uint32_t i = 0; i < 4; ++i) old.memory().writeByte(kD, i, 7);
  EXPECT_EQ(run(), (Lines{"new INSTEAD", "removed GONE"}));
  const uint8_t wanted[] = {7, 0, 0, 0};
  for (uint32_t i = 0; i < std::size(wanted); ++i) EXPECT_EQ(fresh.memory().readByte(kD, i), wanted[i]) << i;
}

TEST_F(Transfer, ANewNameOfACellThatMovedHasItsContents) {
  old.program.addSymbol("Z", kD, 0, RUNG_TYPE_I8);
  fresh.program.addSymbol("Z", kD, 4, RUNG_TYPE_I8);
  fresh.program.addSymbol("A", kD, 4, RUNG_TYPE_I8);
  old.start();
  fresh.start();
  old.write("Z", 7);
  run();
  EXPECT_EQ(fresh.read("A"), 7u);
}

TEST_F(Transfer, InputsAreTheMachines) {
  old.program.addSymbol("DOOR", kX, 1, RUNG_TYPE_BIT, 0);
  fresh.program.addSymbol("DOOR", kX, 1, RUNG_TYPE_BIT, 1);
  old.start();
  fresh.start();
  old.write("DOOR", 1);
  EXPECT_EQ(run(), Lines());
  EXPECT_EQ(fresh.memory().readByte(kX, 1), 1);
}

// Where machine and program write one space, the inputs are what a task copies over it.
TEST_F(Transfer, InputsOfASharedSpaceAreWhatIsCopiedOverThem) {
  for (Running* one : {&old, &fresh}) {
    constexpr uint32_t kBoth = RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT;
    one->program.addSpace("M", 1, {{0, 32, 320, RUNG_REPR_PACKED}}, kBoth);
    one->program.addSpace("TS", 1, {{0, 16, 384, RUNG_REPR_PACKED}}, kBoth);
    one->program.addBeginCopy(0, {RUNG_COPY_ALL, 384, 320, 0, 16});
  }
  constexpr uint32_t kM = 3;
  old.program.addSymbol("DOOR", kM, 1, RUNG_TYPE_I8);
  old.program.addSymbol("COUNT", kM, 20, RUNG_TYPE_I8);
  fresh.program.addSymbol("DOOR", kM, 2, RUNG_TYPE_I8);
  fresh.program.addSymbol("COUNT", kM, 30, RUNG_TYPE_I8);
  old.start();
  fresh.start();
  old.write("DOOR", 5);
  old.write("COUNT", 7);
  EXPECT_EQ(run(), Lines({"moved COUNT"}));
  EXPECT_EQ(fresh.read("COUNT"), 7u);
  EXPECT_EQ(fresh.memory().readByte(kM, 20), 0) << "where it was";
  EXPECT_EQ(fresh.memory().readByte(kM, 1), 5) << "by address";
  EXPECT_EQ(fresh.read("DOOR"), 0u);
}

TEST_F(Transfer, SlotsAreFoundByTheirKeys) {
  old.program.addSlot("MAIN/TON T1/since", 0, RUNG_TYPE_I64);
  old.program.addSlot("MAIN/edge X1", 8, RUNG_TYPE_BIT);
  old.program.addSlot("MAIN/state", 9, RUNG_TYPE_I8);
  fresh.program.addSlot("MAIN/TON T1/since", 8, RUNG_TYPE_I64);
  fresh.program.addSlot("MAIN/edge X2", 1, RUNG_TYPE_BIT);
  fresh.program.addSlot("MAIN/state", 2, RUNG_TYPE_I16);
  old.start();
  fresh.start();
  old.block[3] = 17;
  old.block[8] = 1;
  old.block[9] = 4;
  EXPECT_EQ(run(), (Lines{"removed slot MAIN/edge X1", "new slot MAIN/edge X2", "retyped slot MAIN/state"}));
  EXPECT_EQ(keptSlots, 1u);
  EXPECT_EQ(fresh.block[11], 17);
  EXPECT_EQ(fresh.block[1], 0);
  EXPECT_EQ(fresh.block[2], 0);
}

// Two instructions share @lock, the bit at 16.
TEST_F(Transfer, WhatAnInstructionThatIsGoneHasHeldIsFree) {
  for (TestProgram* program : {&old.program, &fresh.program}) {
    program->addSlot("@lock", 16, RUNG_TYPE_BIT);
    program->addSlot("MAIN/A/state@lock", 2, RUNG_TYPE_I8);
  }
  old.program.addSlot("MAIN/B D@1/state@lock", 4, RUNG_TYPE_I16);
  old.program.addSlot("MAIN/B/state@other", 6, RUNG_TYPE_I8); // nobody shares that
  old.start();
  fresh.start();
  const auto locked = [&](uint8_t a, uint8_t b) {
    old.block[2] = a;
    old.block[5] = b;
    old.block[6] = 1;
    old.block[16] = 1;
    run();
    return fresh.block[16];
  };
  EXPECT_EQ(locked(1, 0), 1) << "it is A that holds it";
  EXPECT_EQ(locked(0, 1), 0);
}

TEST_F(Transfer, MechanismsContinueAtTheSameInstruction) {
  old.program.addContinuation("DOOR", 0, {"beginning", "open", "wait", "close"});
  old.program.addContinuation("GONE", 4, {"beginning", "on"});
  fresh.program.addContinuation("DOOR", 8, {"beginning", "lock", "open", "close"});
  old.start();
  fresh.start();
  const auto waiting = [&](uint8_t door, uint8_t gone) {
    old.block[0] = door;
    old.block[4] = gone;
    const char* key = StateTransfer(old.program.program, fresh.program.program).waiting(old.block.data());
    return std::string(key == nullptr ? "" : key);
  };
  EXPECT_EQ(waiting(2, 0), "DOOR");
  EXPECT_EQ(waiting(9, 0), "DOOR") << "a number without meaning";
  EXPECT_EQ(waiting(0, 1), "GONE");
  EXPECT_EQ(waiting(0, 0), "");
  EXPECT_EQ(waiting(3, 0), "");
  EXPECT_EQ(run(), Lines{"removed slot DOOR: wait"});
  EXPECT_EQ(fresh.block[8], 3);
  old.block[0] = 1;
  run();
  EXPECT_EQ(fresh.block[8], 2);
}

// Spaces of random ranges, and bits and words with names at random places.
void addRandom(TestProgram& program, std::mt19937& random) {
  const auto below = [&](uint32_t limit) { return static_cast<uint32_t>(random() % limit); };
  uint32_t offset = 64;
  std::vector<uint32_t> bytes;
  for (const char* name : {"A", "B"}) {
    std::vector<rung_range> ranges;
    uint32_t byte = 0;
    for (uint32_t i = 0; i < 1 + below(4); ++i) {
      const uint32_t repr = below(2);
      const uint32_t count = 1 + below(12);
      ranges.push_back({byte, count, offset, repr});
      byte += count;
      offset += (repr == RUNG_REPR_PACKED ? 1 : 8) * count + below(2);
    }
    bytes.push_back(byte);
    program.addSpace(name, 1, ranges);
  }
  for (const char* name : {"S0", "S1", "S2", "S3", "S4", "S5"}) {
    if (below(4) == 0) continue;
    const uint32_t space = below(2);
    const bool word = below(3) == 0 && bytes[space] >= 2;
    const uint32_t byte = below(bytes[space] - (word ? 1 : 0));
    program.addSymbol(name, space, byte, word ? RUNG_TYPE_I16 : RUNG_TYPE_BIT, word ? 0 : below(8));
  }
}

// Held to the rules alone, bit by bit: a name that is in both programs, alone in its place, has its value; a bit that
// never had a name has the value of its address.
TEST(TransferProperty, EveryBitIsWhereTheRulesSay) {
  std::mt19937 random(20261123);
  uint32_t named = 0;
  uint32_t bare = 0;
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE(round);
    Running old, fresh;
    for (Running* side : {&old, &fresh}) {
      addRandom(side->program, random);
      side->program.memorySize = 2048;
      side->program.link();
      side->block.assign(2048, 0);
    }
    for (uint32_t s = 0; s < 2; ++s)
      for (uint32_t b = 0; b < old.program.spaces[s].byte_count; ++b)
        old.memory().writeByte(s, b, static_cast<uint8_t>(random()));
    const StateTransfer plan(old.program.program, fresh.program.program);
    plan.run(old.block.data(), fresh.block.data());

    std::map<std::tuple<uint32_t, uint32_t>, int> names; // of the new program, by space and bit
    std::set<std::tuple<uint32_t, uint32_t>> touched;    // bits that had or have a name
    const auto eachBit = [](const rung_symbol& symbol, auto visit) {
      for (uint32_t b = 0; b < (symbol.type == RUNG_TYPE_BIT ? 1u : 16u); ++b)
        visit(std::tuple(symbol.space, 8 * symbol.byte + symbol.bit + b));
    };
    for (const rung_symbol& symbol : fresh.program.symbols)
      eachBit(symbol, [&](auto bit) { ++names[bit], touched.insert(bit); });
    for (const rung_symbol& symbol : old.program.symbols) eachBit(symbol, [&](auto bit) { touched.insert(bit); });
    for (const rung_symbol& symbol : fresh.program.symbols) {
      const rung_symbol* former = runtime::findSymbol(old.program.program, symbol.name);
      bool alone = true;
      eachBit(symbol, [&](auto bit) { alone = alone && names[bit] == 1; });
      if (former == nullptr || former->type != symbol.type || !alone) continue;
      ++named;
      EXPECT_EQ(fresh.read(symbol.name), old.read(symbol.name)) << symbol.name;
    }
    for (uint32_t s = 0; s < 2; ++s)
      for (uint32_t b = 0; b < 8 * fresh.program.spaces[s].byte_count; ++b) {
        if (touched.contains({s, b})) continue;
        ++bare;
        const bool there = b < 8 * old.program.spaces[s].byte_count;
        EXPECT_EQ(fresh.memory().readBit(s, b / 8, b % 8), there && old.memory().readBit(s, b / 8, b % 8));
      }
  }
  EXPECT_GT(named, 1000u);
  EXPECT_GT(bare, 10000u);
}

} // namespace
