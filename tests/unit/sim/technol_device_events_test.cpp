// What a scenario may say to the CAN bus, the serial ports and EtherCAT of the simulated TECHNOL control: each mistake
// has a message that says what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim/technol_machine.h"

namespace {

using namespace rung;
using namespace rung::sim;
using testing::HasSubstr;

NcArgument key(std::string name, int64_t value) { return {.key = std::move(name), .integer = value}; }
NcArgument quoted(std::string name, const char* value) {
  return {.key = std::move(name), .isText = true, .text = value};
}
NcArgument real(std::string name, double value) { return {.key = std::move(name), .isReal = true, .real = value}; }

// One of each device.
class DeviceEvents : public testing::Test {
protected:
  explicit DeviceEvents(const char* nc = "simulated")
      : machine_({{"nc", nc},
                  {"CAN[1].InOut08Cnt", "1"},
                  {"CAN[0].Drives", "1"},
                  {"COM[1].Active", "1"},
                  {"ethercat.0", "coe"},
                  {"ethercat.0.ds402", "1"}}) {
    machine_.scan();
  }

  std::string event(const char* name, const std::vector<NcArgument>& keys) { return machine_.event(name, keys); }
  std::string sent(const char* port, const std::vector<NcArgument>& keys) {
    return machine_.nc().expectSent(port, keys);
  }
  std::string set(const char* quantity, double value) { return machine_.nc().setQuantity(quantity, value); }

private:
  TechnolMachine machine_;
};

struct ScriptedEvents : DeviceEvents {
  ScriptedEvents() : DeviceEvents("scripted") {}
};

TEST_F(DeviceEvents, PacketsOfTheBus) {
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 0x123), quoted("data", "01 02")}), "");
  EXPECT_EQ(event("can", {key("CAN", 2), key("id", 0x123), key("rtr", 1), key("len", 4)}), "");
  EXPECT_EQ(event("CAN", {key("can", 3), key("id", 1)}), "CAN: 'can' takes 1 to 2");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 0x10001)}), "CAN: 'id' takes 0 to 0x7FF");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", -1)}), "CAN: 'id' takes 0 to 0x7FF");
  EXPECT_EQ(event("CAN", {key("can", 2), quoted("id", "1")}), "CAN: 'id' takes 0 to 0x7FF");
  EXPECT_EQ(event("CAN", {key("can", 2), real("id", 1.5)}), "CAN: 'id' takes 0 to 0x7FF");
  EXPECT_EQ(event("CAN", {key("can", 2), quoted("data", "01")}), "CAN: 'id' is missing");
  EXPECT_EQ(event("CAN", {key("id", 1), quoted("data", "01")}), "CAN: 'can' is missing");
  EXPECT_EQ(event("CAN", {key("can", 1), key("id", 1), key("CAN", 2)}), "CAN: 'can' is given twice");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 1), key("data", 5)}), "CAN: 'data' takes a text in quotes");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 1), key("rtr", 2)}), "CAN: 'rtr' takes 0 to 1");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 1), quoted("data", "5")}),
            "CAN: data is pairs of hexadecimal digits, as \"02 55\"");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 1), quoted("data", "01 02 03 04 05 06 07 08 09")}),
            "CAN: a packet has at most 8 bytes of data");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 1), quoted("data", "01 02"), key("len", 1)}),
            "CAN: data has more bytes than len says");
  EXPECT_EQ(event("CAN", {key("can", 2), key("id", 1), key("ID2", 1)}), "CAN has no 'ID2': it has can id rtr data len");
}

TEST_F(DeviceEvents, UnitsDrivesAndTheBus) {
  EXPECT_EQ(event("CAN_UNIT", {key("group", 1), key("board", 1), key("error", 4)}), "");
  EXPECT_THAT(event("CAN_UNIT", {key("group", 1), key("board", 2), key("error", 4)}), HasSubstr("there is no unit"));
  EXPECT_EQ(event("CAN_UNIT", {key("group", 4), key("board", 1), key("error", 4)}), "CAN_UNIT: 'group' takes 1 to 3");
  EXPECT_EQ(event("CAN_UNIT", {key("group", 1), key("board", 1), key("error", 0x104)}),
            "CAN_UNIT: 'error' takes 0 to 255");
  EXPECT_EQ(event("CAN_UNIT", {key("group", 1), key("board", 1), key("silent", 2)}), "CAN_UNIT: 'silent' takes 0 to 1");
  EXPECT_THAT(event("CAN_UNIT", {key("group", 1), key("board", 1)}), HasSubstr("it changes nothing"));
  EXPECT_EQ(event("CAN_DRIVE", {key("drive", 1), key("fault", 0x8611), key("hold", 1)}), "");
  EXPECT_THAT(event("CAN_DRIVE", {key("drive", 2), key("fault", 1)}), HasSubstr("there is no drive 2"));
  EXPECT_EQ(event("CAN_DRIVE", {key("drive", 1), key("mstat", 0x10000)}), "CAN_DRIVE: 'mstat' takes 0 to 0xFFFF");
  EXPECT_THAT(event("CAN_DRIVE", {key("drive", 1)}), HasSubstr("it changes nothing"));
  EXPECT_THAT(event("CAN_DRIVE", {key("drive", 1), key("hold", 1)}), HasSubstr("'fault' is missing"));
  EXPECT_EQ(event("CAN_DRIVE", {key("drive", 1), key("fault", 0), key("hold", 0)}), "");
  EXPECT_EQ(event("CAN_BUS", {key("can", 2)}), "") << "off";
  EXPECT_EQ(event("CAN_BUS", {key("off", 1)}), "CAN_BUS: 'can' is missing");
}

TEST_F(DeviceEvents, SerialPorts) {
  EXPECT_EQ(event("COM", {key("com", 1), quoted("text", "12\\r\\x41")}), "");
  EXPECT_EQ(event("COM", {key("com", 1), key("error", 1)}), "");
  EXPECT_EQ(event("COM", {key("com", 2), quoted("text", "1")}), "COM: the serial port 2 is not active");
  EXPECT_EQ(event("COM", {key("com", 16), quoted("text", "1")}), "COM: 'com' takes 0 to 15");
  EXPECT_EQ(event("COM", {key("com", 1)}), "COM: text or data is missing");
  EXPECT_EQ(event("COM", {key("com", 1), quoted("text", "1"), quoted("data", "31")}), "COM: either text or data");
  EXPECT_EQ(event("COM", {key("com", 1), quoted("text", "1"), key("error", 1)}), "COM: either error or bytes");
  EXPECT_THAT(event("COM", {key("com", 1), quoted("text", "\\q")}), HasSubstr("\\r, \\n, \\t"));
  EXPECT_THAT(event("COM", {key("com", 1), quoted("text", "\\x4")}), HasSubstr("hexadecimal"));
}

TEST_F(DeviceEvents, EtherCat) {
  EXPECT_EQ(event("ethercat", {key("device", 0), key("error", 0x08000022)}), "");
  EXPECT_EQ(event("ethercat", {key("link", 0)}), "");
  EXPECT_THAT(event("ethercat", {key("device", 1), key("error", 5)}), HasSubstr("no EtherCAT device 1"));
  EXPECT_EQ(event("ethercat", {key("device", 0), key("fault", 0x10000)}), "ethercat: 'fault' takes 0 to 0xFFFF");
  EXPECT_THAT(event("ethercat", {key("device", 0)}), HasSubstr("it changes nothing"));
  EXPECT_THAT(event("ethercat", {key("error", 5)}), HasSubstr("'device' comes with"));
  EXPECT_THAT(event("ethercat", {key("device", 0), key("link", 0)}), HasSubstr("'device' comes with"));
}

TEST_F(DeviceEvents, WhatHasBeenSent) {
  EXPECT_EQ(sent("CAN[1]", {key("none", 1)}), "");
  EXPECT_EQ(sent("CAN[1]", {key("id", 1)}), "no packet has been sent");
  EXPECT_EQ(sent("CAN[1]", {}), "what is expected is missing: keys, or none");
  EXPECT_EQ(sent("CAN[1]", {key("idd", 1)}), "CAN[1] has no 'idd': it has id rtr data len");
  EXPECT_EQ(sent("CAN[1]", {key("id", 0x800)}), "CAN[1]: 'id' takes 0 to 0x7FF");
  EXPECT_EQ(sent("CAN[2]", {key("none", 1)}), "there is no port 'CAN[2]'");
  EXPECT_EQ(sent("CAN[1]x", {key("none", 1)}), "there is no port 'CAN[1]x'");
  EXPECT_EQ(sent("COM[1]", {quoted("text", "A")}), "sent is nothing");
  EXPECT_EQ(sent("COM[1]", {quoted("txt", "A")}), "COM[1] has no 'txt': it has text data");
  EXPECT_THAT(sent("LPT[1]", {quoted("text", "A")}), HasSubstr("ports are COM[n] and CAN[n]"));
}

TEST_F(DeviceEvents, QuantitiesThatDevicesMake) {
  EXPECT_EQ(set("ETHERCAT.0.0x6040.0", 6), "");
  EXPECT_EQ(set("ETHERCAT.0.0x9999.0", 6), "there is no such object");
  for (const char* name : {"ECSTATE", "ECSTATE.0", "DRIVE.1.0x6041.0"})
    EXPECT_THAT(set(name, 4), HasSubstr("it is what a device does")) << name;
}

TEST_F(ScriptedEvents, PacketsAlone) {
  EXPECT_EQ(event("CAN", {key("can", 1), key("id", 0x5A1), quoted("data", "01")}), "");
  EXPECT_EQ(event("COM", {key("com", 1), quoted("text", "1")}),
            "COM is of simulated devices: `config nc simulated` is missing");
}

TEST(DeviceConfiguration, ThereAreTwoChannels) {
  const auto nc = makeSimulatedTechnol();
  for (const char* wrong : {"CAN[2].Active", "CAN[x].Active", "CAN[12].INOUT08[0].CONTROL"})
    EXPECT_THAT(nc->config(wrong, "1"), HasSubstr("channels are CAN[0] and CAN[1]")) << wrong;
  EXPECT_EQ(nc->config("CAN[00].Active", "1"), "");
}

} // namespace
