// Keyboards and their files (man. ch. 11). What is said about mistakes in a file is a golden (golden_test.cpp).
#include "sim/technol/devices/keyboards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

namespace {

using namespace rung::host;
using namespace rung::sim::technol;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<KeyDefinition> keysOf(std::string_view text) {
  std::vector<KeyDefinition> keys;
  EXPECT_EQ(parseKeyboardFile("K", text, keys), "");
  return keys;
}

TEST(KeyboardFile, TheManualsExamples) { // l.16803-16825, l.16889-16905, l.17664
  const auto keys = keysOf(R"(<KeyboardConfig><Comment>Tocitko 3 2 1</Comment>
    <KeyConfig ScanCode="0x6C" Type="Normal" Command="ID_MMM_MAN"> </KeyConfig>
    <KeyConfig ScanCode="0x03" Type="Normal" RtmCommand="RTMID_MMM_SEL00" PlcCommand="CMD_LUBR1"></KeyConfig>
    <KeyConfig ScanCode="0x6D" Type="Normal"><Dialog>SamplePlcTab</Dialog></KeyConfig>
    <KeyConfig ScanCode="0x6A">
      <Function No="0" Type="Normal" RtmCommand="RTMID_IMMM_MOVE01"></Function>
      <Function No="2" Type="Normal" PlcCommand="CMD_PERF"></Function>
    </KeyConfig></KeyboardConfig>)");
  ASSERT_EQ(keys.size(), 5u);
  EXPECT_EQ(keys[0].scan, 0x6C);
  EXPECT_EQ(keys[0].function, KeyDefinition::kAnyFunction);
  EXPECT_EQ(keys[0].plcCommand, "");
  EXPECT_EQ(keys[1].plcCommand, "CMD_LUBR1");
  EXPECT_EQ(keys[1].rtmCommand, "RTMID_MMM_SEL00");
  EXPECT_EQ(keys[3].function, 0);
  EXPECT_EQ(keys[4].function, 2);
  EXPECT_EQ(keys[4].plcCommand, "CMD_PERF");
}

// The PLC constants are those that begin with CMD_, numbered by their last letter.
std::optional<int64_t> codeOf(std::string_view constant) {
  return constant.starts_with("CMD_") ? std::optional(int64_t{constant.back()}) : std::nullopt;
}

struct KeysTest : testing::Test {
  KeysTest() {
    keyboards.define(0, keysOf(R"(<KeyboardConfig>
      <KeyConfig ScanCode="1" PlcCommand="CMD_A" RtmCommand="RTMID_MMM_MOVEX"/>
      <KeyConfig ScanCode="2"><Function No="0" PlcCommand="CMD_0"/><Function No="1" PlcCommand="CMD_1"/>
        <Function No="2" PlcCommand="CMD_2"/></KeyConfig>
      <KeyConfig ScanCode="11" RtmCommand="RTMID_KEYB0_FUNCTION1_TOGGLE"/>
      <KeyConfig ScanCode="12" RtmCommand="RTMID_KEYB0_FUNCTION2_TOGGLE"/>
      <KeyConfig ScanCode="13" RtmCommand="RTMID_KEYB0_FUNCTION3_TOGGLE"/>
      <KeyConfig ScanCode="20" RtmCommand="RTMID_KEYB0_FUNCTION0_SWITCH"/>
      <KeyConfig ScanCode="22" RtmCommand="RTMID_KEYB0_FUNCTION2_SWITCH" PlcCommand="CMD_S"/>
      <KeyConfig ScanCode="31" RtmCommand="RTMID_KEYB0_FUNCTION1"/>
      <KeyConfig ScanCode="32" RtmCommand="RTMID_KEYB4_FUNCTION3_SWITCH"/>
      </KeyboardConfig>)"));
    EXPECT_EQ(keyboards.resolveCommands(codeOf), "");
    keyboards.power();
  }
  void tap(uint32_t scan) {
    keyboards.key(0, scan, true);
    keyboards.key(0, scan, false);
  }
  uint8_t function(uint32_t keyboard = 0) const { return keyboards.state(keyboard).function; }

  Keyboards keyboards;
};

TEST_F(KeysTest, PressAndRelease) {
  const KeyActions press = keyboards.key(0, 1, true);
  EXPECT_EQ(press.plcCommand, codeOf("CMD_A"));
  EXPECT_EQ(press.rtmCommand, "RTMID_MMM_MOVEX");
  EXPECT_EQ(keyboards.key(0, 1, true).plcCommand, std::nullopt) << "it is pressed already";
  const KeyActions release = keyboards.key(0, 1, false);
  EXPECT_EQ(release.plcCommand, codeOf("CMD_A"));
  EXPECT_EQ(keyboards.key(0, 1, false).plcCommand, std::nullopt);
}

TEST_F(KeysTest, KeysWithoutADefinition) {
  for (const auto& [keyboard, scan] : {std::pair{0u, 99u}, {1u, 1u}, {8u, 1u}, {0u, 256u}}) {
    EXPECT_EQ(keyboards.key(keyboard, scan, true).plcCommand, std::nullopt);
    EXPECT_EQ(keyboards.key(keyboard, scan, false).plcCommand, std::nullopt);
  }
}

TEST_F(KeysTest, TheHighestToggledFunctionCounts) { // l.16920-16935
  tap(11);
  EXPECT_EQ(function(), 1);
  EXPECT_THAT(keyboards.state(0).states, ElementsAre(0xFF, 0, 0));
  tap(12);
  EXPECT_EQ(function(), 2);
  tap(13);
  EXPECT_EQ(function(), 3);
  EXPECT_THAT(keyboards.state(0).states, ElementsAre(0xFF, 0xFF, 0xFF));
  tap(12);
  EXPECT_EQ(function(), 3);
  tap(13);
  EXPECT_EQ(function(), 1);
  tap(11);
  EXPECT_EQ(function(), 0);
}

TEST_F(KeysTest, Switched) { // l.16893-16900
  tap(11);
  const KeyActions actions = keyboards.key(0, 22, true);
  EXPECT_EQ(actions.plcCommand, codeOf("CMD_S"));
  EXPECT_EQ(actions.rtmCommand, "") << "functions are switched by the keyboard";
  EXPECT_EQ(function(), 2);
  EXPECT_THAT(keyboards.state(0).states, ElementsAre(0, 0xFF, 0));
  EXPECT_EQ(keyboards.state(0).requested, 2);
  tap(20);
  EXPECT_EQ(function(), 0);
}

TEST_F(KeysTest, WhileAKeyIsHeld) { // l.16901-16908
  tap(12);
  keyboards.key(0, 31, true);
  EXPECT_EQ(function(), 1);
  EXPECT_THAT(keyboards.state(0).states, ElementsAre(0, 0xFF, 0));
  keyboards.key(0, 31, false);
  EXPECT_EQ(function(), 2);
}

TEST_F(KeysTest, KeysByFunction) {
  EXPECT_EQ(keyboards.key(0, 2, true).plcCommand, codeOf("CMD_0"));
  tap(11);
  EXPECT_EQ(keyboards.key(0, 2, false).plcCommand, codeOf("CMD_0")) << "what was pressed is released";
  EXPECT_EQ(keyboards.key(0, 2, true).plcCommand, codeOf("CMD_1"));
  keyboards.key(0, 2, false);
  tap(13);
  EXPECT_EQ(keyboards.key(0, 2, true).plcCommand, std::nullopt) << "it has no function 3";
  EXPECT_EQ(keyboards.key(0, 1, true).plcCommand, codeOf("CMD_A")) << "a key with one function has it always";
}

TEST_F(KeysTest, OneKeyboardSwitchesAnother) {
  tap(32);
  EXPECT_EQ(function(), 0);
  EXPECT_EQ(function(4), 3);
  keyboards.power();
  EXPECT_EQ(function(4), 0);
}

TEST_F(KeysTest, Configuration) {
  EXPECT_EQ(keyboards.configure("PlcConfig", "x"), std::nullopt);
  EXPECT_THAT(keyboards.configure("KbdConfig8", "x").value_or(""), HasSubstr("KbdConfig7"));
  EXPECT_THAT(keyboards.configure("KbdConfig0", "no-such-file").value_or(""), HasSubstr("no-such-file"));
  const std::string folder = testing::TempDir();
  std::ofstream(folder + "/rung_keys.KbdConfig")
      << R"(<KeyboardConfig><KeyConfig ScanCode="0x16" PlcCommand="CMD_V"/></KeyboardConfig>)";
  EXPECT_EQ(keyboards.configure("KbdConfig6", folder + "/rung_keys.KbdConfig"), "");
  EXPECT_TRUE(keyboards.exists(Keyboards::kVirtual));
  EXPECT_FALSE(keyboards.exists(7));
  EXPECT_EQ(keyboards.resolveCommands(codeOf), "");
  EXPECT_EQ(keyboards.key(Keyboards::kVirtual, 22, true).plcCommand, codeOf("CMD_V")); // l.12493
  std::remove((folder + "/rung_keys.KbdConfig").c_str());
}

TEST_F(KeysTest, CommandsThatAreNotConstants) {
  keyboards.define(1, keysOf("<KeyboardConfig>\n<KeyConfig ScanCode='1' PlcCommand='OTHER'/></KeyboardConfig>"));
  EXPECT_THAT(keyboards.resolveCommands(codeOf), AllOf(StartsWith("K:2:1: "), HasSubstr("'OTHER'")));
  EXPECT_EQ(keyboards.key(1, 1, true).plcCommand, std::nullopt);
}

} // namespace
