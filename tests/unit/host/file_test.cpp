// The text of mapping files: what is read. What is said about each mistake is a golden (golden_test.cpp).
#include "machine/host/mapping_file.h"
#include "tests/support/faultless_map.h"
#include "tests/support/words.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace rung::host {
namespace {

using test::faultlessMap;

std::vector<Link> links(const File& map, Direction direction) {
  std::vector<Link> found;
  for (const Link& link : map.links)
    if (map.pins[link.pin].direction == direction) found.push_back(link);
  return found;
}
std::vector<Link> inputs(const File& map) { return links(map, Direction::In); }
std::vector<Link> outputs(const File& map) { return links(map, Direction::Out); }

// Files by their paths.
ReadFile files(std::map<std::string, std::string> texts) {
  return [texts = std::move(texts)](const std::string& path) {
    const auto found = texts.find(path);
    if (found == texts.end()) throw std::runtime_error("cannot read " + path + ": No such file or directory");
    return found->second;
  };
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
  EXPECT_EQ(map.pins[0].at, (text::Position{6, 1}));
  EXPECT_EQ(map.pins[1].name, "feed.1");
  EXPECT_EQ(map.pins[1].type, PinType::Float);
  EXPECT_EQ(map.pins[1].direction, Direction::Out);
  ASSERT_EQ(inputs(map).size(), 1u);
  EXPECT_EQ(inputs(map)[0].name, "X0.0");
  EXPECT_EQ(inputs(map)[0].scale, 1);
  EXPECT_EQ(inputs(map)[0].at, (text::Position{6, 32}));
  ASSERT_EQ(outputs(map).size(), 1u);
  EXPECT_EQ(outputs(map)[0].pin, 1u);
  EXPECT_EQ(outputs(map)[0].name, "AN_FEED,#1");
  EXPECT_EQ(outputs(map)[0].scale, -0.5);
  ASSERT_EQ(map.constants.size(), 1u);
  EXPECT_EQ(map.constants[0].name, "D4:4");
  EXPECT_EQ(map.constants[0].value, -12);
  EXPECT_EQ(map.constants[0].at, (text::Position{12, 1}));
  ASSERT_EQ(map.sends.size(), 2u);
  EXPECT_EQ(map.pins[map.sends[0].edge.pin].name, "spindle-on");
  EXPECT_FALSE(map.sends[0].edge.rising);
  EXPECT_EQ(map.sends[0].kind, RUNG_FUNCTION_M);
  EXPECT_EQ(map.sends[0].code, 5);
  EXPECT_FALSE(map.sends[0].codePin.has_value());
  EXPECT_FALSE(map.sends[0].donePin.has_value());
  EXPECT_EQ(map.sends[0].at, (text::Position{14, 1}));
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
  EXPECT_EQ(map.highSpeed, (text::Position{3, 14}));
}

TEST(MapFile, NothingIsNeeded) {
  const File map = faultlessMap("high-speed = false\n[in]\n");
  EXPECT_TRUE(map.pins.empty());
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
  EXPECT_EQ(test::joined(names), "zulu\nalpha\nmike\n"); // table for table
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
  EXPECT_EQ(inputs(map)[1].at, (text::Position{2, 41}));
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

TEST(MapFile, AxisGroups) {
  const File map = faultlessMap("[axis-groups]\n4 = \"A\"\n1 = \"H\"\n");
  ASSERT_EQ(map.axisGroups.size(), 2u);
  EXPECT_EQ(map.axisGroups[0].axis, 3u);
  EXPECT_EQ(map.axisGroups[0].group, 0u);
  EXPECT_EQ(map.axisGroups[1].axis, 0u);
  EXPECT_EQ(map.axisGroups[1].group, 7u);
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
  EXPECT_TRUE(map.pins.empty()); // the host that moves axes makes them
}

TEST(MapFile, TheLongestTime) { EXPECT_EQ(faultlessMap("timeout = 1000000").timeoutNs, 1'000'000'000'000'000); }

TEST(MapFile, BytesThatAreNoTextEndTheReading) {
  std::vector<std::string> errors;
  parseMap("\xFF", "m.map", errors);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(errors[0].starts_with("m.map:1:1: ")) << errors[0];
}

TEST(MapFile, AFirstFileThatIsNotThereIsTheOnlyMistake) {
  std::vector<std::string> errors;
  EXPECT_TRUE(loadMap("none.map", errors, files({})).paths.empty());
  EXPECT_EQ(errors, std::vector<std::string>{"cannot read none.map: No such file or directory"});
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
  EXPECT_EQ(map.links[0].bits, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
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

TEST(MapFile, WhatRungctlMayDo) {
  const File map = faultlessMap("[rungctl]\npermissions = [\"set\", \"stop\"]\nprotected = [\"X0.0\", \"ESTOP\"]\n");
  EXPECT_TRUE(map.permissions[static_cast<size_t>(Remote::Set)]);
  EXPECT_TRUE(map.permissions[static_cast<size_t>(Remote::Stop)]);
  EXPECT_FALSE(map.permissions[static_cast<size_t>(Remote::Force)]);
  ASSERT_EQ(map.protectedCells.size(), 2u);
  EXPECT_EQ(map.protectedCells[1].name, "ESTOP");
  EXPECT_EQ(map.protectedCells[1].at, (text::Position{3, 22}));
}

TEST(MapFile, Includes) {
  std::vector<std::string> errors;
  const File map = loadMap("maps/m.map", errors,
                           files({{"maps/m.map", "include = [\"panel.map\", \"/shared/axes.map\"]\n"
                                                 "in.a = { type = \"bit\", name = \"X0.0\" }\n"},
                                  {"maps/panel.map", "in.b = { type = \"bit\", name = \"X0.1\" }\n"},
                                  {"/shared/axes.map", "timeout = 5\nin.c = { type = \"bit\", name = \"X0.2\" }\n"}}));
  EXPECT_EQ(test::joined(errors), "");
  EXPECT_EQ(test::joined(map.paths), "maps/m.map\nmaps/panel.map\n/shared/axes.map\n");
  ASSERT_EQ(map.pins.size(), 3u);
  EXPECT_EQ(map.pins[0].name, "b");
  EXPECT_EQ(map.pins[1].name, "c");
  EXPECT_EQ(map.pins[2].name, "a");
  EXPECT_EQ(map.timeoutNs, 5'000'000'000);
}

} // namespace
} // namespace rung::host
