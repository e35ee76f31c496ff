// Compiled NCT and TECHNOL programs between HAL pins: M, S and T functions by their dialect's handshake.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "ir/support/temporary_folder.h"
#include "tests/support/compiled_program.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/host/bench.h"

namespace rung::host {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

using rung::test::allocationsOf;
using testing::Bench;

// ---- NCT -----------------------------------------------------------------------------------------------------------

// M6 waits for INP000.00, T for INP000.01, every other M of channel 1 is done at once; M of channel 2 waits for
// INP000.02.
constexpr const char* kNct = R"(dialect nct
module MAIN
symbol ARM     INP000.00
symbol POT     INP000.01
symbol CHUCK   INP000.02
symbol HOLD    INP000.03
symbol COOLANT OUT000.00
symbol CODE1   5005
symbol CODE2   5006
symbol TOOL    5007
symbol SPEED   5008
symbol CODE12  5009

rung "acknowledges are 1 at rest"
|--[N_FIRSTCC]--+--(S CP_M1ACK)
                +--(S CP_M2ACK)
                +--(S CP_SACK)
                +--(S CP_TACK)
                +--(S CP_M1ACK,#1)

rung
|--[CN_M1STB]--+--(R CP_M1ACK)
               +--{MOV CODE1 CN_M1C}

rung
|--[CN_M2STB]--{MOV CODE2 CN_M2C}

rung
|--[CN_M1STB]--{CEQ CN_M1C #8}--(S COOLANT)

rung
|--[CN_M1STB]--{CEQ CN_M1C #9}--(R COOLANT)

rung
|--[CN_M2STB]--{CEQ CN_M2C #9}--(R COOLANT)

rung "done"
|--{CNE CODE1 #6}--+--[/CP_M1ACK]--(S CP_M1ACK)
|--[ARM]-----------+

rung
|--[CN_TSTB]--+--(R CP_TACK)
              +--{MOV TOOL CN_TC}

rung
|--[POT]--[/CP_TACK]--(S CP_TACK)

rung
|--[CN_SSTB]--{MOV SPEED CN_SC}

rung
|--[CN_M1STB,#1]--+--(R CP_M1ACK,#1)
                  +--{MOV CODE12 CN_M1C,#1}

rung
|--[CHUCK]--[/CP_M1ACK,#1]--(S CP_M1ACK,#1)

rung
|--[CP_M1ACK]--[CP_M2ACK]--[CP_SACK]--[CP_TACK]--[/HOLD]--(CP_FIN)

rung
|--[CP_M1ACK,#1]--(CP_FIN,#1)

rung
|--{END}
)";

constexpr const char* kNctMap = R"(
timeout = 1.5

[in]
arm = { type = "bit", name = "ARM" }
pot = { type = "bit", name = "POT" }
chuck = { type = "bit", name = "CHUCK" }
hold = { type = "bit", name = "HOLD" }

[out]
pump = { type = "bit", name = "COOLANT" }
strobe = { type = "bit", name = "CN_M1STB" }
code1 = { type = "s32", name = "CODE1" }
code2 = { type = "s32", name = "CODE2" }
tool = { type = "s32", name = "TOOL" }
speed = { type = "s32", name = "SPEED" }
code12 = { type = "s32", name = "CODE12" }

[[send]]
pin = "change"
edge = "rise"
function = "M"
code = 6
done = "changed"
[[send]]
pin = "coolant"
edge = "rise"
function = "M"
code = 8
[[send]]
pin = "coolant"
edge = "fall"
function = "M"
code = 9
[[send]]
pin = "prepare"
edge = "rise"
function = "T"
code = "number"
done = "prepared"
[[send]]
pin = "spindle"
edge = "rise"
function = "S"
code = "wanted"
done = "taken"
[[send]]
pin = "clamp"
edge = "rise"
function = "M"
code = 51
done = "clamped"
channel = 2

[[abort]]
pin = "estop"
edge = "rise"
)";

class NctBox : public ::testing::Test {
protected:
  NctBox() {
    EXPECT_THAT(b.errors, IsEmpty());
    b.run(20); // the acknowledges are initialised
  }
  rung::testing::CompiledProgram program{"test.lad", kNct};
  Bench b{program.program(), kNctMap};
};

TEST_F(NctBox, AFunctionEndsWithItsAcknowledge) {
  b["change"].bit = true;
  b.run(30);
  EXPECT_EQ(b["code1"].s32, 6);
  EXPECT_FALSE(b["strobe"].bit);
  EXPECT_FALSE(b["changed"].bit);
  EXPECT_TRUE(b.host->functions().busy());
  b["arm"].bit = true;
  b.run(30);
  EXPECT_TRUE(b["changed"].bit);
  EXPECT_FALSE(b.host->functions().busy());
  b["change"].bit = false;
  b.run(1);
  EXPECT_FALSE(b["changed"].bit);
}

// It counts the cycles: a strobe of two would do its work twice.
TEST_F(NctBox, TheStrobeIsThereForOneCycle) {
  int ms = 0;
  b["coolant"].bit = true;
  for (int i = 0; i < 60; ++i) {
    b.run(1);
    if (b["strobe"].bit) ++ms;
  }
  EXPECT_EQ(ms, 10);
  EXPECT_TRUE(b["pump"].bit);
}

TEST_F(NctBox, AToolAndAnMSideBySide) {
  b["number"].s32 = 7;
  b["prepare"].bit = true;
  b["change"].bit = true;
  b.run(50);
  EXPECT_EQ(b["tool"].s32, 7);
  EXPECT_EQ(b["code1"].s32, 6);
  b["arm"].bit = true;
  b.run(30);
  EXPECT_TRUE(b["changed"].bit);
  EXPECT_FALSE(b["prepared"].bit);
  b["pot"].bit = true;
  b.run(30);
  EXPECT_TRUE(b["prepared"].bit);
}

TEST_F(NctBox, MCodesOnFreeLinesKeepTheirOrder) {
  b["change"].bit = true;
  b.run(30);
  b["coolant"].bit = true; // M8 on line 2 is not this program's business
  b.run(30);
  EXPECT_EQ(b["code2"].s32, 8);
  b["coolant"].bit = false;
  b.run(30);
  EXPECT_EQ(b["code2"].s32, 9);
  EXPECT_EQ(b["code1"].s32, 6);
  b["arm"].bit = true;
  b.run(30);
  EXPECT_TRUE(b["changed"].bit);
  b["coolant"].bit = true; // both between two cycles
  b.run(1);
  b["coolant"].bit = false;
  b.run(60);
  EXPECT_FALSE(b["pump"].bit);
}

TEST_F(NctBox, CpFinHoldsTheLastOneBack) {
  b["wanted"].s32 = 1200;
  b["hold"].bit = true;
  b.run(20);
  b["spindle"].bit = true;
  b.run(50);
  EXPECT_EQ(b["speed"].s32, 1200);
  EXPECT_FALSE(b["taken"].bit);
  b["hold"].bit = false;
  b.run(30);
  EXPECT_TRUE(b["taken"].bit);
}

TEST_F(NctBox, TwoChannels) {
  b["change"].bit = b["clamp"].bit = true;
  b.run(30);
  EXPECT_EQ(b["code1"].s32, 6);
  EXPECT_EQ(b["code12"].s32, 51);
  b["chuck"].bit = true;
  b.run(30);
  EXPECT_TRUE(b["clamped"].bit);
  EXPECT_FALSE(b["changed"].bit);
}

TEST_F(NctBox, AnAbortEndsAllChannels) {
  b["change"].bit = b["clamp"].bit = true;
  b.run(30);
  b["estop"].bit = true;
  b.run(1);
  EXPECT_FALSE(b.host->functions().busy());
  b["arm"].bit = b["chuck"].bit = true;
  b.run(30);
  EXPECT_FALSE(b["changed"].bit);
  EXPECT_FALSE(b["clamped"].bit);
}

TEST_F(NctBox, OneThatTakesTooLongShows) {
  b["change"].bit = true;
  b.run(1500);
  EXPECT_FALSE(b.host->functions().late());
  b.run(2);
  EXPECT_TRUE(b.host->functions().late());
}

TEST_F(NctBox, AStepAllocatesNothing) {
  EXPECT_EQ(allocationsOf([&] {
              b["change"].bit = b["clamp"].bit = b["prepare"].bit = b["spindle"].bit = true;
              b.run(100);
              b["arm"].bit = b["chuck"].bit = b["pot"].bit = true;
              b.run(100);
            }),
            0);
  EXPECT_TRUE(b["changed"].bit);
}

// ---- TECHNOL -------------------------------------------------------------------------------------------------------

// M06 waits for P1IN.0; M03 and M04 are there until the next M of the group; P1IN.1 shows message 7.
constexpr const char* kTechnol = R"(DATA
IN1:    DFM  ARM,BUSY,,,,,,
OUT0:   DFM  CHANGE,CW,CCW,,,,,
TOOL:   DS   4
SPEED:  DS   8
CAS:    DS   2
DATA_END
MODULE_INPUT
        MOVE IN1,P1IN
MODULE_INPUT_END
MODULE_BLOCK_INIT
        LDR  CAPI
        JL0  NO_CA
        LOD  CAS
        INR
        STO  CAS
        FL   0,CHANGE
NO_CA:  LDR  BLK[0].TProg
        JL0  NO_T
        LOD  BLK[0].T
        STO  DWRD.TOOL
NO_T:   LDR  ZMSSPI
        JL0  NO_S
        LOD  BLK[0].REAL.SpindleSpeed
        STO  REAL.SPEED
NO_S:   LDR  ZMM2PI
        JL0  NO_M2
        LDR  M03PI
        WR   CW
        LDR  M04PI
        WR   CCW
NO_M2:  LDR  M06PID
        JL0  NO_M6
        FL   1,CHANGE
        BEX
        LDR  ARM
        EX0
        FL   0,CHANGE
NO_M6:
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
        MOVE P0OUT,OUT0
        LDR  BUSY
        ESET1 7
MODULE_MAIN_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
)";

constexpr const char* kTechnolMap = R"(
timeout = 1.5

[in]
arm = { type = "bit", name = "P1IN.0" }
busy = { type = "bit", name = "P1IN.1" }

[out]
changing = { type = "bit", name = "P0OUT.0" }
cw = { type = "bit", name = "P0OUT.1" }
ccw = { type = "bit", name = "P0OUT.2" }
tool = { type = "s32", name = "TOOL" }
speed = { type = "float", name = "SPEED" }
annulments = { type = "s32", name = "CAS" }

[[send]]
pin = "change"
edge = "rise"
function = "M"
code = 6
done = "changed"
[[send]]
pin = "forward"
edge = "rise"
function = "M"
code = 3
[[send]]
pin = "forward"
edge = "fall"
function = "M"
code = 5
[[send]]
pin = "prepare"
edge = "rise"
function = "T"
code = "number"
done = "prepared"
[[send]]
pin = "forward"
edge = "rise"
function = "S"
code = "wanted"

[[abort]]
pin = "estop"
edge = "rise"
)";

class TechnolBox : public ::testing::Test {
protected:
  TechnolBox() { EXPECT_THAT(b.errors, IsEmpty()); }
  rung::testing::CompiledProgram program{"test.plc", kTechnol};
  Bench b{program.program(), kTechnolMap};
};

TEST_F(TechnolBox, AFunctionIsABlock) {
  b["change"].bit = true;
  b.run(60);
  EXPECT_TRUE(b["changing"].bit);
  EXPECT_FALSE(b["changed"].bit);
  EXPECT_TRUE(b.host->functions().busy());
  b["arm"].bit = true;
  b.run(60);
  EXPECT_FALSE(b["changing"].bit);
  EXPECT_TRUE(b["changed"].bit);
  EXPECT_FALSE(b.host->functions().busy());
}

TEST_F(TechnolBox, BlocksFollowEachOther) {
  b["change"].bit = true;
  b.run(40);
  b["number"].s32 = 12;
  b["wanted"].s32 = 800;
  b["prepare"].bit = b["forward"].bit = true;
  b.run(100);
  EXPECT_EQ(b["tool"].s32, 0);
  EXPECT_FALSE(b["cw"].bit);
  b["arm"].bit = true;
  b.run(120);
  EXPECT_EQ(b["tool"].s32, 12);
  EXPECT_TRUE(b["prepared"].bit);
  EXPECT_TRUE(b["cw"].bit);
  EXPECT_EQ(b["speed"].real, 800.0);
  b["forward"].bit = false;
  b.run(60);
  EXPECT_FALSE(b["cw"].bit);
}

TEST_F(TechnolBox, AnAbortIsTheCentralAnnulment) {
  b["forward"].bit = true;
  b.run(60);
  b["change"].bit = true;
  b.run(60);
  EXPECT_TRUE(b["changing"].bit);
  b["estop"].bit = true;
  b["forward"].bit = false; // with the same event
  b.run(80);
  EXPECT_FALSE(b["changing"].bit);
  EXPECT_EQ(b["annulments"].s32, 1);
  EXPECT_FALSE(b["cw"].bit); // M5
  EXPECT_FALSE(b["changed"].bit);
  EXPECT_FALSE(b.host->functions().busy());
}

TEST_F(TechnolBox, OneThatTakesTooLongShows) {
  b["change"].bit = true;
  b.run(1505);
  EXPECT_TRUE(b.host->functions().late());
}

std::vector<std::string> textsOf(Bench& b) {
  b["busy"].bit = true;
  b.run(20);
  std::vector<std::string> texts;
  for (const rung_message_info& message : b.messages()) texts.emplace_back(message.text);
  return texts;
}

// MODULE_DONE_FINISHED is never carried out (l.2617-2622).
TEST_F(TechnolBox, AnEndThatDoesNotComeIsNotWaitedFor) {
  std::string text = kTechnol;
  text.replace(text.find("MODULE_MAIN\n"), 12,
               "MODULE_MAIN\n        LDR  ARM\n        JL0  NOT_YET\n        MODULE_DONE_FINISHED\nNOT_YET:\n");
  const rung::testing::CompiledProgram waiting{"test.plc", text};
  Bench w{waiting.program(), kTechnolMap};
  ASSERT_THAT(w.errors, IsEmpty());
  w.run(40);
  EXPECT_FALSE(w.host->powerOffDone());
  w.run(499L * 20);
  EXPECT_FALSE(w.host->powerOffDone());
  w.run(20);
  EXPECT_TRUE(w.host->powerOffDone());
  EXPECT_EQ(w.host->close(), "");
  Bench answered{waiting.program(), kTechnolMap};
  answered.run(40);
  EXPECT_FALSE(answered.host->powerOffDone());
  answered["arm"].bit = true;
  answered.run(20);
  EXPECT_TRUE(answered.host->powerOffDone());
  EXPECT_TRUE(b.host->powerOffDone()) << "a program that does not wait";
}

TEST_F(TechnolBox, AFaultAtTheEndIsReported) {
  std::string text = kTechnol;
  text.replace(text.find("MODULE_CLEAR\n"), 0, "MODULE_DONE\nFOREVER: JUM FOREVER\nMODULE_DONE_END\n");
  const rung::testing::CompiledProgram endless{"test.plc", text};
  Bench e{endless.program(), kTechnolMap};
  ASSERT_THAT(e.errors, IsEmpty());
  e.run(20);
  std::vector<Report> reports;
  EXPECT_TRUE(e.host->powerOffDone());
  EXPECT_TRUE(e.host->serve(reports));
  EXPECT_THAT(testing::textsOf(reports), ElementsAre(StartsWith("the program has stopped: ")));
}

TEST_F(TechnolBox, MessagesHaveTheTextsOfTheControlsFile) {
  EXPECT_THAT(textsOf(b), ElementsAre("PLC00007 0 0 0 0"));
  const TemporaryFolder folder;
  const std::string path = (folder / "Plc0.PlcErrors").string();
  std::ofstream(path)
      << "<PlcErrors><PlcError No='7' Type='Err' Validity='Transient'><Text>Zavřete kryt</Text></PlcError></PlcErrors>";
  Bench texts{program.program(), "PlcErrors = \"" + path + "\"\n" + kTechnolMap};
  ASSERT_THAT(texts.errors, IsEmpty());
  EXPECT_THAT(textsOf(texts), ElementsAre("PLC00007 0 0 0 0 Zavřete kryt"));
  const Bench wrong{program.program(), "PlcErrors = \"" + path + ".txt\"\n" + kTechnolMap};
  ASSERT_EQ(wrong.errors.size(), 1u);
  EXPECT_THAT(wrong.errors[0],
              StartsWith("m.map:1:13: PlcErrors: found " + path + ".txt, expected a file (cannot read"));
}

TEST_F(TechnolBox, CodesThatItsCellsDoNotHoldAreCounted) {
  b["number"].s32 = -1;
  b["prepare"].bit = true;
  b.run(60);
  EXPECT_EQ(b.host->functions().lost(), 1u);
  EXPECT_FALSE(b["prepared"].bit);
}

TEST_F(TechnolBox, AStepAllocatesNothing) {
  EXPECT_EQ(allocationsOf([&] {
              b["change"].bit = b["prepare"].bit = b["forward"].bit = true;
              b.run(100);
              b["arm"].bit = true;
              b.run(200);
              b["estop"].bit = true;
              b.run(100);
            }),
            0);
  EXPECT_TRUE(b["changed"].bit);
}

} // namespace
} // namespace rung::host
