// The text of mapping files: what is read, and what is said about each mistake.
#include "tests/support/faultless_map.h"
#include "tools/mapping/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace rung::mapping {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

using test::faultlessMap;

std::vector<Link> links(const File& map, Direction direction) {
  std::vector<Link> found;
  for (const Link& link : map.links)
    if (map.pins[link.pin].direction == direction) found.push_back(link);
  return found;
}
std::vector<Link> inputs(const File& map) { return links(map, Direction::In); }
std::vector<Link> outputs(const File& map) { return links(map, Direction::Out); }

std::vector<std::string> errorsOf(std::string_view text) {
  std::vector<std::string> errors;
  parseMap(text, "m.map", errors);
  return errors;
}

TEST(MapFile, ReadsEveryTable) {
  const File map = faultlessMap(R"(# a machine
timeout = 2.5
high-speed = true

[in]
start = { type = "bit", name = "X0.0" } # the button

[out]
"feed.1" = { type = "float", name = "AN_FEED,#1", scale = -0.5 }

[const]
"D4:4" = -12

[[send]]
pin = "spindle-on"
edge = "fall"
function = "M"
code = 5

[[send]]
done = "prepared"
code = "number"
function = "T"
edge = "rise"
pin = "prepare"
channel = 2

[m-groups]
70 = 10

[[abort]]
pin = "estop"
edge = "rise"
)");
  ASSERT_EQ(map.groups.size(), 1u);
  EXPECT_EQ(map.groups[0].code, 70u);
  EXPECT_EQ(map.groups[0].group, 10u);
  ASSERT_EQ(map.pins.size(), 7u);
  EXPECT_EQ(map.pins[0].name, "start");
  EXPECT_EQ(map.pins[0].type, PinType::Bit);
  EXPECT_EQ(map.pins[0].direction, Direction::In);
  EXPECT_EQ(map.pins[0].at, (Position{6, 1}));
  EXPECT_EQ(map.pins[1].name, "feed.1");
  EXPECT_EQ(map.pins[1].type, PinType::Float);
  EXPECT_EQ(map.pins[1].direction, Direction::Out);
  ASSERT_EQ(inputs(map).size(), 1u);
  EXPECT_EQ(inputs(map)[0].name, "X0.0");
  EXPECT_EQ(inputs(map)[0].scale, 1);
  EXPECT_EQ(inputs(map)[0].at, (Position{6, 32}));
  ASSERT_EQ(outputs(map).size(), 1u);
  EXPECT_EQ(outputs(map)[0].pin, 1u);
  EXPECT_EQ(outputs(map)[0].name, "AN_FEED,#1");
  EXPECT_EQ(outputs(map)[0].scale, -0.5);
  ASSERT_EQ(map.constants.size(), 1u);
  EXPECT_EQ(map.constants[0].name, "D4:4");
  EXPECT_EQ(map.constants[0].value, -12);
  EXPECT_EQ(map.constants[0].at, (Position{12, 1}));
  ASSERT_EQ(map.sends.size(), 2u);
  EXPECT_EQ(map.pins[map.sends[0].edge.pin].name, "spindle-on");
  EXPECT_FALSE(map.sends[0].edge.rising);
  EXPECT_EQ(map.sends[0].kind, RUNG_FUNCTION_M);
  EXPECT_EQ(map.sends[0].code, 5);
  EXPECT_FALSE(map.sends[0].codePin.has_value());
  EXPECT_FALSE(map.sends[0].donePin.has_value());
  EXPECT_EQ(map.sends[0].at, (Position{14, 1}));
  EXPECT_EQ(map.pins[map.sends[1].edge.pin].name, "prepare");
  EXPECT_EQ(map.sends[0].channel, 0u);
  EXPECT_EQ(map.sends[1].channel, 1u);
  EXPECT_TRUE(map.sends[1].edge.rising);
  EXPECT_EQ(map.sends[1].kind, RUNG_FUNCTION_T);
  EXPECT_EQ(map.pins[map.sends[1].codePin.value()].name, "number");
  EXPECT_EQ(map.pins[map.sends[1].codePin.value()].type, PinType::S32);
  EXPECT_EQ(map.pins[map.sends[1].donePin.value()].name, "prepared");
  EXPECT_EQ(map.pins[map.sends[1].donePin.value()].direction, Direction::Out);
  ASSERT_EQ(map.aborts.size(), 1u);
  EXPECT_EQ(map.pins[map.aborts[0].pin].name, "estop");
  EXPECT_TRUE(map.aborts[0].rising);
  EXPECT_EQ(map.timeoutNs, 2'500'000'000);
  EXPECT_EQ(map.highSpeed, (Position{3, 14}));
}

TEST(MapFile, NothingIsNeeded) {
  const File map = faultlessMap("high-speed = false\n[in]\n");
  EXPECT_THAT(map.pins, IsEmpty());
  EXPECT_EQ(map.timeoutNs, 0);
  EXPECT_FALSE(map.highSpeed.has_value());
}

TEST(MapFile, PinsAreInTheOrderOfTheFile) {
  const File map = faultlessMap(R"(
in.zulu = { type = "bit", name = "X0.0" }
out.mike = { type = "bit", name = "Y0.0" }
in.alpha = { type = "bit", name = "X0.1" }
)");
  std::vector<std::string> names;
  for (const Pin& pin : map.pins) names.push_back(pin.name);
  EXPECT_THAT(names, ElementsAre("zulu", "alpha", "mike")); // table for table
}

TEST(MapFile, OneInputPinFeedsNamesAndFunctions) {
  const File map = faultlessMap(R"(
in.cw = { type = "bit", name = ["X0.0", "X0.1"] }
send = [{ pin = "cw", edge = "rise", function = "M", code = 3 },
        { pin = "cw", edge = "fall", function = "M", code = 5 }]
)");
  EXPECT_EQ(map.pins.size(), 1u);
  ASSERT_EQ(inputs(map).size(), 2u);
  EXPECT_EQ(inputs(map)[0].name, "X0.0");
  EXPECT_EQ(inputs(map)[1].name, "X0.1");
  EXPECT_EQ(inputs(map)[1].at, (Position{2, 41}));
  EXPECT_EQ(map.sends.size(), 2u);
}

TEST(MapFile, ValuesOfConstants) {
  const File map = faultlessMap(R"([const]
"X0.0" = true
"X0.1" = false
A = 0xFFFFFFFF
B = -2147483648
R = 1.5e-3
)");
  ASSERT_EQ(map.constants.size(), 5u);
  EXPECT_EQ(map.constants[0].type, PinType::Bit);
  EXPECT_EQ(map.constants[0].value, 1);
  EXPECT_EQ(map.constants[1].value, 0);
  EXPECT_EQ(map.constants[2].type, PinType::U32);
  EXPECT_EQ(map.constants[2].value, 4294967295.0);
  EXPECT_EQ(map.constants[3].type, PinType::S32);
  EXPECT_EQ(map.constants[3].value, -2147483648.0);
  EXPECT_EQ(map.constants[4].type, PinType::Float);
  EXPECT_EQ(map.constants[4].value, 1.5e-3);
}

TEST(MapFile, EveryMistakeIsReportedInTheOrderOfTheFile) {
  EXPECT_THAT(
      errorsOf(R"(timout = 5
[out]
a = { type = "word", name = "Y0.0" }
[in]
b = { typ = "bit", name = "X0.0" }
c = 5
)"),
      ElementsAre("m.map:1:1: the file: found an unknown key timout, expected include, timeout, high-speed, in, "
                  "out, io, param, const, send, m-groups, PlcErrors, axis-groups, abort, rungctl, modbus-client, "
                  "devices, modbus-server, shared-memory; did you mean timeout?",
                  "m.map:3:14: out.a.type: found \"word\", expected \"bit\", \"s32\", \"u32\" or \"float\"; "
                  "write for example type = \"bit\"",
                  "m.map:5:5: in.b: found no key type, expected \"bit\", \"s32\", \"u32\" or \"float\"; write "
                  "for example type = \"bit\"",
                  "m.map:5:7: in.b: found an unknown key typ, expected type, name, scale, bits; did you mean "
                  "type?",
                  "m.map:6:5: in.c: found 5, expected a table; write for example c = { type = \"bit\", name = "
                  "\"X0.0\" }"));
}

TEST(MapFile, MistakesOfSyntaxEndTheReading) {
  const std::vector<std::string> errors = errorsOf("timeout = -1\n[in]\nin bit a X0.0\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_THAT(errors[0], StartsWith("m.map:3:4: "));
  EXPECT_THAT(errors[0], ::testing::EndsWith("; the file must be TOML, and further mistakes are found once this is"));
  EXPECT_THAT(errorsOf("out.a = { type = \"bit\", name = \"Y0.0\" }\nout.a = { type = \"bit\", name = \"Y0.1\" }\n"),
              ElementsAre(StartsWith("m.map:2:")));
  EXPECT_THAT(errorsOf("\xFF"), ElementsAre(StartsWith("m.map:1:1: ")));
}

TEST(MapFile, TablesOfTheWrongKind) {
  EXPECT_THAT(errorsOf("in = 1\nout = []\nconst = \"x\"\n[send]\npin = \"a\"\n"),
              ElementsAre("m.map:1:6: in: found 1, expected a table; write for example [in] and its pins in the lines "
                          "after it",
                          "m.map:2:7: out: found a list, expected a table; write for example [out] and its pins in "
                          "the lines after it",
                          "m.map:3:9: const: found \"x\", expected a table; write for example [const] and NAME = "
                          "VALUE in the lines after it",
                          "m.map:4:1: send: found a table, expected a list of tables; write for example [[send]] and "
                          "its keys in the lines after it"));
  EXPECT_THAT(errorsOf("abort = [1]"),
              ElementsAre("m.map:1:9: abort: found a list, expected a list of tables; write for example [[abort]] and "
                          "its keys in the lines after it"));
}

TEST(MapFile, NamesOfPins) {
  EXPECT_THAT(errorsOf("in.\"a/b\" = { type = \"bit\", name = \"X0.0\" }"),
              ElementsAre("m.map:1:4: in.a/b: found \"a/b\", expected the name of a pin: letters, digits, '-', '_' and "
                          "'.'"));
  EXPECT_THAT(errorsOf("[in]\nfeed.1 = { type = \"bit\", name = \"X0.0\" }"),
              ElementsAre("m.map:2:1: in.feed: found a name with a dot, expected quotes around it; write for example "
                          "\"feed.1\" = { … }"));
  EXPECT_THAT(errorsOf(R"([in]
a = { type = "bit", name = "X0.0" }
[out]
a = { type = "bit", name = "Y0.0" }
)"),
              ElementsAre("m.map:4:1: pin a: found an input pin of type bit with this name in line 2, expected an "
                          "output pin of type bit; give one of them another name"));
}

TEST(MapFile, NamesOfTheProgram) {
  EXPECT_THAT(errorsOf(R"([in]
a = { type = "bit", name = "" }
b = { type = "bit", name = [] }
c = { type = "bit", name = ["X0.0", 5] }
d = { type = "bit" }
[out]
e = { type = "bit", name = ["Y0.0", "Y0.1"] }
)"),
              ElementsAre(StartsWith("m.map:2:28: in.a.name: found \"\", expected a name of the program"),
                          StartsWith("m.map:3:28: in.b.name: found a list, expected a name of the program, or a list"),
                          StartsWith("m.map:4:28: in.c.name: found a list, expected a name of the program, or a list"),
                          StartsWith("m.map:5:5: in.d: found no key name, expected a name of the program"),
                          "m.map:7:37: out.e.name: found several names, expected one, because an output pin has one "
                          "source; give the other names pins of their own"));
}

TEST(MapFile, BadScales) {
  EXPECT_THAT(errorsOf(R"([in]
a = { type = "s32", name = "D0:4", scale = 10 }
b = { type = "float", name = "D0:4", scale = 0 }
c = { type = "float", name = "D0:4", scale = "x" }
d = { type = "float", name = "D0:4", scale = inf }
)"),
              ElementsAre("m.map:2:44: in.a.scale: found a scale of type s32, expected one of type float only; remove "
                          "it, or write type = \"float\"",
                          "m.map:3:46: in.b.scale: found 0, expected a number other than 0; write for example scale = "
                          "1000",
                          "m.map:4:46: in.c.scale: found \"x\", expected a number other than 0; write for example "
                          "scale = 1000",
                          "m.map:5:46: in.d.scale: found inf, expected a number other than 0; write for example scale "
                          "= 1000"));
}

TEST(MapFile, BadConstants) {
  const std::string expected = ", expected true, false, an integer from -2147483648 to 4294967295, or a real number; "
                               "write for example ";
  EXPECT_THAT(errorsOf(R"([const]
"D0:4" = 4294967296
A = -2147483649
B = "1"
C = nan
D = 1979-05-27
X0.0 = true
"" = 1
)"),
              ElementsAre("m.map:2:10: const.D0:4: found 4294967296" + expected + "\"D0:4\" = 1",
                          "m.map:3:5: const.A: found -2147483649" + expected + "\"A\" = 1",
                          "m.map:4:5: const.B: found \"1\"" + expected + "\"B\" = 1",
                          "m.map:5:5: const.C: found nan" + expected + "\"C\" = 1",
                          "m.map:6:5: const.D: found a date or a time" + expected + "\"D\" = 1",
                          "m.map:7:1: const.X0: found a name with a dot, expected quotes around it; write for example "
                          "\"X0.1\" = true",
                          "m.map:8:1: const: found \"\", expected a name of the program; write for example \"X0.0\" = "
                          "true"));
}

TEST(MapFile, BadTimesAndModes) {
  const std::string expected = ", expected seconds, above 0 and at most 1000000; write for example timeout = 30";
  for (const std::string value : {"0", "-1", "nan", "1000000.5", "\"5 s\""})
    EXPECT_THAT(errorsOf("timeout = " + value), ElementsAre("m.map:1:11: timeout: found " + value + expected));
  EXPECT_EQ(faultlessMap("timeout = 1000000").timeoutNs, 1'000'000'000'000'000);
  EXPECT_THAT(errorsOf("high-speed = 1"),
              ElementsAre("m.map:1:14: high-speed: found 1, expected true or false; write for example high-speed = "
                          "true"));
}

TEST(MapFile, BadFunctions) {
  EXPECT_THAT(errorsOf(R"([[send]]
pin = "a b"
edge = "up"
function = "Q"
code = 2147483648
done = 5
channel = 0
)"),
              ElementsAre("m.map:2:7: send.pin: found \"a b\", expected the name of a pin; write for example pin = "
                          "\"spindle-forward\"",
                          "m.map:3:8: send.edge: found \"up\", expected \"rise\" or \"fall\"; write for example edge = "
                          "\"rise\"",
                          "m.map:4:12: send.function: found \"Q\", expected \"M\", \"S\", \"T\", \"B\", \"H\" or "
                          "\"key\"; write for example function = \"M\"",
                          "m.map:5:8: send.code: found 2147483648, expected an integer of 32 bits with a sign, or the "
                          "name of an s32 pin; write for example code = 3",
                          "m.map:6:8: send.done: found 5, expected the name of a pin; write for example done = "
                          "\"tool-changed\"",
                          "m.map:7:11: send.channel: found 0, expected the number of a channel of the control, from 1; "
                          "write for example channel = 2"));
  EXPECT_THAT(errorsOf("[[send]]\nfuntion = \"M\"\n"),
              ElementsAre(StartsWith("m.map:1:1: send: found no key pin, "),
                          StartsWith("m.map:1:1: send: found no key edge, "),
                          StartsWith("m.map:1:1: send: found no key function, "),
                          StartsWith("m.map:1:1: send: found no key code, "),
                          "m.map:2:1: send: found an unknown key funtion, expected pin, edge, function, code, done, "
                          "channel; did you mean function?"));
  EXPECT_THAT(errorsOf("[[abort]]\npin = \"a\"\n"), ElementsAre(StartsWith("m.map:1:1: abort: found no key edge, ")));
  EXPECT_THAT(errorsOf("abort = [{ pin = \"a\", edge = \"high\" }]"),
              ElementsAre(StartsWith("m.map:1:30: abort.edge: found \"high\", expected \"rise\" or \"fall\"")));
}

TEST(MapFile, BadGroups) {
  EXPECT_THAT(errorsOf("[m-groups]\nM70 = 10\n71 = \"ten\"\n72 = -1\n"),
              ElementsAre("m.map:2:1: m-groups: found \"M70\", expected the number of an M function; write for example "
                          "70 = 10",
                          "m.map:3:6: m-groups.71: found \"ten\", expected the number of a group; write for example 70 "
                          "= 10",
                          "m.map:4:6: m-groups.72: found -1, expected the number of a group; write for example 70 = "
                          "10"));
  // Other keys for TOML, which orders them by their characters: the first is the first in the file.
  EXPECT_THAT(errorsOf("[m-groups]\n71 = 9\n70 = 10\n070 = 11\n0070 = 10\n"),
              ElementsAre("m.map:4:1: m-groups: found M70, which is in line 3 already, expected one group for each "
                          "function; remove one of the lines",
                          "m.map:5:1: m-groups: found M70, which is in line 3 already, expected one group for each "
                          "function; remove one of the lines"));
}

TEST(MapFile, AxisGroups) {
  const File map = faultlessMap("[axis-groups]\n4 = \"A\"\n1 = \"H\"\n");
  ASSERT_EQ(map.axisGroups.size(), 2u);
  EXPECT_EQ(map.axisGroups[0].axis, 3u);
  EXPECT_EQ(map.axisGroups[0].group, 0u);
  EXPECT_EQ(map.axisGroups[1].axis, 0u);
  EXPECT_EQ(map.axisGroups[1].group, 7u);
  EXPECT_THAT(errorsOf("[axis-groups]\n0 = \"A\"\nX = \"A\"\n2 = \"AB\"\n3 = 1\n4 = \"A\"\n04 = \"B\"\n"),
              ElementsAre("m.map:2:1: axis-groups: found \"0\", expected the number of an axis, from 1; write for "
                          "example 4 = \"A\"",
                          "m.map:3:1: axis-groups: found \"X\", expected the number of an axis, from 1; write for "
                          "example 4 = \"A\"",
                          "m.map:4:5: axis-groups.2: found \"AB\", expected the letter of a group; write for example "
                          "4 = \"A\"",
                          "m.map:5:5: axis-groups.3: found 1, expected the letter of a group; write for example 4 = "
                          "\"A\"",
                          "m.map:7:1: axis-groups: found axis 4, which is in line 6 already, expected one group for "
                          "each axis; remove one of the lines"));
}

TEST(MapFile, Devices) {
  using Kind = DeviceSetting::Kind;
  const File map = faultlessMap("[devices]\ncan = { 2 = \"can0\" }\ncom = { 1 = \"/dev/ttyS0\" }\nsa-file = \"areas\"\n"
                                "[devices.config]\n\"COM[1].ComSpeed\" = 19200\nPlcTable3 = \"t.PlcT\"\n"
                                "\"CAN[1].Active\" = true\nPlcConfig = \"c\"\n");
  const std::vector<std::tuple<Kind, std::string, std::string>> expected = {{Kind::Can, "2", "can0"},
                                                                            {Kind::Com, "1", "/dev/ttyS0"},
                                                                            {Kind::SharedFile, "", "areas"},
                                                                            {Kind::Config, "COM[1].ComSpeed", "19200"},
                                                                            {Kind::Config, "PlcTable3", "t.PlcT"},
                                                                            {Kind::Config, "CAN[1].Active", "1"},
                                                                            {Kind::Config, "PlcConfig", "c"}};
  ASSERT_EQ(map.devices.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(std::tie(map.devices[i].kind, map.devices[i].key, map.devices[i].value),
              std::tie(std::get<0>(expected[i]), std::get<1>(expected[i]), std::get<2>(expected[i])));
  EXPECT_EQ(map.devices[3].at.line, 6u);
  EXPECT_THAT(
      errorsOf("[devices]\ncan = \"can0\"\ncom = { 1 = 2 }\nsa-file = \"\"\nports = 1\nconfig = { A = [1] }\n"),
      ElementsAre("m.map:2:7: devices.can: found \"can0\", expected a table of channels and interfaces; write for "
                  "example can = { 2 = \"can0\" }",
                  "m.map:3:13: devices.com.1: found 2, expected the name of a device; write for example 1 = "
                  "\"/dev/ttyUSB0\"",
                  "m.map:4:11: devices.sa-file: found \"\", expected the path of a file; write for example "
                  "sa-file = \"/dev/shm/areas\"",
                  "m.map:5:1: devices: found an unknown key ports, expected can, com, axes, sa-file, config",
                  "m.map:6:16: devices.config.A: found a list, expected a text or a number; write for example "
                  "\"COM[1].ComSpeed\" = 19200"));
}

TEST(MapFile, AxesThatTheProgramPositions) {
  using Kind = DeviceSetting::Kind;
  const File map = faultlessMap("[devices.axes]\n4 = { pins = \"table\", FeedRT = 6000 }\n05 = \"turret\"\n");
  const std::vector<std::tuple<Kind, std::string, std::string>> expected = {
      {Kind::Axis, "4", "table"}, {Kind::Config, "axis.4.FeedRT", "6000"}, {Kind::Axis, "5", "turret"}};
  ASSERT_EQ(map.devices.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(std::tie(map.devices[i].kind, map.devices[i].key, map.devices[i].value),
              std::tie(std::get<0>(expected[i]), std::get<1>(expected[i]), std::get<2>(expected[i])));
  EXPECT_THAT(map.pins, IsEmpty()); // whoever moves axes makes them
  std::vector<std::string> errors;
  refuseAxes(map, "a host", errors);
  EXPECT_THAT(errors, ElementsAre("m.map:2:14: devices.axes: found axis 4, expected none in a host; remove it",
                                  "m.map:3:6: devices.axes: found axis 5, expected none in a host; remove it"));
}

TEST(MapFile, MistakesOfAxes) {
  EXPECT_THAT(errorsOf("devices.axes = [1]\n"),
              ElementsAre("m.map:1:16: devices.axes: found a list, expected a table of axes and their pins; write for "
                          "example axes = { 4 = \"table\" }"));
  EXPECT_THAT(errorsOf("[devices.axes]\n0 = \"a\"\n17 = \"a\"\nZ = \"a\"\n4 = \"a b\"\n5 = { FeedRT = [1] }\n"
                       "04 = \"b\"\n6 = \"c\"\n06 = \"d\"\n"),
              ElementsAre("m.map:2:1: devices.axes: found \"0\", expected the number of an axis, 1 to 16; write for "
                          "example 4 = \"table\"",
                          "m.map:3:1: devices.axes: found \"17\", expected the number of an axis, 1 to 16; write for "
                          "example 4 = \"table\"",
                          "m.map:4:1: devices.axes: found \"Z\", expected the number of an axis, 1 to 16; write for "
                          "example 4 = \"table\"",
                          "m.map:5:5: devices.axes.4: found \"a b\", expected what the names of its pins begin with: "
                          "letters, digits, '-', '_' and '.'; write for example 4 = \"table\", or 4 = { pins = "
                          "\"table\", FeedRT = 6000 }",
                          "m.map:6:5: devices.axes.5: found a table, expected what the names of its pins begin with: "
                          "letters, digits, '-', '_' and '.'; write for example 5 = \"table\", or 5 = { pins = "
                          "\"table\", FeedRT = 6000 }",
                          "m.map:6:16: devices.axes.5.FeedRT: found a list, expected a text or a number; write for "
                          "example FeedRT = 6000",
                          "m.map:9:1: devices.axes: found axis 6 again, expected each axis once; remove one of the "
                          "lines"));
}

TEST(MapFile, PinsOfFunctionsThatHaveAnotherUse) {
  EXPECT_THAT(errorsOf(R"(
out.a = { type = "bit", name = "Y0.0" }
send = [{ pin = "a", edge = "rise", function = "M", code = 3 }]
)"),
              ElementsAre("m.map:3:17: pin a: found an output pin of type bit with this name in line 2, expected an "
                          "input pin of type bit; give one of them another name"));
  // Two acknowledges on one pin, or one that a name feeds too, would fight.
  EXPECT_THAT(errorsOf(R"(
out.d = { type = "bit", name = "Y0.0" }
send = [{ pin = "a", edge = "rise", function = "M", code = 3, done = "d" }]
)"),
              ElementsAre("m.map:3:70: pin d: found an output pin of type bit with this name in line 2, expected an "
                          "output pin of type bit that has no other source; give one of them another name"));
  EXPECT_THAT(errorsOf(R"(
send = [{ pin = "a", edge = "rise", function = "M", code = 3, done = "d" },
        { pin = "b", edge = "rise", function = "M", code = "a", done = "d" }]
)"),
              ElementsAre(StartsWith("m.map:3:60: pin a: found an input pin of type bit with this name in line 2, "
                                     "expected an input pin of type s32; "),
                          StartsWith("m.map:3:72: pin d: found an output pin of type bit with this name in line 2, ")));
}

TEST(MapFile, PinsOfBothSidesAndParameters) {
  const File map = faultlessMap(R"([io]
mode = { type = "s32", name = "D4:4" }
[param]
delay = { type = "u32", name = "D0:2", value = 500 }
gain = { type = "float", name = "D8:4", scale = 1000 }
)");
  ASSERT_EQ(map.pins.size(), 3u);
  EXPECT_EQ(map.pins[0].direction, Direction::Io);
  EXPECT_EQ(map.pins[1].direction, Direction::Parameter);
  ASSERT_EQ(map.links.size(), 3u);
  EXPECT_EQ(map.links[1].value, 500);
  EXPECT_FALSE(map.links[2].value.has_value());
  EXPECT_EQ(map.links[2].scale, 1000);
}

TEST(MapFile, BitsOfACellHaveAPinEach) {
  const File map = faultlessMap(R"([in]
key = { type = "bit", name = "X10", bits = 8 }
[out]
lamp = { type = "bit", name = "Y0:2", bits = 12 }
)");
  ASSERT_EQ(map.pins.size(), 20u);
  EXPECT_EQ(map.pins[0].name, "key-0");
  EXPECT_EQ(map.pins[7].name, "key-7");
  EXPECT_EQ(map.pins[8].name, "lamp-00");
  EXPECT_EQ(map.pins[19].name, "lamp-11");
  ASSERT_EQ(map.links.size(), 2u);
  EXPECT_THAT(map.links[0].bits, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_EQ(map.links[1].pin, 8u);
}

TEST(MapFile, SafeValues) {
  const File map = faultlessMap(R"([out]
brake = { type = "bit", name = "Y0.0", safe = true }
speed = { type = "float", name = "Y1", safe = -1.5 }
count = { type = "s32", name = "Y2", safe = -3 }
light = { type = "bit", name = "Y0.1", safe = "hold" }
pump = { type = "bit", name = "Y0.2" }
)");
  ASSERT_EQ(map.pins.size(), 5u);
  EXPECT_EQ(map.pins[0].safe, 1);
  EXPECT_EQ(map.pins[1].safe, -1.5);
  EXPECT_EQ(map.pins[2].safe, -3);
  EXPECT_TRUE(map.pins[3].holds);
  EXPECT_EQ(map.pins[4].safe, 0);
  EXPECT_FALSE(map.pins[4].holds);
}

TEST(MapFile, KeysThatDoNotFitTheirPin) {
  EXPECT_THAT(
      errorsOf(R"([in]
a = { type = "u32", name = "X10", bits = 8 }
b = { type = "bit", name = "X10", bits = 33 }
c = { type = "bit", name = "X0.0", safe = true }
[out]
d = { type = "bit", name = "Y0.0", safe = 1 }
e = { type = "s32", name = "Y1", safe = 2147483648 }
f = { type = "float", name = "Y1", safe = true }
g = { type = "bit", name = "Y0.0", safe = "off" }
[io]
h = { type = "bit", name = ["R0.0", "R0.1"] }
[param]
i = { type = "u32", name = "D0:2", value = -1 }
j = { type = "u32", name = "D0:2", bits = 2 }
)"),
      ElementsAre("m.map:2:42: in.a.bits: found pins of type u32, expected type bit, one for each bit of the "
                  "cell; write type = \"bit\", or remove it",
                  "m.map:3:42: in.b.bits: found 33, expected how many bits of a cell have a pin, 1 to 32; write "
                  "for example bits = 8",
                  "m.map:4:36: in.c: found an unknown key safe, expected type, name, scale, bits",
                  "m.map:6:43: out.d.safe: found 1, expected true or false, because the type is bit; write such "
                  "a value, or another type",
                  "m.map:7:41: out.e.safe: found 2147483648, expected an integer from -2147483648 to "
                  "2147483647, because the type is s32; write such a value, or another type",
                  StartsWith("m.map:8:43: out.f.safe: found true, expected a number, because"),
                  StartsWith("m.map:9:43: out.g.safe: found \"off\", expected true, false, a number or \"hold\""),
                  "m.map:11:37: io.h.name: found several names, expected one, because an io pin has one source; "
                  "give the other names pins of their own",
                  StartsWith("m.map:13:44: param.i.value: found -1, expected an integer from 0 to 4294967295"),
                  StartsWith("m.map:14:36: param.j: found an unknown key bits, expected type, name, scale, value")));
  EXPECT_THAT(errorsOf(R"([in]
"key-1" = { type = "u32", name = "X0" }
key = { type = "bit", name = "X10", bits = 2 }
)"),
              ElementsAre(StartsWith("m.map:3:1: pin key-1: found an input pin of type u32 with this name in line 2")));
}

TEST(MapFile, WhatRungctlMayDo) {
  const File map = faultlessMap("[rungctl]\nallow = [\"set\", \"stop\"]\nnever = [\"X0.0\", \"ESTOP\"]\n");
  EXPECT_TRUE(map.allowed[static_cast<size_t>(Remote::Set)]);
  EXPECT_TRUE(map.allowed[static_cast<size_t>(Remote::Stop)]);
  EXPECT_FALSE(map.allowed[static_cast<size_t>(Remote::Force)]);
  ASSERT_EQ(map.never.size(), 2u);
  EXPECT_EQ(map.never[1].name, "ESTOP");
  EXPECT_EQ(map.never[1].at, (Position{3, 18}));
  EXPECT_THAT(
      errorsOf("[rungctl]\nallow = [\"sett\"]\nnever = \"X0.0\"\nalways = 1\n"),
      ElementsAre("m.map:2:9: rungctl.allow: found a list, expected a list of \"set\", \"force\", \"reload\", "
                  "\"start\", \"stop\", \"reset\", \"profile\" and \"serve\"; write for example allow = [\"set\"]",
                  "m.map:3:9: rungctl.never: found \"X0.0\", expected a list of names of the program; write for "
                  "example never = [\"X0.0\"]",
                  "m.map:4:1: rungctl: found an unknown key always, expected allow, never"));
}

// Files by their paths.
ReadFile files(std::map<std::string, std::string> texts) {
  return [texts = std::move(texts)](const std::string& path) {
    const auto found = texts.find(path);
    if (found == texts.end()) throw std::runtime_error("cannot read " + path + ": No such file or directory");
    return found->second;
  };
}

TEST(MapFile, Includes) {
  std::vector<std::string> errors;
  const File map = loadMap("maps/m.map", errors,
                           files({{"maps/m.map", "include = [\"panel.map\", \"/shared/axes.map\"]\n"
                                                 "in.a = { type = \"bit\", name = \"X0.0\" }\n"},
                                  {"maps/panel.map", "in.b = { type = \"bit\", name = \"X0.1\" }\n"},
                                  {"/shared/axes.map", "timeout = 5\nin.c = { type = \"bit\", name = \"X0.2\" }\n"}}));
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_THAT(map.paths, ElementsAre("maps/m.map", "maps/panel.map", "/shared/axes.map"));
  ASSERT_EQ(map.pins.size(), 3u);
  EXPECT_EQ(map.pins[0].name, "b");
  EXPECT_EQ(map.pins[1].name, "c");
  EXPECT_EQ(map.pins[2].name, "a");
  EXPECT_EQ(map.timeoutNs, 5'000'000'000);
}

TEST(MapFile, MistakesOfIncludes) {
  const auto read =
      files({{"m.map", "include = [\"b.map\", \"none.map\", \"b.map\", \"c.map\", \"m.map\"]\ntimeout = 2\n"
                       "in.a = { type = \"bit\", name = \"X0.0\" }\n"},
             {"b.map", "timeout = 1\nin.a = { type = \"u32\", name = \"X1\" }\nwrong = 1\n"},
             {"c.map", "in bit a"}});
  std::vector<std::string> errors;
  loadMap("m.map", errors, read);
  EXPECT_THAT(errors, ElementsAre("m.map:1:21: include: found none.map, expected a file (cannot read none.map: No such "
                                  "file or directory); write its path, from the folder of this file",
                                  "m.map:1:33: include: found b.map again, expected each file once; remove it here",
                                  "m.map:1:51: include: found m.map again, expected each file once; remove it here",
                                  "m.map:2:11: timeout: found a second one, expected that of line 1 of b.map alone; "
                                  "remove one of them",
                                  "m.map:3:4: pin a: found an input pin of type u32 with this name in line 2 of b.map, "
                                  "expected an input pin of type bit; give one of them another name",
                                  StartsWith("b.map:3:1: the file: found an unknown key wrong, expected include, "),
                                  StartsWith("c.map:1:4: ")));
  errors.clear();
  EXPECT_THAT(loadMap("none.map", errors, read).paths, IsEmpty());
  EXPECT_THAT(errors, ElementsAre("cannot read none.map: No such file or directory"));
  EXPECT_THAT(errorsOf("include = 5"),
              ElementsAre("m.map:1:11: include: found 5, expected the path of a file, or a list "
                          "of paths; write for example include = \"panel.map\""));
}

TEST(MapFile, OnlyRegularFilesAreRead) {
  std::vector<std::string> errors;
  loadMap("/dev/zero", errors);
  loadMap("/", errors);
  loadMap("/nowhere/m.map", errors);
  EXPECT_THAT(errors,
              ElementsAre("cannot read /dev/zero: it is not a regular file", "cannot read /: it is not a regular file",
                          "cannot read /nowhere/m.map: No such file or directory"));
}

} // namespace
} // namespace rung::mapping
