// Functions as blocks of the part program (man. l.2682-2711, 6682-6968, 6978-7136), with compiled block modules.
#include "rtlib/nc/control/technol/technol_functions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/technol/with_control.h"

namespace rung::nc {
namespace {

using ::testing::Optional;

constexpr FunctionKind M = FunctionKind::M, S = FunctionKind::S, T = FunctionKind::T, B = FunctionKind::B,
                       H = FunctionKind::H;

// MODULE_BLOCK_INIT counts in INITS and waits for GO, or for the central annulment; MODULE_BLOCK_DONE counts in DONES
// and waits for GO2.
constexpr const char* kData =
    "        DFM  GO,GO2,PRESSED,,,,,\nINITS:  DS 2\nDONES:  DS 2\nCAS:    DS 2\nCOMMAND: DS 4\n";
constexpr const char* kMain =
    "        PROC_BEGIN _ON_CMD\n        WR   PRESSED\n        STO  DWRD.COMMAND\n        PROC_END _ON_CMD\n";
constexpr const char* kInit = "        LOD  INITS\n        INR\n        STO  INITS\n"
                              "        LDR  CAPI\n        JL0  NO_CA\n        LOD  CAS\n        INR\n        STO  CAS\n"
                              "NO_CA:  BEX\n        LDR  GO\n        LO   CAPI\n        EX0\n";
constexpr const char* kDone =
    "        LOD  DONES\n        INR\n        STO  DONES\n        BEX\n        LDR  GO2\n        EX0\n";

class TechnolHandshake : public technol_test::WithControl {
protected:
  TechnolHandshake() : WithControl({.data = kData, .main = kMain, .blockInit = kInit, .blockDone = kDone}) {}

  Functions& functions() { return *control_.functions(0); }
  void scan(int count = 1) {
    for (int i = 0; i < count; ++i) {
      functions().step();
      instance_->scan();
    }
  }
  // A function from its beginning to its end.
  void carryOut(FunctionKind kind, uint32_t code) {
    set("GO", 1), set("GO2", 1);
    EXPECT_THAT(functions().start(kind, code), Optional(0u));
    scan(2);
    EXPECT_FALSE(functions().busy(0));
  }
};

TEST_F(TechnolHandshake, AFunctionIsABlockWithoutMotion) {
  EXPECT_THAT(functions().start(M, 3), Optional(0u));
  EXPECT_TRUE(functions().busy(0));
  scan(3);
  EXPECT_EQ(get("PO_F"), 1u);
  EXPECT_EQ(get("STATUS_RESTART"), 1u); // BLOCK_INIT (l.6626-6632)
  EXPECT_EQ(get("INITS"), 1u);
  set("GO", 1);
  scan(3);
  EXPECT_EQ(get("STATUS_RESTART"), 4u); // BLOCK_DONE: there was no motion to wait for
  EXPECT_EQ(get("PO_POL"), 1u);
  EXPECT_EQ(get("DONES"), 1u);
  EXPECT_TRUE(functions().busy(0));
  set("GO2", 1);
  scan();
  EXPECT_FALSE(functions().busy(0));
  EXPECT_EQ(get("PO_F"), 0u);
}

// A program with other cells before its own takes over while MODULE_BLOCK_INIT waits.
TEST_F(TechnolHandshake, AnotherProgramFinishesTheBlock) {
  const technol_test::Compilation other = technol_test::compile(
      {technol_test::programText({.data = "FIRST:  DS 8\n        DFM  A0,A1,,,,,,\n" + std::string(kData),
                                  .main = kMain,
                                  .blockInit = kInit,
                                  .blockDone = kDone})});
  ASSERT_TRUE(other.module) << other.text();
  const ir::Layout layout(*other.module, ir::LayoutOptions{});
  ir::InterpEngine engine(layout, 2);
  EXPECT_THAT(functions().start(M, 3), Optional(0u));
  scan(3);
  runtime::Replacement replacement(engine_->program(), {engine.program(), engine.context()});
  ASSERT_EQ(instance_->replace(replacement), runtime::ReplaceResult::Replaced);
  EXPECT_EQ(get("STATUS_RESTART"), 1u);
  EXPECT_EQ(get("INITS"), 1u);
  scan(3);
  EXPECT_EQ(get("INITS"), 1u) << "it waits where it was";
  set("GO", 1);
  scan(3);
  EXPECT_EQ(get("DONES"), 1u);
  set("GO2", 1);
  scan();
  EXPECT_FALSE(functions().busy(0));
  ASSERT_EQ(instance_->replace(replacement), runtime::ReplaceResult::Replaced); // the engine of the other one ends
  EXPECT_EQ(get("DONES"), 1u);
}

TEST_F(TechnolHandshake, BlocksFollowEachOther) {
  functions().start(T, 5);
  EXPECT_EQ(functions().start(M, 6), std::nullopt);
  scan();
  EXPECT_EQ(functions().start(S, 100), std::nullopt);
  set("GO", 1), set("GO2", 1);
  scan();
  EXPECT_THAT(functions().start(M, 6), Optional(0u));
}

// START_DISABLE (l.6456-6460).
TEST_F(TechnolHandshake, TheProgramMayForbidTheStart) {
  set("GO", 1), set("GO2", 1), set("START_DISABLE", 1);
  functions().start(M, 3);
  scan(5);
  EXPECT_TRUE(functions().busy(0));
  EXPECT_EQ(get("INITS"), 0u);
  set("START_DISABLE", 0);
  scan();
  EXPECT_FALSE(functions().busy(0));
}

TEST_F(TechnolHandshake, AnMInTheCommandBlock) {
  functions().start(M, 19);
  scan();
  EXPECT_EQ(get("AUTPI"), 1u);
  EXPECT_EQ(get("CAPI"), 0u);
  EXPECT_EQ(get("ZMM2PI"), 1u);
  EXPECT_EQ(get("PB06"), 0x19u);
  EXPECT_EQ(get("M19PI"), 1u);
  EXPECT_EQ(get("M03PI"), 0u);
  EXPECT_EQ(get("BLK[0].M2"), 1u);
  EXPECT_EQ(get("BLK[0].M[2]"), 0x19u);
  EXPECT_EQ(get("ZMM1PI"), 0u);
  EXPECT_EQ(get("ZMSTPI"), 0u);
  set("GO", 1), set("GO2", 1);
  scan();
  EXPECT_EQ(get("ZMM2PI"), 0u); // lasts a block (l.6819)
  EXPECT_EQ(get("BLK[0].M2"), 0u);
  EXPECT_EQ(get("M19PI"), 1u); // static (l.6876-6879)
}

TEST_F(TechnolHandshake, DecodedBitsOfAGroupFollowItsLastFunction) {
  const auto bits = [&](std::initializer_list<const char*> names) {
    std::string text;
    for (const char* name : names) text += get(name) != 0 ? '1' : '0';
    return text;
  };
  const auto spindle = [&] { return bits({"M03PI", "M04PI", "M19PI"}); };
  carryOut(M, 3);
  EXPECT_EQ(spindle(), "100");
  carryOut(M, 4);
  EXPECT_EQ(spindle(), "010");
  carryOut(M, 5);
  EXPECT_EQ(spindle(), "000");
  EXPECT_EQ(get("PB06"), 0x05u);
  const auto coolant = [&] { return bits({"M07PI", "M08PI"}); };
  carryOut(M, 17);
  EXPECT_EQ(coolant(), "11");
  carryOut(M, 8);
  EXPECT_EQ(coolant(), "01");
  carryOut(M, 7);
  EXPECT_EQ(coolant(), "10");
  carryOut(M, 9);
  EXPECT_EQ(coolant(), "00");
  const auto more = [&] { return bits({"M50PI", "M51PI"}); };
  carryOut(M, 52);
  EXPECT_EQ(more(), "11");
  carryOut(M, 51);
  EXPECT_EQ(more(), "01");
  carryOut(M, 53);
  EXPECT_EQ(more(), "00");
  const auto gear = [&] { return bits({"M41PI", "M42PI", "M43PI", "M44PI"}); };
  carryOut(M, 43);
  EXPECT_EQ(gear(), "0010");
  carryOut(M, 40); // the control's choice
  EXPECT_EQ(gear(), "0010");
  carryOut(M, 41);
  EXPECT_EQ(gear(), "1000");
}

TEST_F(TechnolHandshake, DynamicFunctionsLastABlock) {
  for (const auto& [code, name] : {std::pair(0u, "M00_PID"),
                                   {2u, "M02_PID"},
                                   {30u, "M30_PID"},
                                   {10u, "M10PID"},
                                   {11u, "M11PID"},
                                   {6u, "M06PID"},
                                   {60u, "M60PI"},
                                   {1u, "BLK[0].CondStop"}}) {
    set("GO", 0);
    functions().start(M, code);
    scan();
    EXPECT_EQ(get(name), 1u) << name;
    set("GO", 1), set("GO2", 1);
    scan();
    EXPECT_EQ(get(name), 0u) << name;
  }
}

TEST_F(TechnolHandshake, CodesInNoGroupAreInTheLast) {
  functions().start(M, 92);
  scan();
  EXPECT_EQ(get("ZMM14PI"), 1u);
  EXPECT_EQ(get("PB16"), 0x92u);
  EXPECT_EQ(get("BLK[0].M[14]"), 0x92u);
}

TEST_F(TechnolHandshake, TheMachineHasGroupsOfItsOwn) {
  EXPECT_TRUE(functions().setGroup(92, 12));
  functions().start(M, 92);
  scan();
  EXPECT_EQ(get("ZMM12PI"), 1u);
  EXPECT_EQ(get("PB14"), 0x92u);
  EXPECT_EQ(get("BLK[0].M[12]"), 0x92u);
  EXPECT_EQ(get("ZMM14PI"), 0u);
  EXPECT_FALSE(functions().setGroup(3, 12)); // fixed (l.7214)
  EXPECT_FALSE(functions().setGroup(92, 0));
  EXPECT_FALSE(functions().setGroup(92, 15));
  EXPECT_FALSE(functions().setGroup(100, 12));
}

TEST_F(TechnolHandshake, AToolAndASpeed) {
  functions().start(T, 12345678);
  scan();
  EXPECT_EQ(get("ZMSTPI"), 1u);
  EXPECT_EQ(get("BLK[0].TProg"), 1u);
  EXPECT_EQ(get("BLK[0].T"), 12345678u);
  EXPECT_EQ(get("PB07"), 0x78u);
  EXPECT_EQ(get("PB10"), 0x12u);
  set("GO", 1), set("GO2", 1);
  scan();
  set("GO", 0);
  functions().start(S, 1500);
  scan();
  EXPECT_EQ(get("ZMSSPI"), 1u);
  EXPECT_EQ(get("ZMSTPI"), 0u);
  EXPECT_EQ(real("BLK[0].SpindleSpeed"), 1500.0);
}

TEST_F(TechnolHandshake, AnHFunction) {
  functions().start(H, 42);
  scan();
  EXPECT_EQ(get("ZMSHPI"), 1u);
  EXPECT_EQ(get("PB05"), 0x42u);
  EXPECT_EQ(get("BLK[0].HProg"), 1u);
  EXPECT_EQ(real("BLK[0].H"), 42.0);
  set("GO", 1), set("GO2", 1);
  scan();
  EXPECT_FALSE(functions().busy(0));
  EXPECT_EQ(get("ZMSHPI"), 0u);
  EXPECT_EQ(get("PB05"), 0x42u);
}

// _ON_CMD learns that it is pressed and that it is released (l.1614-1624); no block is needed for that.
TEST_F(TechnolHandshake, AKeyIsPressedAndReleased) {
  set("START_DISABLE", 1);
  functions().start(M, 3);
  EXPECT_THAT(functions().start(FunctionKind::Key, 0xFFFFFFFF), Optional(1u));
  EXPECT_EQ(functions().start(FunctionKind::Key, 7), std::nullopt);
  EXPECT_TRUE(functions().busy(1));
  scan();
  EXPECT_EQ(get("COMMAND"), 0xFFFFFFFFu);
  EXPECT_EQ(get("PRESSED"), 1u);
  EXPECT_TRUE(functions().busy(1));
  scan();
  EXPECT_EQ(get("PRESSED"), 0u);
  EXPECT_FALSE(functions().busy(1));
  EXPECT_TRUE(functions().busy(0));
  functions().start(FunctionKind::Key, 7);
  control_.powerOn(*instance_, PowerOn::Cold);
  EXPECT_FALSE(functions().busy(1));
}

TEST_F(TechnolHandshake, WhatTheCellsDoNotHold) {
  EXPECT_TRUE(functions().supports(M, 99));
  EXPECT_FALSE(functions().supports(M, 100));
  EXPECT_TRUE(functions().supports(T, 99999999));
  EXPECT_FALSE(functions().supports(T, 100000000));
  EXPECT_TRUE(functions().supports(S, 6000));
  EXPECT_FALSE(functions().supports(S, 0xFFFFFFFF)); // below 0
  EXPECT_FALSE(functions().supports(B, 0));
  EXPECT_TRUE(functions().supports(H, 99));
  EXPECT_FALSE(functions().supports(H, 100));
  EXPECT_TRUE(functions().supports(FunctionKind::Key, 0xFFFFFFFF));
}

// Central annulment in each phase: the block goes no further, a block of the mode CA follows (l.5180-5183, 6748-6761).
TEST_F(TechnolHandshake, AnAbortIsTheCentralAnnulment) {
  functions().start(M, 3); // not begun yet
  functions().abort();
  EXPECT_EQ(get("ZMM2PI"), 0u);
  EXPECT_EQ(get("CAPI"), 1u);
  EXPECT_EQ(get("AUTPI"), 0u);
  set("GO2", 1);
  scan();
  EXPECT_EQ(get("CAS"), 1u);
  EXPECT_EQ(get("INITS"), 1u);
  EXPECT_FALSE(functions().busy(0));

  functions().start(M, 3); // waits in MODULE_BLOCK_INIT
  scan(3);
  EXPECT_EQ(get("CAPI"), 0u);
  functions().abort();
  EXPECT_EQ(functions().start(M, 5), std::nullopt);
  scan();
  EXPECT_EQ(get("INITS"), 3u);
  EXPECT_EQ(get("CAS"), 2u);
  EXPECT_EQ(get("DONES"), 2u); // of the annulments, not of the function
  EXPECT_THAT(functions().start(M, 5), Optional(0u));

  set("GO", 1), set("GO2", 0); // waits in MODULE_BLOCK_DONE
  scan(2);
  EXPECT_EQ(get("DONES"), 3u);
  functions().abort();
  EXPECT_EQ(get("ZMM2PI"), 0u);
  set("GO2", 1);
  scan();
  EXPECT_EQ(get("CAS"), 3u);
  EXPECT_FALSE(functions().busy(0));
}

TEST_F(TechnolHandshake, OneChannelAndNoneUnderWayAfterAPowerOn) {
  EXPECT_EQ(control_.functions(1), nullptr);
  functions().start(M, 3);
  control_.powerOn(*instance_, PowerOn::Cold);
  EXPECT_FALSE(functions().busy(0));
}

} // namespace
} // namespace rung::nc
