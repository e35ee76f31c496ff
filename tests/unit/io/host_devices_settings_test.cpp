// What names devices, and what is wrong with it.
#include <gmock/gmock.h>

#include "ir/support/temporary_folder.h"
#include "machine/host/binding.h"
#include "machine/io/analog/analog.h"
#include "tests/support/faultless_map.h"
#include "tests/unit/io/host_devices_bench.h"

namespace {

using namespace testing;
using rung::io::HostDevices;
using rung::test::DeviceBench;

TEST(DeviceSettings, Mistakes) {
  HostDevices devices;
  for (const char* wrong : {"", "can0", "0=can0", "3=can0", "x=can0", "2=", "=can0"})
    EXPECT_THAT(devices.setCan(wrong), HasSubstr("a CAN channel is 1=INTERFACE or 2=INTERFACE, not '")) << wrong;
  for (const char* wrong : {"/dev/ttyS0", "16=/dev/ttyS0", "-1=/dev/ttyS0", "1="})
    EXPECT_THAT(devices.setCom(wrong), HasSubstr("a serial port is NUMBER=DEVICE")) << wrong;
  EXPECT_THAT(devices.configure("COM[16].Active", "1"), HasSubstr("COM[0].Active to COM[15].Active"));
  EXPECT_THAT(devices.configure("COM[1].ComSpeed", "fast"), HasSubstr("COM[1].ComSpeed: ComSpeed: expected 50"));
  EXPECT_THAT(devices.configure("CAN[1].InOut08Cnt", "33"), HasSubstr("takes 0 to 32"));
  EXPECT_THAT(devices.configure("EtherCATOPViaPLC", "2"), HasSubstr("takes 0 or 1"));
  EXPECT_THAT(devices.configure("axes", "XYZ"), HasSubstr("'axes' is not a key of a device"));
  EXPECT_THAT(devices.configure("PlcTable256", "tests/no-such-file"),
              HasSubstr("256 is not the number of a PLC table"));
  EXPECT_THAT(devices.setSharedFile("/no/such/folder/file"), HasSubstr("cannot use /no/such/folder/file"));
}

// Without a device the instructions give the error of their section, and the program continues.
TEST(DeviceSettings, NothingIsNamed) {
  DeviceBench com("com.plc");
  com.begin();
  com.set("DO1", 1);
  EXPECT_TRUE(com.soonIs("FULL", 1));
  EXPECT_THAT(com.devices.report(), IsEmpty());
}

TEST(DeviceSettings, ConfiguredWithoutADevice) {
  DeviceBench bench("com.plc");
  EXPECT_EQ(bench.devices.configure("COM[1].Active", "1"), "");
  EXPECT_EQ(bench.devices.configure("CAN[1].InOut08Cnt", "1"), "");
  bench.begin();
  EXPECT_THAT(bench.devices.warnings(),
              ElementsAre(HasSubstr("CAN channel 2 is configured, but has no interface (--can, PhysicalCanChannel)"),
                          HasSubstr("the serial port 1 is configured, but has no device (--com, PhysicalComNo)")));
  bench.set("DO1", 1);
  EXPECT_TRUE(bench.soonIs("FULL", 1));
}

TEST(DeviceSettings, ATableThatCannotBeRead) {
  DeviceBench bench("tables.plc");
  EXPECT_EQ(bench.devices.configure("PlcTable3", "tests/no-such-file"), "");
  bench.begin();
  EXPECT_THAT(bench.devices.warnings(), ElementsAre(HasSubstr("tests/no-such-file")));
  bench.set("GO_INT", 1);
  EXPECT_TRUE(bench.soonIs("FAILED", 1));
  EXPECT_EQ(bench["CODE"], 1);
}

TEST(DeviceSettings, DevicesOfTheConfiguration) {
  DeviceBench bench("com.plc");
  EXPECT_EQ(bench.devices.configure("COM[1].Active", "1"), "");
  EXPECT_EQ(bench.devices.configure("COM[1].PhysicalComNo", "200"), "");
  bench.begin();
  EXPECT_THAT(bench.devices.warnings(), IsEmpty());
  EXPECT_TRUE(bench.soonReports("/dev/ttyS199 cannot be opened"));
}

// The control's own file says the same as the keys, and later keys override it.
TEST(DeviceSettings, OfTheChannelsFile) {
  const rung::TemporaryFolder folder;
  const std::string file = folder / "Channel0.ChannelConfig";
  std::ofstream(file) << "<ChannelConfig>\n<NCAxis No=\"3\" RefMethod=\"9\" FeedRT=\"3000\"></NCAxis>\n"
                         "<ComChannel No=\"1\" Active=\"1\" PhysicalComNo=\"200\" ComSpeed=\"19200\"></ComChannel>\n"
                         "<ComChannel No=\"2\" Active=\"1\" PhysicalComNo=\"200\"></ComChannel>\n</ChannelConfig>\n";
  DeviceBench bench("com.plc");
  EXPECT_EQ(bench.devices.configure("PlcConfig", file), "");
  EXPECT_EQ(bench.devices.configure("COM[2].PhysicalComNo", "201"), "");
  bench.begin();
  EXPECT_THAT(bench.devices.warnings(), IsEmpty());
  std::string all;
  EXPECT_TRUE(bench.soon([&] {
    for (const std::string& line : bench.devices.report()) all += line + '\n';
    return all.find("/dev/ttyS199 cannot be opened") != std::string::npos &&
           all.find("/dev/ttyS200 cannot be opened") != std::string::npos;
  })) << all;
}

TEST(DeviceSettings, MistakesOfTheChannelsFile) {
  const rung::TemporaryFolder folder;
  const std::string file = folder / "Channel0.ChannelConfig";
  HostDevices devices;
  EXPECT_THAT(devices.configure("PlcConfig", file), HasSubstr(file));
  std::ofstream(file) << "<ChannelConfig>\n  <ComChannel No=\"1\" ComSpeed=\"fast\"></ComChannel>\n</ChannelConfig>\n";
  EXPECT_THAT(devices.configure("PlcConfig", file), HasSubstr(file + ":2:3: COM[1].ComSpeed: ComSpeed: expected 50"));
}

TEST(DeviceSettings, OtherDialects) {
  rung::testing::CompiledProgram gsk("a.pmc", "dialect gsk\nFUNC END1\nFUNC END2\n");
  HostDevices devices;
  EXPECT_THROW(devices.instance(rung::Image::adopt(gsk.program()), rung::sized<rung_instance_options>()),
               std::runtime_error);
}

// An axis that the host does not move: the spindle is not positioned.
TEST(DeviceSettings, AxesAreRefused) {
  DeviceBench bench("spindles.plc");
  bench.begin();
  bench.set("AXIS", 9);
  bench.set("DO4", 1);
  EXPECT_TRUE(bench.soonIs("DO4", 0));
  EXPECT_EQ(bench["POLOHV_4"], 0);
  EXPECT_EQ(bench["PO_OS4PI"], 0);
  EXPECT_EQ(bench["POLOHV_9"], 0);
  EXPECT_TRUE(bench.soonReports("SPI_AX: this host cannot move axes"));
}

// 7FFFh is 10 V, 1 in SU_OUT_PLC.
TEST(DeviceSettings, AnalogueOutputs) {
  DeviceBench bench("spindles.plc");
  bench.begin();
  const rung_cell port6 = bench.plc->find("SU_OUT_PLC+40");
  bench.set("SPEED", 0x4000);
  bench.set("DO1", 1);
  EXPECT_TRUE(bench.soon([&] { return bench.plc->read<double>(port6) > 0.5; }));
  EXPECT_NEAR(bench.plc->read<double>(port6), 0x4000 / 32767.0, 1e-9);
}

TEST(DeviceSettings, PinsOfAnalogueOutputs) {
  using namespace rung;
  rung::testing::CompiledProgram spindles("spindles.plc", test::scenarioProgram("spindles.plc"));
  rung::testing::CompiledProgram can("can.plc", test::scenarioProgram("can.plc"));
  host::File map = test::faultlessMap("[out]\nanalog-out-6 = { type = \"bit\", name = \"P0OUT.0\" }\n");
  io::addAnalogPins(map, can.program());
  EXPECT_EQ(map.pins.size(), 1u);
  io::addAnalogPins(map, spindles.program());
  ASSERT_EQ(map.pins.size(), 16u);
  EXPECT_EQ(map.pins.back().name, "analog-out-16");
  EXPECT_EQ(map.pins.back().type, host::PinType::Float);
  Instance plc(Image::adopt(spindles.program()));
  std::vector<std::string> errors;
  const host::Binding bound = host::bindMap(map, plc.handle(), spindles.program(), errors);
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_EQ(bound.links.size(), 16u);
}

TEST(DeviceSettings, OfAMappingFile) {
  DeviceBench bench("com.plc");
  const rung::host::File map = rung::test::faultlessMap(
      "[devices]\ncom = { 1 = \"/dev/no-such-port\" }\ncan = { 3 = \"can0\" }\n[devices.config]\nTOOL_LIFE = 90\n");
  std::vector<std::string> errors;
  bench.devices.set(map, errors);
  EXPECT_THAT(errors,
              ElementsAre(HasSubstr(":3:13: devices: a CAN channel is 1=INTERFACE or 2=INTERFACE, not '3=can0'"),
                          HasSubstr(":5:13: devices: 'TOOL_LIFE' is not a key of a device")));
  bench.begin();
  EXPECT_TRUE(bench.soonReports("/dev/no-such-port cannot be opened"));
}

} // namespace
