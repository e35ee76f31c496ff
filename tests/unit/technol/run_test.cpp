// What TECHNOL programs do: bit logic, data, jumps.
#include <gtest/gtest.h>

#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

using Lines = std::vector<std::string>;

TEST(TechnolRun, NullProgram) {
  Machine m{Parts{}};
  m.scan(3);
  EXPECT_FALSE(m.instance().faulted());
  EXPECT_EQ(m.get("MPXPI"), 1); // man. l.6186
  EXPECT_EQ(m.get("VAZBA_16"), 1);
}

TEST(TechnolRun, WorkedExampleOfBits) {
  Machine m(Parts{.data = "DFM A1,A2,A3,B1,B2,C1\nDFM X,Y,Z\n",
                  .main = "  LDR A1\n  LA -A2\n  LDR B1\n  LA B2\n  LO\n  LX C1\n  WR X,Y\n  CA\n  FL1 1,Z\n"});
  for (int v = 0; v < 64; ++v) {
    const char* names[] = {"A1", "A2", "A3", "B1", "B2", "C1"};
    for (int i = 0; i < 6; ++i) m.set(names[i], v >> i & 1);
    m.set("Z", 0);
    m.scan();
    const bool expected = (((v & 1) && !(v & 2)) || ((v & 8) && (v & 16))) != ((v & 32) != 0);
    EXPECT_EQ(m.get("X"), expected) << v;
    EXPECT_EQ(m.get("Y"), expected);
    EXPECT_EQ(m.get("Z"), !expected);
  }
}

// l.361: [(/A1.A2./A3)+(/B1.B2)].(C2+/C3)
TEST(TechnolRun, BracketsOfTheManual) {
  Machine m(
      Parts{.data = "DFM A1,A2,A3,B1,B2,C2,C3,X\n",
            .main = "  LDR -A1\n  LA A2\n  LA -A3\n  LDR -B1\n  LA B2\n  LO\n  LDR C2\n  LO -C3\n  LA\n  WR X\n"});
  for (int v = 0; v < 128; ++v) {
    const char* names[] = {"A1", "A2", "A3", "B1", "B2", "C2", "C3"};
    bool b[7];
    for (int i = 0; i < 7; ++i) m.set(names[i], b[i] = v >> i & 1);
    m.scan();
    EXPECT_EQ(m.get("X"), ((!b[0] && b[1] && !b[2]) || (!b[3] && b[4])) && (b[5] || !b[6])) << v;
  }
}

TEST(TechnolRun, EdgesTakeOverAtTheStart) {
  Machine m(Parts{.data = "DFM A,H,L\nN: DS 1\n", .main = "  EDGE_H A\n  WR H\n  EDGE_L A\n  WR L\n"});
  m.set("A", 1);
  m.scan();
  EXPECT_EQ(m.get("H"), 0); // the first execution reports nothing
  m.set("A", 0);
  m.scan();
  EXPECT_EQ(m.get("L"), 1);
  m.set("A", 1);
  m.scan();
  EXPECT_EQ(m.get("H"), 1);
  EXPECT_EQ(m.get("L"), 0);
  m.scan();
  EXPECT_EQ(m.get("H"), 0);
  m.set("A", 0);
  m.scan();
  m.start(); // stop and start: taken over anew
  m.set("A", 1);
  m.scan();
  EXPECT_EQ(m.get("H"), 0);
}

TEST(TechnolRun, AddressesOfBits) {
  Machine m(Parts{
      .data = "BUN: DS 4\n DFM B0,B1,B2,B3\nBUN5: DFM C0,C1,C2\n DFM D0\nEQUI OFS,2\n",
      .main = "  FL 1,BUN.B1\n  FL 1,(BUN+3).B2\n  FL 1,BUN+1.B3\n  FL 1,$+1.C1\n  FL 1,C0.B3\n  FL 1,(BUN+OFS-1).B0\n"
              "  LDR -(BUN+3).B2\n  CA\n  WR BUN5.B0\n"});
  m.scan();
  EXPECT_EQ(m.get("BUN.0"), 0);
  EXPECT_EQ(m.get("BUN.1"), 1);
  EXPECT_EQ(m.get("BUN.26"), 1);
  EXPECT_EQ(m.get("BUN.11"), 1);
  EXPECT_EQ(m.get("BUN.8"), 1);
  EXPECT_EQ(m.get("BUN5"), 0b1001);
  EXPECT_EQ(m.get("D0"), 0);
}

TEST(TechnolRun, LoadsAndWidths) {
  Machine m(Parts{.data = "B: DS 1\nW: DS 2\nD: DS 4\nQ: DS 8\nR: DS 8\nW2: DS 2\nD2: DS 4\nD3: DS 4\n",
                  .main = "  LOD B\n  STO D\n  LOD 0FFh\n  AD BYTE.1\n  STO W\n  LOD -B\n  STO QWRD.Q\n  LOD "
                          "CNST.1.5\n  STO REAL.R\n  STO W2\n"
                          "  LOD WORD.B+1\n  STO D2\n  LOD HIGH.W\n  STO D3\n"});
  m.set("B", 0x80);
  m.set("W", 0x1234);
  m.scan();
  EXPECT_EQ(m.get("D"), -128);
  EXPECT_EQ(m.get("W"), 0);
  EXPECT_EQ(m.get("Q"), 128);
  EXPECT_EQ(m.real("R"), 1.5);
  EXPECT_EQ(m.get("W2"), 2); // to nearest, ties to even
  EXPECT_EQ(m.get("D2"), 0);
  EXPECT_EQ(m.get("D3"), 0);
}

TEST(TechnolRun, Arithmetic) {
  Machine m(Parts{.data = "B: DS 1\nW: DS 2\nD: DS 4\nQ: DS 8\nX: DS 4\nY: DS 4\nZ: DS 4\n",
                  .main = "  LOD B\n  MULB BYTE.7\n  STO X\n  LOD D\n  DIVB W\n  STO Y\n  LOD -7\n  DIVB 2\n  STO Z\n  "
                          "LOD D\n  SU 1\n  STO QWRD.Q\n"});
  m.set("B", -3);
  m.set("D", 100000);
  m.set("W", -7);
  m.scan();
  EXPECT_EQ(m.get("X"), -21);
  EXPECT_EQ(m.get("Y"), -14285);
  EXPECT_EQ(m.get("Z"), -3);
  EXPECT_EQ(m.get("Q"), 99999);
  m.set("W", 0);
  m.scan();
  EXPECT_TRUE(m.instance().faulted());
  EXPECT_NE(m.instance().faultText().find("halt-status 2"), std::string::npos);
}

// Jumps back and forward; the loop adds 1..N.
TEST(TechnolRun, JumpsAndLoops) {
  Machine m(Parts{.data = "N: DS 2\nSUM: DS 2\nI: DS 2\n",
                  .main = "  LOD 0\n  STO SUM\n  STO I\nAGAIN: LOD I\n  INR\n  STO I\n  LOD SUM\n  AD I\n  STO SUM\n  "
                          "LOD I\n  LT N\n  JL1 AGAIN\n"
                          "  JUM OVER\n  LOD 0\n  STO SUM\nOVER:\n"});
  m.set("N", 100);
  m.scan();
  EXPECT_EQ(m.get("SUM"), 5050);
}

// A millisecond a slice: MODULE_FAST runs in each, what has the period in the first one.
TEST(TechnolRun, FastModuleRunsEveryMillisecondOnARealClock) {
  Machine m(Parts{.data = "N: DS 2\nSEEN: DS 2\nSCANS: DS 2\n",
                  .main = "  LOD N\n  STO SEEN\n  LOD SCANS\n  INR\n  STO SCANS\n",
                  .fast = "  LOD N\n  INR\n  STO N\n"});
  const int64_t begin = m.instance().nowUs();
  for (int slice = 1; slice <= 40; ++slice) {
    EXPECT_EQ(m.instance().sliceDelayUs(), 1000u);
    m.instance().slice();
    EXPECT_EQ(m.get("N"), slice);
    EXPECT_EQ(m.get("SCANS"), slice <= 20 ? 1 : 2);
    EXPECT_EQ(m.get("SEEN"), slice <= 20 ? 1 : 21);
    EXPECT_EQ(m.instance().atListStart(), slice % 20 == 0);
  }
  EXPECT_EQ(m.instance().nowUs() - begin, 40'000);
  m.scan();
  EXPECT_EQ(m.get("SEEN"), 60); // all twenty before MODULE_MAIN
}

TEST(TechnolRun, EndlessLoopMeetsTheWatchdog) {
  Machine m(Parts{.main = "LOOP: JUM LOOP\n"});
  m.scan();
  EXPECT_TRUE(m.instance().faulted());
  EXPECT_NE(m.instance().faultText().find("watchdog: endless loop in MODULE_MAIN"), std::string::npos)
      << m.instance().faultText();
}

} // namespace
} // namespace rung::technol_test
