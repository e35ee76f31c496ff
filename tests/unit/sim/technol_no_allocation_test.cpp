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
  const rt::Place port = place("P1IN"), character = place("DISPTOC1.TOC_CHAR1"), init = place("flEdrvInit0");
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

} // namespace
