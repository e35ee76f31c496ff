// Mechanisms, block modules, timed blocks, timers, counters, procedures, messages.
#include <gtest/gtest.h>

#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

using Lines = std::vector<std::string>;

// The first line of the main module is line 8.
const Parts kGate{.data = "DFM START,GO,OUT1,OUT2,READY\nN: DS 2\n",
                  .main = "  LDR START\n  FL1 1,GATE\n"
                          "  MECH_BEGIN GATE\n"       // 10
                          "  FL 1,OUT1\n"             // 11
                          "  LOD N\n  INR\n  STO N\n" // 12-14
                          "  LDR GO\n  EX0\n"         // 15-16
                          "  FL 1,OUT2\n  EX\n"       // 17-18
                          "  FL 1,READY\n"
                          "  MECH_END GATE\n"};

TEST(TechnolMechanism, WaitsAndRepeatsItsSection) {
  Machine m(kGate);
  m.scan(2);
  EXPECT_EQ(m.get("N"), 0);
  m.set("START", 1);
  m.scan();
  m.set("START", 0);
  m.scan(2);
  EXPECT_EQ(m.get("N"), 3); // the section in front of EX0 runs in each scan
  EXPECT_EQ(m.get("OUT1"), 1);
  EXPECT_EQ(m.get("OUT2"), 0);
  EXPECT_EQ(m.get("GATE"), 1);
  EXPECT_EQ(m.get("GATE_LINE"), 16);
  m.set("GO", 1);
  m.scan();
  EXPECT_EQ(m.get("OUT2"), 1); // in the same scan
  EXPECT_EQ(m.get("READY"), 0);
  EXPECT_EQ(m.get("GATE_LINE"), 18);
  m.set("GO", 0);
  m.scan();
  EXPECT_EQ(m.get("READY"), 1);
  EXPECT_EQ(m.get("GATE"), 0);
  EXPECT_EQ(m.get("GATE_LINE"), 0);
  EXPECT_EQ(m.get("N"), 4);
}

TEST(TechnolMechanism, WithoutInitItIsSuspended) {
  Machine m(kGate);
  m.set("GATE", 1);
  m.set("GO", 1);
  m.scan(); // stands behind EX in line 18
  m.set("GATE", 0);
  m.scan();
  EXPECT_EQ(m.get("GATE_LINE"), 0);
  EXPECT_EQ(m.get("READY"), 0);
  m.set("GATE", 1);
  m.scan();
  EXPECT_EQ(m.get("READY"), 1); // it went on where it was
}

TEST(TechnolMechanism, InitStartsOver) {
  Parts parts = kGate;
  parts.data = "DFM START,GO,OUT1,OUT2,READY,RESET\nN: DS 2\n";
  parts.main += "  LDR RESET\n  JL0 NO\n  MECH_INIT GATE\nNO:\n";
  Machine m(parts);
  m.set("GATE", 1);
  m.set("GO", 1);
  m.scan();
  m.set("RESET", 1);
  m.scan();
  m.set("RESET", 0);
  m.set("GO", 0);
  m.set("GATE", 1);
  m.set("N", 0);
  m.scan(2);
  EXPECT_EQ(m.get("N"), 2);
  EXPECT_EQ(m.get("GATE_LINE"), 16);
}

const Parts kTimed{.data = "DFM GO,LATE,DONE1,RESET\nC: DS 1\nT: DS 2\nCODE: DS 4\n",
                   .main = "  LDR RESET\n  JL0 NO\n  MECH_INIT M\nNO:\n"
                           "  MECH_BEGIN M\n  LDR GO\n  TEX0 C,T,BAD,4\n  FL 1,DONE1\n  EX\n  JUM M_END\n"
                           "BAD: STO CODE\n  FL 1,LATE\n  EX\nM_END: MECH_END M\n"};

TEST(TechnolMechanism, TimeOutLeadsToTheLabel) {
  Machine m(kTimed);
  m.set("T", 5);
  m.set("M", 1);
  m.scan(4);
  EXPECT_EQ(m.get("LATE"), 0);
  EXPECT_EQ(m.get("C"), 4);
  m.scan();
  EXPECT_EQ(m.get("LATE"), 1);
  EXPECT_EQ(m.get("CODE"), 4);
  EXPECT_EQ(m.get("C"), 0);
  m.scan();
  EXPECT_EQ(m.get("M"), 0);
  EXPECT_EQ(m.get("DONE1"), 0);
}

TEST(TechnolMechanism, InTimeGoesOnAndClearsTheCount) {
  Machine m(kTimed);
  m.set("T", 5);
  m.set("M", 1);
  m.scan(3);
  m.set("GO", 1);
  m.scan();
  EXPECT_EQ(m.get("DONE1"), 1);
  EXPECT_EQ(m.get("C"), 0);
  EXPECT_EQ(m.get("LATE"), 0);
}

TEST(TechnolMechanism, InitClearsTheCount) {
  Machine m(kTimed);
  m.set("T", 50);
  m.set("M", 1);
  m.scan(3);
  EXPECT_EQ(m.get("C"), 3);
  m.set("RESET", 1);
  m.scan();
  EXPECT_EQ(m.get("C"), 0);
  EXPECT_EQ(m.get("M"), 0);
}

TEST(TechnolMechanism, TimLetsPassInTheScanOfItsTime) {
  Machine m(
      Parts{.data = "DFM A,B\nN: DS 2\n",
            .main = "  MECH_BEGIN M\n  LOD N\n  INR\n  STO N\n  TIM -,3\n  FL 1,A\n  EX\n  FL 1,B\n  MECH_END M\n"});
  m.set("M", 1);
  m.scan(3);
  EXPECT_EQ(m.get("A"), 0);
  EXPECT_EQ(m.get("N"), 1);
  m.scan();
  EXPECT_EQ(m.get("A"), 1);
  EXPECT_EQ(m.get("B"), 0);
  m.scan();
  EXPECT_EQ(m.get("B"), 1);
  EXPECT_EQ(m.get("M"), 0);
}

TEST(TechnolMechanism, BexMovesThePointOfReturn) {
  Machine m(Parts{
      .data = "DFM GO\nN: DS 2\nK: DS 2\n",
      .main =
          "  MECH_BEGIN M\n  LOD N\n  INR\n  STO N\n  BEX\n  LOD K\n  INR\n  STO K\n  LDR GO\n  EX0\n  MECH_END M\n"});
  m.set("M", 1);
  m.scan(4);
  EXPECT_EQ(m.get("N"), 1);
  EXPECT_EQ(m.get("K"), 4);
}

// A mechanism below the statement that activates it starts in the same scan, one above in the next.
TEST(TechnolMechanism, OrderOfActivation) {
  Machine m(Parts{.data = "DFM GO\nA: DS 1\nB: DS 1\n",
                  .main =
                      "  MECH_BEGIN ABOVE\n  LOD A\n  INR\n  STO A\n  MECH_END ABOVE\n  LDR GO\n  FL1 1,ABOVE,BELOW\n"
                      "  MECH_BEGIN BELOW\n  LOD B\n  INR\n  STO B\n  MECH_END BELOW\n"});
  m.set("GO", 1);
  m.scan();
  EXPECT_EQ(m.get("A"), 0);
  EXPECT_EQ(m.get("B"), 1);
  m.set("GO", 0);
  m.scan();
  EXPECT_EQ(m.get("A"), 1);
  EXPECT_EQ(m.get("B"), 1);
}

TEST(TechnolBlockModules, WaitLikeMechanisms) {
  Machine m(Parts{.data = "DFM GO,A,B\n",
                  .blockInit = "  FL 1,A\n  LDR GO\n  EX0\n  FL 1,B\n",
                  .blockDone = "  TIM -,2\n  FL 0,B\n"});
  m.blockInit = true;
  m.scan(2);
  EXPECT_TRUE(m.blockInit);
  EXPECT_EQ(m.get("A"), 1);
  EXPECT_EQ(m.get("B"), 0);
  m.set("GO", 1);
  m.scan();
  EXPECT_FALSE(m.blockInit);
  EXPECT_EQ(m.get("B"), 1);
  EXPECT_EQ(m.get("@BLOCK_INIT.CONT"), 0);
  m.blockDone = true;
  m.scan(2);
  EXPECT_EQ(m.get("B"), 1);
  m.scan();
  EXPECT_EQ(m.get("B"), 0);
  EXPECT_FALSE(m.blockDone);
}

TEST(TechnolTimed, BlocksRunOncePerPeriod) {
  Machine m(Parts{.data = "N: DS 2\nS: DS 2\nF: DS 2\n",
                  .main = "  DFTM01 E1\n  LOD N\n  INR\n  STO N\nE1:\n  DFTM1 E2\n  LOD S\n  INR\n  STO S\nE2:\n",
                  .fast = "  DFTM01 E3\n  LOD F\n  INR\n  STO F\nE3:\n"});
  m.scan(4);
  EXPECT_EQ(m.get("N"), 0);
  m.scan();
  EXPECT_EQ(m.get("N"), 1); // one period after the start
  m.scan(45);
  EXPECT_EQ(m.get("N"), 10);
  EXPECT_EQ(m.get("S"), 1);
  EXPECT_EQ(m.get("F"), 10);
}

TEST(TechnolTimed, TimerReachesItsPresetInTheRunBehindIt) {
  Machine m(Parts{.data = "DFM IN,OUT\nC: DS 2\n", .main = "  DFTM01 E1\n  LOD 3\n  LDR IN\n  TM C\n  WR OUT\nE1:\n"});
  m.set("IN", 1);
  m.scan(15);
  EXPECT_EQ(m.get("OUT"), 0);
  EXPECT_EQ(m.get("C"), 3);
  m.scan(5);
  EXPECT_EQ(m.get("OUT"), 1);
  EXPECT_EQ(m.get("C"), 3);
  m.set("IN", 0);
  m.scan(5);
  EXPECT_EQ(m.get("OUT"), 0);
  EXPECT_EQ(m.get("C"), 0);
}

TEST(TechnolTimed, CountersCountRisingInputs) {
  Machine m(Parts{.data = "DFM IN,AT3,AT0,AT10\nU: DS 1\nD: DS 2\nB: DS 1\nV: DS 4\n",
                  .main = "  LOD 3\n  LDR IN\n  CU U\n  WR AT3\n  STO V\n  LOD 0\n  LDR IN\n  CD D\n  WR AT0\n  LOD "
                          "10h\n  LDR IN\n  CUBCD B\n  WR AT10\n"});
  m.set("D", 3);
  for (int i = 1; i <= 10; ++i) {
    m.set("IN", 1);
    m.scan(2);
    EXPECT_EQ(m.get("U"), i);
    EXPECT_EQ(m.get("V"), i);
    EXPECT_EQ(m.get("AT3"), i == 3);
    EXPECT_EQ(m.get("AT0"), i == 3);
    EXPECT_EQ(m.get("AT10"), i == 10);
    m.set("IN", 0);
    m.scan();
  }
  EXPECT_EQ(m.get("D"), -7);
}

TEST(TechnolProcedures, RegistersGoInAndComeOut) {
  Machine m(Parts{.data = "A: DS 2\nB: DS 2\nDFM T,U\n",
                  .main = "  LOD 5\n  LDR T\n  PROC_CALL DOUBLE\n  STO A\n  WR U\n  PROC_BEGIN DOUBLE\n  MULB 2\n  "
                          "CA\n  PROC_END DOUBLE\n  LOD A\n  PROC_CALL DOUBLE\n  STO B\n"});
  m.scan();
  EXPECT_EQ(m.get("A"), 10);
  EXPECT_EQ(m.get("B"), 20);
  EXPECT_EQ(m.get("U"), 1);
}

TEST(TechnolMessages, NumberParametersAndCondition) {
  Machine m(
      Parts{.data = "DFM GO\nV: DS 2\nSEEN: DS 2\n",
            .main = "  LDR GO\n  ESET1 12,-,-,V,-,3\n  ESET 13,7,1\n  ESET 13,7,0\n  LOD 14\n  ESET\n  STO SEEN\n"});
  m.set("V", 300);
  m.scan();
  EXPECT_EQ(m.messages(), (Lines{"13p/7/0/0/0", "-13p/7/0/0/0", "14/0/0/0/0"}));
  m.set("GO", 1);
  m.scan();
  EXPECT_EQ(m.messages(), (Lines{"12/0/300/0/3", "13p/7/0/0/0", "-13p/7/0/0/0", "14/0/0/0/0"}));
}

TEST(TechnolMessages, EventProcedureGetsTheNumberAndKeepsRegisters) {
  Machine m(Parts{
      .data = "N: DS 2\nX: DS 2\nDFM A\n",
      .main = "  LOD 77\n  LDR A\n  ESET 9\n  STO X\n  PROC_BEGIN _ON_ESET\n  STO N\n  LOD 1\n  PROC_END _ON_ESET\n"});
  m.scan();
  EXPECT_EQ(m.get("N"), 9);
  EXPECT_EQ(m.get("X"), 77);
}

TEST(TechnolMessages, EventProcedureIsCalledWhenAMessageComesUp) {
  Machine m(Parts{.data = "N: DS 2\nCOUNT: DS 2\nSHOW: DS 1\nDFM A\n",
                  .main = "  LDR A\n  ESET1 40000\n  ESET 9,-,SHOW\n  ESET 8,-,0\n"
                          "  PROC_BEGIN _ON_ESET\n  STO N\n  LOD COUNT\n  INR\n  STO COUNT\n  PROC_END _ON_ESET\n"});
  m.scan();
  EXPECT_EQ(m.get("COUNT"), 0);
  m.set("A", 1);
  m.scan();
  EXPECT_EQ(m.get("COUNT"), 1);
  EXPECT_EQ(m.get("N") & 0xFFFF, 40000);
  m.set("SHOW", 1);
  m.scan();
  EXPECT_EQ(m.get("COUNT"), 3);
  EXPECT_EQ(m.get("N"), 9);
}

TEST(TechnolEvents, TaskOfAnEventProcedure) {
  Machine m(Parts{.data = "N: DS 4\nDFM P\n", .main = "  PROC_BEGIN _ON_CMD\n  STO N\n  WR P\n  PROC_END _ON_CMD\n"});
  m.set("@DR", 4711);
  m.set("@RLO", 1);
  ASSERT_TRUE(m.run("_ON_CMD"));
  EXPECT_EQ(m.get("N"), 4711);
  EXPECT_EQ(m.get("P"), 1);
}

TEST(TechnolStart, InitLearnsWhyAndFinishIsMarked) {
  Machine m(Parts{.data = "W: DS 2\n", .main = "  MODULE_INIT_FINISHED\n", .init = "  STO W\n"});
  EXPECT_EQ(m.get("W"), 0);
  m.set("@DR", 1);
  m.start();
  EXPECT_EQ(m.get("W"), 1);
  EXPECT_EQ(m.get("@INIT.PENDING"), 1);
  m.scan();
  EXPECT_EQ(m.get("@INIT.PENDING"), 0);
}

TEST(TechnolFiles, FurtherFilesContinueMain) {
  Machine m(
      std::vector<std::string>{programText({.data = "A: DS 2\n", .main = "  LOD 1\n  STO A\nL: LOD A\n  STO B\n"}),
                               "DATA\nB: DS 2\nDATA_LOCAL\nLOC: DS 2\nDATA_LOCAL_END\nDATA_END\nMODULE_MAIN\nL: LOD "
                               "B\n  INR\n  STO B\n  STO LOC\nMODULE_MAIN_END\n"});
  m.scan();
  EXPECT_EQ(m.get("B"), 2);
  EXPECT_EQ(m.get("LOC"), 2);
}

TEST(TechnolIndex, ReachesByBxAndStopsOutside) {
  Machine m(Parts{.data = "TAB: DS 20\nV: DS 2\nI: DS 2\nDFM B0,B1\nFL1T: DS 1\n",
                  .main = "  LOD I\n  MOV BX, CX\n  LOD WORD.TAB[BX]\n  STO V\n  LOD 7\n  STO BYTE.(TAB[BX]+1)\n  LDR "
                          "TAB[BX].B1\n  WR FL1T.B0\n"});
  m.set("TAB[4]", 0x34);
  m.set("TAB[5]", 0x12);
  m.set("I", 4);
  m.scan();
  EXPECT_EQ(m.get("V"), 0x1234);
  EXPECT_EQ(m.get("TAB[5]"), 7);
  EXPECT_EQ(m.get("FL1T"), 0); // bit 1 of 34h
  m.set("I", -300);
  m.scan();
  EXPECT_TRUE(m.instance().faulted());
  EXPECT_NE(m.instance().faultText().find("halt-status 13: protection"), std::string::npos);
}

TEST(TechnolReal, ConvertsAndFaults) {
  Machine m(Parts{.data = "R: DS 8\nS: DS 8\nN: DS 4\nDFM BIG\n",
                  .main = "  LOD REAL.R\n  MULB CNST.2.5\n  AD CNST.-1.0\n  STO REAL.S\n  STO N\n  GT CNST.10.0\n  WR "
                          "BIG\n  LOD N\n  REAL DWRD\n  DIVB REAL.R\n  STO REAL.R\n"});
  m.setReal("R", 5);
  m.scan();
  EXPECT_EQ(m.real("S"), 11.5);
  EXPECT_EQ(m.get("N"), 12);
  EXPECT_EQ(m.get("BIG"), 1);
  EXPECT_EQ(m.real("R"), 12.0 / 5);
  m.setReal("R", 0);
  m.scan();
  EXPECT_NE(m.instance().faultText().find("halt-status 3"), std::string::npos);
}

TEST(TechnolConversions, BitsShiftsAndBcd) {
  Machine m(Parts{
      .data = "A: DS 2\nB: DS 2\nC: DS 2\nD: DS 4\nE: DS 4\nF: DS 4\nG: DS 4\nDFM X,Y,Z\nS: DS 1\n",
      .main = "  LOD 9999h\n  INRBCD\n  STO A\n  LOD 1234h\n  BIN\n  STO B\n  LOD 4321\n  BCD\n  STO C\n  LOD "
              "80000012h\n  BIN DWRD\n  STO D\n"
              "  LOD 12345678\n  BCD DWRD\n  STO E\n  LOD 0FFFF8001h\n  RR S\n  STO F\n  LOD 1\n  RL 31,DWRD\n  STO G\n"
              "  CONDR 31\n  WR X\n  CONDR\n  WR Y\n  CONRD\n  STO WORD.A+0\n  INV\n  STO S\n"});
  m.set("S", 15);
  m.scan();
  EXPECT_EQ(m.get("B"), 1234);
  EXPECT_EQ(m.get("C"), 0x4321);
  EXPECT_EQ(m.get("D"), -12);
  EXPECT_EQ(m.get("E"), 0x12345678);
  EXPECT_EQ(m.get("F"), static_cast<int32_t>(0xFFFF0001));
  EXPECT_EQ(m.get("G"), INT32_MIN);
  EXPECT_EQ(m.get("X"), 1);
  EXPECT_EQ(m.get("Y"), 0); // the low 16 bits are 0
  EXPECT_EQ(m.get("A"), 0);
  EXPECT_EQ(m.get("S"), 0);
}

TEST(TechnolCompare, WidthsSignsAndChains) {
  Machine m(Parts{.data = "BC: DS 1\nDW: DS 4\nDFM R1,R2,R3,R4,R5\n",
                  .main = "  LOD DW\n  EQ BC\n  WR R1\n  EQ CNST.41h\n  WR R2\n  LOD -5\n  LT 3\n  WR R3\n  LOD DW\n  "
                          "EQ BC\n  EQ1 321\n  WR R4\n  EQ 1\n  EQ1 BC\n  WR R5\n"});
  m.set("DW", 0x141);
  m.set("BC", 0x41);
  m.scan();
  EXPECT_EQ(m.get("R1"), 1);
  EXPECT_EQ(m.get("R2"), 0);
  EXPECT_EQ(m.get("R3"), 1);
  EXPECT_EQ(m.get("R4"), 1);
  EXPECT_EQ(m.get("R5"), 0);
}

TEST(TechnolStore, ConditionalStoresAndMoves) {
  Machine m(Parts{.data = "A: DS 2\nB: DS 2\nC: DS 2\nD: DS 2\nDFM T,U,V,W\n",
                  .main = "  LOD 5\n  LDR T\n  STO1 A\n  STO0 B\n  MOVE1 C,A\n  MOVE D,C\n  MOVR1 U,-T\n  MOVR V,T\n"});
  m.set("U", 1);
  m.scan();
  EXPECT_EQ(m.get("A"), 0);
  EXPECT_EQ(m.get("B"), 5);
  EXPECT_EQ(m.get("U"), 1);
  m.set("T", 1);
  m.set("B", 0);
  m.scan();
  EXPECT_EQ(m.get("A"), 5);
  EXPECT_EQ(m.get("B"), 0);
  EXPECT_EQ(m.get("C"), 5);
  EXPECT_EQ(m.get("D"), 5);
  EXPECT_EQ(m.get("U"), 0);
  EXPECT_EQ(m.get("V"), 1);
}

TEST(TechnolInterface, CellsMembersAndBlocks) {
  Machine m(Parts{.data = "X: DS 1\nDFM A,B,C\nDFM B0\n",
                  .main = "  LDR M03PI\n  WR A\n  LDR TL2W.TL_Fun1State.B0\n  WR B\n  LOD PB06\n  STO X\n  LDR "
                          "P2IN.C\n  WR P1OUT.B\n  LDR BLK[0].M3\n  WR C\n"});
  m.set("M03PI", 1);
  m.set("PB06", 4);
  m.set("P2IN", 4);
  m.scan();
  EXPECT_EQ(m.get("A"), 1);
  EXPECT_EQ(m.get("X"), 4);
  EXPECT_EQ(m.get("P1OUT"), 2);
}

} // namespace
} // namespace rung::technol_test
