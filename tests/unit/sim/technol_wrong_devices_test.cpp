// What a scenario says wrongly about the devices of the simulated TECHNOL control, and the messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "tests/unit/sim/technol_machine.h"

namespace {

using namespace rung;
using namespace rung::sim;
using testing::HasSubstr;
using testing::StartsWith;

// A file that is there while the test runs.
class File {
public:
  File(const char* name, std::string_view text) : path_(testing::TempDir() + name) { std::ofstream(path_) << text; }
  ~File() { std::remove(path_.c_str()); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::string& path() const { return path_; }

private:
  std::string path_;
};

std::string configured(std::string_view key, std::string_view value) {
  return makeSimulatedTechnol()->config(key, value);
}

NcArgument number(const char* key, int64_t value) { return {.key = key, .integer = value}; }
NcArgument text(const char* key, const char* value) { return {.key = key, .isText = true, .text = value}; }
NcCell value(uint64_t bits) { return {.bits = bits}; }

TEST(WrongDevices, Keys) {
  const File file("rung_wrong_keys.KbdConfig", "<KeyboardConfig><KeyConfig ScanCode='1'/></KeyboardConfig>");
  TechnolMachine machine({{"nc", "simulated"}, {"KbdConfig2", file.path()}});
  const auto event = [&](const std::vector<NcArgument>& keys) {
    return machine.nc().event(machine.inside(), "KEY", keys);
  };
  const NcArgument keyboard = number("keyboard", 2), scan = number("scan", 1), state = number("state", 1);
  EXPECT_EQ(event({keyboard, scan, state}), "");
  EXPECT_EQ(event({scan, state}), "KEY: 'keyboard' is missing");
  EXPECT_EQ(event({number("keyboard", 8), scan, state}), "KEY: 'keyboard' takes 0 to 7");
  EXPECT_EQ(event({text("keyboard", "2"), scan, state}), "KEY: 'keyboard' takes 0 to 7");
  EXPECT_EQ(event({keyboard, state}), "KEY: 'scan' is missing");
  EXPECT_EQ(event({keyboard, number("scan", 256), state}), "KEY: 'scan' takes 0 to 255");
  EXPECT_EQ(event({keyboard, scan}), "KEY: 'state' is missing");
  EXPECT_EQ(event({keyboard, scan, number("state", 2)}), "KEY: 'state' takes 0 to 1");
  EXPECT_EQ(event({number("keyboard", 1), scan, state}),
            "keyboard 1 has no keys; `config KbdConfig1 FILE` gives it some");
  EXPECT_EQ(event({keyboard, scan, state, number("code", 1)}), "KEY has no 'code': it has keyboard scan state");
}

TEST(WrongDevices, CommandsOfKeys) {
  const File file("rung_wrong_commands.KbdConfig",
                  "<KeyboardConfig>\n <KeyConfig ScanCode='1' PlcCommand='CMD_X'/></KeyboardConfig>");
  EXPECT_THAT(configured("KbdConfig9", file.path()), HasSubstr("KbdConfig0 to KbdConfig7"));
  EXPECT_THAT(configured("KbdConfig0", file.path() + "x"), HasSubstr("cannot be read"));
  TechnolMachine machine({{"nc", "simulated"}, {"KbdConfig0", file.path()}});
  const auto problems = machine.nc().connectionProblems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].text, HasSubstr(".KbdConfig:2:2: PlcCommand 'CMD_X' is not a PLC constant"));
}

TEST(WrongDevices, ChannelConfig) {
  const auto wrong = [](std::string_view element) {
    const File file("rung_wrong.ChannelConfig", "<ChannelConfig>\n" + std::string(element) + "</ChannelConfig>");
    const std::string text = configured("PlcConfig", file.path());
    return text.substr(std::min(text.size(), file.path().size()));
  };
  EXPECT_EQ(wrong("<NCAxis No='0' Name='X' Feed='600' />"), "");
  EXPECT_EQ(wrong("<NCAxis No='0' Feed='fast'/>"), ":2:1: 'Feed' needs a number above 0; found 'fast'");
  EXPECT_EQ(wrong("<NCAxis/>"), ":2:1: <NCAxis> lacks the attribute No");
  EXPECT_EQ(wrong("<NCAxis No='16'/>"), ":2:1: attribute No is '16', expected 0 to 15");
  EXPECT_THAT(wrong("<NCAxis No='1'/>\n<NCAxis No='1'/>"), HasSubstr(":3:1: NCAxis 1 is defined again"));
  EXPECT_THAT(wrong("<CANChannel No='1' Active='1' InOut08Cnt='33'/>"), HasSubstr("takes 0 to 32"));
  EXPECT_EQ(wrong("<CANChannel No='1' Active='0' InOut08Cnt='33'/>"), "") << "it is not active";
  EXPECT_EQ(wrong("<CANChannel No='5' Active='1' InOut08Cnt='33'/>"), "") << "a channel of something else";
  EXPECT_THAT(wrong("<ComChannel No='0' ComSpeed='0'/>"), StartsWith(":2:1: COM[0].ComSpeed: "));
  EXPECT_THAT(wrong("<ComChannel No='0' Speed='0'/>"), HasSubstr("not 'SPEED'"));
  EXPECT_EQ(wrong("<Servo No='0' ServoType='Kollmorgen'/>"),
            ":2:1: ServoType: expected the number of a type, found 'Kollmorgen'");
}

TEST(WrongDevices, Displays) {
  TechnolMachine machine({{"nc", "simulated"}, {"CAN[1].KnobCnt", "1"}});
  EXPECT_TRUE(machine.nc().readCell("DISPTOC1.Shown[63][127]"));
  EXPECT_FALSE(machine.nc().readCell("DISPTOC1.Shown[64][0]"));
  EXPECT_EQ(machine.nc().cellProblem("DISPTOC1.Shown[64][0]"),
            "a display has the rows 0 to 63 and the columns 0 to 127");
  EXPECT_EQ(machine.nc().cellProblem("DISPTOC2.Shown[0][0]"),
            "there is no such handwheel; `config CAN[1].KnobCnt 2` adds it");
  EXPECT_EQ(machine.nc().writeCell("DISPTOC1.Shown[0][0]", value(1)),
            "what the display shows is written by the program, to DISPTOC1 and DISPTOC2");
  EXPECT_EQ(TechnolMachine({{"CAN[1].KnobCnt", "1"}}).nc().cellProblem("DISPTOC1.Shown[0][0]"),
            "it is there with `config nc simulated`");
}

TEST(WrongDevices, UnitsByName) {
  TechnolMachine machine({{"nc", "simulated"}, {"CAN[1].InOut08Cnt", "1"}, {"CAN[1].KnobCnt", "1"}});
  const auto why = [&](std::string_view name) {
    EXPECT_FALSE(machine.nc().readCell(name)) << name;
    return machine.nc().cellProblem(name);
  };
  EXPECT_EQ(why("InputOutput_CAN2_1.INOUT_IN"), "there is no such unit; `config CAN[1].InOut08Cnt 2` adds it");
  EXPECT_EQ(why("Panel_CAN2_0.INOUT_IN"), "there is no such unit; `config CAN[1].Kla50Cnt 1` adds it");
  EXPECT_THAT(why("Knob_CAN2_0.INOUT_LIGHT"), StartsWith("a unit has INOUT_PRESENT, INOUT_MODE,"));
  EXPECT_THAT(why("Knob_CAN2_0.INOUT_ERROR1[2]"), StartsWith("a unit has "));
  EXPECT_EQ(why("Knob_CAN2_0.INOUT_IRC[2]"), "INOUT_IRC has the elements 0 to 1");
  EXPECT_EQ(why("Knob_CAN2_0.INOUT_MODE[1]"), "INOUT_MODE has no elements");
  EXPECT_EQ(why("Knob_CAN2_0.INOUT_IN4[0]"), "INOUT_IN has the elements 0 to 3");
  EXPECT_EQ(why("Knob_CAN2_0.INOUT_IN0[8]"), "INOUT_IN0 has the bits 0 to 7");
  EXPECT_EQ(machine.nc().writeCell("Knob_CAN2_0.INOUT_IN", value(256)), "expected 0 to 255");
  EXPECT_EQ(machine.nc().writeCell("Knob_CAN2_0.INOUT_IN0[3]", value(2)), "expected 0 to 1");
  EXPECT_EQ(machine.nc().writeCell("Knob_CAN2_0.INOUT_IRC", value(65536)), "expected 0 to 65535");
  EXPECT_THAT(machine.nc().writeCell("InputOutput_CAN2_0.INOUT_OUT", value(1)).value_or(""),
              StartsWith("it is what the unit does or says; set are INOUT_IN"));
  EXPECT_EQ(machine.nc().writeCell("InputOutput_CAN2_1.INOUT_IN", value(1)), std::nullopt);
}

TEST(WrongDevices, ProcessData) {
  TechnolMachine machine({{"nc", "simulated"},
                          {"ethercat.0", "coe"},
                          {"ethercat.0.name", "DRIVE"},
                          {"ethercat.0.ds402", "1"},
                          {"ethercat.0.pdo.Inputs.Status", "0x6041.0"},
                          {"ethercat.0.pdo.Outputs.Control", "0x6040.0"}},
                         {{"ECAT.DRIVE.Inputs.Speed", "VKeyboard.VKey[1]"},
                          {"P1IN.0", "ECAT.DRIVE.Inputs.Status.Bit[0]"},
                          {"ECAT.DRIVE.Outputs.Control", "P0OUT"},
                          {"P1IN.0", "ECAT.DRIVE.Outputs.Control.Bit[16]"},
                          {"P1IN.0", "ECAT.OTHER.Outputs.Control"}});
  const auto problems = machine.nc().connectionProblems();
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_THAT(problems[0].text, HasSubstr("the device has no such process data"));
  EXPECT_THAT(problems[1].text, HasSubstr("is an output: a connection cannot end there"));
  EXPECT_THAT(problems[2].text, HasSubstr("is an input: a connection cannot begin there"));
  EXPECT_THAT(problems[3].text, HasSubstr("it has no bit 16"));
  EXPECT_THAT(machine.nc().writeCell("ECAT.DRIVE.Inputs.Status", value(1)).value_or(""),
              HasSubstr("`set NC.ETHERCAT.DEVICE.INDEX.SUB` sets the object"));
  EXPECT_EQ(machine.nc().writeCell("RTM.Axis[3].Pos0_Ax", value(1)),
            "it is where the axis is: `set NC.TRUE.4` moves it");
  EXPECT_EQ(machine.nc().writeCell("RTM.Axis[4].Pos0_Ax", value(1)), "") << "there is no such axis";
}

} // namespace
