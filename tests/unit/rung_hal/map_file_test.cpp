// The text of mapping files: what is read, and what is said about each mistake.
#include "tools/rung-hal/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rung::hal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(MapFile, ReadsEveryKindOfLine) {
  std::vector<std::string> errors;
  const MapFile map = parseMap("# a machine\n"
                               "in bit start X0.0   # the button\n"
                               "\tout\tfloat  feed.1 AN_FEED,#1\r\n"
                               "\n"
                               "const s32 D4:4 -12\n"
                               "send spindle-on fall M 5\n"
                               "abort estop rise\n"
                               "timeout 2.5\n"
                               "high-speed\n"
                               "send prepare rise T number prepared", // the last line needs no end
                               "m.map", errors);
  EXPECT_THAT(errors, IsEmpty());
  ASSERT_EQ(map.pins.size(), 7u);
  EXPECT_EQ(map.pins[0].name, "start");
  EXPECT_EQ(map.pins[0].type, PinType::Bit);
  EXPECT_FALSE(map.pins[0].output);
  EXPECT_EQ(map.pins[1].name, "feed.1");
  EXPECT_EQ(map.pins[1].type, PinType::Float);
  EXPECT_TRUE(map.pins[1].output);
  ASSERT_EQ(map.inputs.size(), 1u);
  EXPECT_EQ(map.inputs[0].name, "X0.0");
  EXPECT_EQ(map.inputs[0].line, 2u);
  ASSERT_EQ(map.outputs.size(), 1u);
  EXPECT_EQ(map.outputs[0].pin, 1u);
  EXPECT_EQ(map.outputs[0].name, "AN_FEED,#1"); // '#' within a word is part of the name
  ASSERT_EQ(map.constants.size(), 1u);
  EXPECT_EQ(map.constants[0].value, -12);
  ASSERT_EQ(map.sends.size(), 2u);
  EXPECT_FALSE(map.sends[0].edge.rising);
  EXPECT_EQ(map.sends[0].kind, nc::FunctionKind::M);
  EXPECT_EQ(map.sends[0].code, 5);
  EXPECT_FALSE(map.sends[0].codePin.has_value());
  EXPECT_FALSE(map.sends[0].donePin.has_value());
  EXPECT_EQ(map.sends[1].kind, nc::FunctionKind::T);
  EXPECT_EQ(map.pins[map.sends[1].codePin.value()].name, "number");
  EXPECT_EQ(map.pins[map.sends[1].codePin.value()].type, PinType::S32);
  EXPECT_EQ(map.pins[map.sends[1].donePin.value()].name, "prepared");
  EXPECT_TRUE(map.pins[map.sends[1].donePin.value()].output);
  ASSERT_EQ(map.aborts.size(), 1u);
  EXPECT_EQ(map.pins[map.aborts[0].pin].name, "estop");
  EXPECT_TRUE(map.aborts[0].rising);
  EXPECT_EQ(map.timeoutNs, 2'500'000'000);
  EXPECT_EQ(map.highSpeedLine, 9u);
}

TEST(MapFile, APinOfSeveralLinesIsOnePin) {
  std::vector<std::string> errors;
  const MapFile map = parseMap("in bit cw X0.0\nin bit cw X0.1\nsend cw rise M 3\nsend cw fall M 5\n", "m.map", errors);
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_EQ(map.pins.size(), 1u);
  EXPECT_EQ(map.inputs.size(), 2u);
}

TEST(MapFile, ValuesOfConstants) {
  std::vector<std::string> errors;
  const MapFile map = parseMap("const bit X0.0 1\nconst u32 D0 0xFFFFFFFF\nconst s32 D0 -2147483648\n"
                               "const u32 D0 4294967295\nconst float R 1.5e-3\n",
                               "m.map", errors);
  EXPECT_THAT(errors, IsEmpty());
  ASSERT_EQ(map.constants.size(), 5u);
  EXPECT_EQ(map.constants[0].value, 1);
  EXPECT_EQ(map.constants[1].value, 4294967295.0);
  EXPECT_EQ(map.constants[2].value, -2147483648.0);
  EXPECT_EQ(map.constants[3].value, 4294967295.0);
  EXPECT_EQ(map.constants[4].value, 1.5e-3);
}

std::vector<std::string> errorsOf(std::string_view text) {
  std::vector<std::string> errors;
  parseMap(text, "m.map", errors);
  return errors;
}

TEST(MapFile, EveryMistakeIsReportedWithItsLine) {
  EXPECT_THAT(
      errorsOf("# fine\ninput bit a X0.0\nin bit a\n"),
      ElementsAre("m.map:2: unknown keyword 'input': in, out, const, send, abort, timeout or high-speed is expected",
                  "m.map:3: the form is: in TYPE PIN NAME [SCALE]"));
  EXPECT_THAT(errorsOf("in word a X0"),
              ElementsAre("m.map:1: unknown type 'word': bit, s32, u32 or float is expected"));
  EXPECT_THAT(errorsOf("in bit a/b X0.0"),
              ElementsAre("m.map:1: 'a/b' is not a pin name: letters, digits, '-', '_' and '.' are allowed"));
  EXPECT_THAT(errorsOf("in bit a X0.0\nin s32 a X1"), ElementsAre("m.map:2: pin 'a' is already defined as in bit"));
  EXPECT_THAT(errorsOf("in bit a X0.0\nout bit a Y0.0"), ElementsAre("m.map:2: pin 'a' is already defined as in bit"));
  EXPECT_THAT(errorsOf("out bit a Y0.0\nout bit a Y0.1"), ElementsAre("m.map:2: output pin 'a' is already mapped"));
}

TEST(MapFile, Scales) {
  std::vector<std::string> errors;
  const MapFile map = parseMap("in float a D0:4 1000\nout float b D4:4 -0.5\nin float c D8:4\n", "m.map", errors);
  EXPECT_THAT(errors, IsEmpty());
  ASSERT_EQ(map.inputs.size(), 2u);
  EXPECT_EQ(map.inputs[0].scale, 1000);
  EXPECT_EQ(map.inputs[1].scale, 1);
  ASSERT_EQ(map.outputs.size(), 1u);
  EXPECT_EQ(map.outputs[0].scale, -0.5);
  parseMap("in s32 a D0:4 10\nin float b D0:4 0\nout float c D0:4 x\nin float d D0:4 inf\n", "m.map", errors);
  EXPECT_THAT(errors, ElementsAre("m.map:1: a scale is possible only for float",
                                  "m.map:2: '0' is not a scale: a number other than 0 is expected",
                                  "m.map:3: 'x' is not a scale: a number other than 0 is expected",
                                  "m.map:4: 'inf' is not a scale: a number other than 0 is expected"));
}

TEST(MapFile, BadValues) {
  EXPECT_THAT(errorsOf("const bit X0.0 2"), ElementsAre("m.map:1: '2' is not a value of type bit"));
  EXPECT_THAT(errorsOf("const u32 D0 -1"), ElementsAre("m.map:1: '-1' is not a value of type u32"));
  EXPECT_THAT(errorsOf("const u32 D0 4294967296"), ElementsAre("m.map:1: '4294967296' is not a value of type u32"));
  EXPECT_THAT(errorsOf("const s32 D0 2147483648"), ElementsAre("m.map:1: '2147483648' is not a value of type s32"));
  EXPECT_THAT(errorsOf("const s32 D0 12x"), ElementsAre("m.map:1: '12x' is not a value of type s32"));
  EXPECT_THAT(errorsOf("const s32 D0 0x"), ElementsAre("m.map:1: '0x' is not a value of type s32"));
  EXPECT_THAT(errorsOf("const s32 D0 --5"), ElementsAre("m.map:1: '--5' is not a value of type s32"));
  EXPECT_THAT(errorsOf("const float D0 1,5"), ElementsAre("m.map:1: '1,5' is not a value of type float"));
}

TEST(MapFile, BadFunctions) {
  EXPECT_THAT(errorsOf("send a rise Q 3"),
              ElementsAre("m.map:1: 'Q' is not a kind of function: M, S, T or B is expected"));
  EXPECT_THAT(errorsOf("send a up M 3"), ElementsAre("m.map:1: 'up': rise or fall is expected"));
  EXPECT_THAT(errorsOf("send a rise M"),
              ElementsAre("m.map:1: the form is: send PIN rise|fall M|S|T|B CODE|CODEPIN [DONEPIN]"));
  EXPECT_THAT(errorsOf("out bit a Y0.0\nsend a rise M 3"),
              ElementsAre("m.map:2: pin 'a' is already defined as out bit"));
  // Two acknowledges on one pin, or one that a name feeds too, would fight.
  EXPECT_THAT(errorsOf("out bit d Y0.0\nsend a rise M 3 d"), ElementsAre("m.map:2: output pin 'd' is already mapped"));
  EXPECT_THAT(errorsOf("send a rise M 3 d\nsend b rise M 4 d"),
              ElementsAre("m.map:2: output pin 'd' is already mapped"));
  EXPECT_THAT(errorsOf("abort a"), ElementsAre("m.map:1: the form is: abort PIN rise|fall"));
  EXPECT_THAT(errorsOf("abort a high"), ElementsAre("m.map:1: 'high': rise or fall is expected"));
  EXPECT_THAT(errorsOf("timeout 0\ntimeout nan\ntimeout 1e9\ntimeout 5 s"),
              ElementsAre("m.map:1: '0' is not a time in seconds: a number above 0, up to 1000000, is expected",
                          "m.map:2: 'nan' is not a time in seconds: a number above 0, up to 1000000, is expected",
                          "m.map:3: '1e9' is not a time in seconds: a number above 0, up to 1000000, is expected",
                          "m.map:4: the form is: timeout SECONDS"));
  EXPECT_THAT(errorsOf("timeout 5\ntimeout 6"), ElementsAre("m.map:2: the time is already set"));
  EXPECT_THAT(errorsOf("high-speed on"), ElementsAre("m.map:1: the form is: high-speed"));
}

} // namespace
} // namespace rung::hal
