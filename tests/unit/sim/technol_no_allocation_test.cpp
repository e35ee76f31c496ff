// Scans beside the simulated TECHNOL control allocate nothing, whatever its devices do: axes that move, packets,
// service data of drives, serial ports, mailboxes, process data, keys, displays, tables and shared areas.
#include <gtest/gtest.h>

#include <fstream>

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/technol/services.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/sim/technol_machine.h"

namespace {

using namespace rung;
using namespace rung::sim;
using rung::test::allocationsOf;

TEST(TechnolNoAllocation, DevicesAtWork) {
  const std::string keys = testing::TempDir() + "rung_no_allocation.KbdConfig";
  std::ofstream(keys) << R"(<KeyboardConfig><KeyConfig ScanCode="22" PlcCommand="TAP" RtmCommand="RTMID_MMM_MOVE01"/>
    <KeyConfig ScanCode="23" RtmCommand="RTMID_KEYB6_FUNCTION1_TOGGLE"/></KeyboardConfig>)";
  TechnolMachine machine({{"nc", "simulated"},
                          {"const.TAP", "7"},
                          {"KbdConfig6", keys},
                          {"CAN[1].InOut08Cnt", "32"},
                          {"CAN[1].Kla50Cnt", "4"},
                          {"CAN[1].KnobCnt", "2"},
                          {"CAN[0].Drives", "3"},
                          {"COM[1].Active", "1"},
                          {"ethercat.0", "coe"},
                          {"ethercat.0.name", "DRIVE"},
                          {"ethercat.0.ds402", "1"},
                          {"ethercat.0.pdo.Inputs.Status", "0x6041.0"},
                          {"ethercat.0.pdo.Outputs.Control", "0x6040.0"}},
                         {{"P1IN.0", "VKeyboard.VKey[22]"},
                          {"P1IN.1", "VKeyboard.VKey[23]"},
                          {"ECAT.DRIVE.Inputs.Status", "RTM.Servo[0].Edrv.DriveStatus"},
                          {"RTM.Servo[0].Edrv.DriveControl", "ECAT.DRIVE.Outputs.Control"},
                          {"RTM.Axis[3].Pos6_Ax", "ECAT.FREE.Outputs.Place"}});
  EXPECT_TRUE(machine.nc().connectionProblems().empty());
  const auto place = [&](const char* cell) { return nc::technol::locateSignal(machine.inside().program(), cell); };
  const core::Place port = place("P1IN"), character = place("DISPTOC1.TOC_CHAR1"), init = place("flEdrvInit0");
  constexpr int64_t kFeed = int64_t{6000} << 16; // 6000 mm/min
  for (const char* cell : {"VAZBA_4", "MP4PI"}) nc::technol::writeCell(machine.inside(), cell, 1);
  machine.ask(kInit, {4, 0});
  machine.ask(kMode, {1'000'000, 500, 4});
  machine.scan(); // what is written to a message or a text for the first time
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < 10'000; ++i) {
                machine.ask(kSend, {2, 0x10, 0, 2, nc::technol::bytesArgument(0, 2, 0)});
                machine.ask(kDrive, {1, nc::technol::bytesArgument(0, 8, 0)});
                machine.ask(kCom, {1, 'A'});
                machine.ask(kControl, {kFeed, 1, 4});
                machine.ask(kAnalog, {i, 1});
                const uint32_t read = machine.ask(kRead, {0, 100, 1000});
                machine.ask(kData, {read, 3});
                machine.ask(kUpload, {0, 0, 0x6041, 0, 2});
                machine.inside().memory().write(port, static_cast<uint64_t>(i / 3 & 3));
                machine.inside().memory().write(character, static_cast<uint64_t>('A' + i % 26));
                machine.inside().memory().write(init, 1);
                machine.scan();
              }
            }),
            0);
  EXPECT_NEAR(machine.nc().quantity("MPOS.4").value_or(0), 1000, 0.001);
  EXPECT_EQ(machine.inside().memory().read(init), 0u) << "the servo is connected";
  EXPECT_FALSE(machine.nc().readCell("DISPTOC1.Shown[0][0]")->text.empty());
}

constexpr int64_t kUnits = 32, kPositioningUnits = 6, kPorts = 4, kSlaves = 8;

TechnolMachine::Pairs configurationOfAll() {
  TechnolMachine::Pairs config = {{"nc", "simulated"},
                                  {"axes", "XYZABCS"},
                                  {"CAN[1].InOut08Cnt", std::to_string(kUnits)},
                                  {"CAN[0].Drives", std::to_string(kPositioningUnits)}};
  for (int port = 0; port < kPorts; ++port) config.emplace_back("COM[" + std::to_string(port) + "].Active", "1");
  for (int slave = 0; slave < kSlaves; ++slave) {
    const std::string key = "ethercat." + std::to_string(slave);
    config.emplace_back(key, "coe");
    config.emplace_back(key + ".coe.0x6041.0", "0x237/2 ro");
  }
  return config;
}

// What a program asks for in one scan, of as many devices as a control has at most.
void askForAll(TechnolMachine& machine, int64_t number) {
  constexpr int64_t kFeed = int64_t{6000} << 16; // 6000 mm/min
  machine.ask(kSend, {2, 0x10, 0, 2, nc::technol::bytesArgument(0, 2, 0)});
  machine.ask(kReceive, {2});
  for (int64_t board = 1; board <= kUnits; ++board) machine.ask(kItem, {2, 1, board, 0});
  machine.ask(kDrive, {1 + number % kPositioningUnits, nc::technol::bytesArgument(0, 8, 0)});
  for (int64_t axis = 1; axis <= kPositioningUnits; ++axis) machine.ask(kControl, {kFeed, 1, axis});
  machine.ask(kAnalog, {number, kPositioningUnits + 1});
  for (int64_t port = 0; port < kPorts; ++port) {
    machine.ask(kCom, {port, 'A'});
    machine.ask(kComReceive, {port});
  }
  const uint32_t read = machine.ask(kRead, {0, 100, 1000});
  machine.ask(kData, {read, 3});
  for (int64_t slave = 0; slave < kSlaves; ++slave) machine.ask(kUpload, {0, slave, 0x6041, 0, 2});
}

TEST(TechnolNoAllocation, AsManyDevicesAsAControlHas) {
  TechnolMachine machine(configurationOfAll());
  for (int64_t axis = 1; axis <= kPositioningUnits; ++axis) {
    const std::string name = axis <= 3 ? std::string(1, "XYZ"[axis - 1]) : std::to_string(axis);
    nc::technol::writeCell(machine.inside(), "VAZBA_" + name, 1);
    nc::technol::writeCell(machine.inside(), "MP" + name + "PI", 1);
    machine.ask(kInit, {axis, 0});
    machine.ask(kMode, {1'000'000, 500, axis});
  }
  machine.scan(); // what is written to a message or a text for the first time
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < 10'000; ++i) {
                askForAll(machine, i);
                machine.scan();
              }
            }),
            0);
  for (int axis = 1; axis <= kPositioningUnits; ++axis)
    EXPECT_NEAR(machine.nc().quantity("MPOS." + std::to_string(axis)).value_or(0), 1000, 0.001);
  EXPECT_EQ(machine.inside().services().refused(), 0u);
}

} // namespace
