// A failing expectation explains itself, in each dialect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "tools/scenario/runner.h"

namespace rung::scenario {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ScenarioExplain : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("rung_explain_test" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // What the scenario fails with, without the folder's name.
  std::string failure(const std::string& file, const std::string& program, const std::string& statements) {
    std::ofstream(folder_ / file) << program;
    const std::string text = "program " + file + "\n" + statements;
    const RunResult result =
        run(parse((folder_ / "t.scn").string(), text), {.engines = {compiler::EngineKind::Interp}});
    if (result.problems.empty()) return result.environment.empty() ? "passed" : result.environment;
    std::string message = result.problems[0].message;
    const std::string prefix = folder_.string() + "/";
    for (size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
    return message;
  }

  std::filesystem::path folder_;
};

constexpr const char* kLamp = R"(dialect nct
module MAIN

symbol START   5100.00
symbol STOP    5100.01
symbol PUMP    5101.00
symbol LAMP    5101.01
symbol SPEED   5102
symbol INDEX   5103

rung "start/stop latch"
|--[START]--+--[/STOP]--(PUMP)
|--[PUMP]---+

rung "speed"
|--[PUMP]--{MOV SPEED #7}
)";

TEST_F(ScenarioExplain, NamesRungsReadsValuesAndChanges) {
  const std::string text = failure("lamp.lad", kLamp, R"(scan 3
set START 1
set STOP 1
scan 2
set START 0
expect PUMP 1
)");
  EXPECT_THAT(text, HasSubstr("PUMP is 0, expected 1 (scan 5, 0.050 s)\n"));
  EXPECT_THAT(text, HasSubstr("\n    PUMP (5101.00), unchanged since the start\n"));
  EXPECT_THAT(text, HasSubstr("\n    written by rung "));
  EXPECT_THAT(text, HasSubstr("\"start/stop latch\", lamp.lad:11\n"));
  EXPECT_THAT(text, HasSubstr("\n      START (5100.00) = 0, set after scan 5\n"));
  EXPECT_THAT(text, HasSubstr("\n      STOP (5100.01) = 1, changed in scan 4, 0.040 s"));
  EXPECT_THAT(text, Not(HasSubstr("\n      PUMP"))) << "the name itself";
  EXPECT_THAT(text, Not(HasSubstr("speed")));
}

TEST_F(ScenarioExplain, OtherProblemsHaveTheTimeOnly) {
  EXPECT_EQ(failure("lamp.lad", kLamp, "expect_message 5\n"),
            "message 5 is not displayed; there is none (before the first scan)");
  EXPECT_EQ(failure("lamp.lad", kLamp, "scan 2\nexpect_fault x\n"),
            "the program runs; expected the fault \"x\" (scan 2, 0.020 s)");
}

TEST_F(ScenarioExplain, NamesThatNoRungWrites) {
  EXPECT_THAT(failure("lamp.lad", kLamp, "scan\nexpect START 1\n"),
              HasSubstr("START (5100.00), unchanged since the start\n    written by no rung"));
  EXPECT_THAT(failure("lamp.lad", kLamp, "scan\nexpect LAMP 1\n"),
              AllOf(HasSubstr("\n    LAMP (5101.01)"), HasSubstr("\n    written by no rung")));
  EXPECT_THAT(failure("lamp.lad", kLamp, "scan\nexpect MB_EDIT 1\n"),
              HasSubstr("written by the control or the machine, by no rung"));
  EXPECT_EQ(failure("lamp.lad", kLamp, "scan\nexpect NC.SPEED 1\n").find('\n'), std::string::npos);
}

TEST_F(ScenarioExplain, NumbersAndWords) {
  const std::string text = failure("lamp.lad", kLamp, "set START 1\nscan\nexpect_range SPEED 8 9\n");
  EXPECT_THAT(text, HasSubstr("SPEED is 7 (0x7), expected 8…9 (scan 1, 0.010 s)\n"));
  EXPECT_THAT(text, HasSubstr("SPEED (5102), changed in scan 1, 0.010 s\n    written by rung "));
  EXPECT_THAT(text, HasSubstr("\n      PUMP (5101.00) = 1, changed in scan 1, 0.010 s"));
}

TEST_F(ScenarioExplain, ComputedAddresses) {
  const std::string program = std::string(kLamp) + R"(
rung "somewhere"
|--[START]--{MOV LAMPS,INDEX SPEED}
)";
  std::string declared = program;
  declared.replace(declared.find("symbol INDEX"), 0, "symbol LAMPS   5110\n");
  const std::string text = failure("lamp.lad", declared, "scan\nexpect LAMPS 1\n");
  EXPECT_THAT(text, HasSubstr("INDEX (5103) = 0"));
  EXPECT_THAT(text, HasSubstr(", at a computed address"));
}

TEST_F(ScenarioExplain, LongListsAreCounted) {
  std::string program = "dialect nct\nmodule MAIN\n";
  for (int i = 0; i < 15; ++i) program += "\nrung\n|--[5100.0" + std::to_string(i % 10) + "]--(S 5101.00)\n";
  const std::string text = failure("many.lad", program, "scan\nexpect 5101.00 1\n");
  EXPECT_THAT(text, HasSubstr("also by rung "));
  EXPECT_THAT(text, HasSubstr("and by 4 more"));
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 40);
}

TEST_F(ScenarioExplain, GskLatchesShowAsInputsAndSubprogramsNameTheirCall) {
  const std::string text = failure("mill.pmc", R"(FUNC END1
LD   X1.0
FUNC CALL
PRM  P1
FUNC END2
FUNC SP
PRM  P1
LD   X1.1
OUT  Y1.0
FUNC SPE
)",
                                   "set X1.1 1\nscan 2\nexpect Y1.0 1\n");
  EXPECT_THAT(text, HasSubstr("Y1.0 is 0, expected 1 (scan 2, "));
  EXPECT_THAT(text, HasSubstr("X1.1 = 1, changed in scan 1"));
  EXPECT_THAT(text, HasSubstr("its routine is called in rung "));
  EXPECT_THAT(text, HasSubstr("X1.0 = 0, unchanged since the start"));
}

TEST_F(ScenarioExplain, TechnolJumpsDecideAndRegistersAreTakenOver) {
  const std::string text = failure("m.plc", R"(DATA
FLAGS:  DFM  GATE,WISH,LAMP,,,,,
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LDR  GATE
        JL0  OVER
        LDR  WISH
        WR   LAMP
OVER:   LDR  GATE
MODULE_MAIN_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END

STOP
)",
                                   "set WISH 1\nscan\nexpect LAMP 1\n");
  EXPECT_THAT(text, HasSubstr("LAMP, unchanged since the start\n    written by rung "));
  EXPECT_THAT(text, HasSubstr("\n      WISH = 1, changed in scan 1"));
  EXPECT_THAT(text, HasSubstr("\n      it is passed by or reached as decided in rung "));
  EXPECT_THAT(text, HasSubstr("\n        GATE = 0, unchanged since the start"));
}

TEST_F(ScenarioExplain, AStoppedProgramIsSaid) {
  const std::string program = "dialect nct\nmodule MAIN\n\nrung\n|--{JME #1}\n\nrung\n|--[5100.00]--{JMP #1}\n";
  EXPECT_THAT(failure("loop.lad", program, "set 5100.00 1\nscan\nexpect 5101.01 1\n"),
              HasSubstr("\n    the program has stopped with a fault: PLC timeout"));
}

} // namespace
} // namespace rung::scenario
