// Steps with devices at work allocate nothing.
#include <pty.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "ir/support/temporary_folder.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/io/host_devices_axis_bench.h"

namespace {

using rung::test::DeviceBench;

// What the steps of two seconds ask of the heap, with a bit that the program resets set in each of its scans.
int allocationsOf(DeviceBench& bench, std::initializer_list<const char*> bits) {
  std::vector<rung_cell> cells;
  for (const char* bit : bits) cells.push_back(bench.plc->find(bit, rung::Access::Write));
  int all = 0;
  for (int i = 0; i < 2000; ++i) {
    all += rung::test::allocationsOf([&] {
      for (const rung_cell cell : cells) bench.plc->write(cell, 1);
      bench.step();
    });
    if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return all;
}

TEST(DevicesOfAProgram, Can) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends), 0);
  DeviceBench bench("can.plc");
  ASSERT_EQ(bench.devices.configure("CAN[1].InOut08Cnt", "8"), "");
  bench.devices.adoptCan(2, ends[0]);
  bench.begin();
  EXPECT_EQ(allocationsOf(bench, {"DO1", "DO2", "DO3", "DO4", "DO5"}), 0);
  close(ends[1]);
}

TEST(DevicesOfAProgram, Com) {
  int master = -1, slave = -1;
  std::array<char, 64> name{};
  ASSERT_EQ(openpty(&master, &slave, name.data(), nullptr, nullptr), 0);
  DeviceBench bench("com.plc");
  ASSERT_EQ(bench.devices.setCom(std::string("1=") + name.data()), "");
  bench.begin();
  EXPECT_EQ(allocationsOf(bench, {"DO1", "DO2", "DO3"}), 0);
  close(slave);
  close(master);
}

TEST(DevicesOfAProgram, Axes) {
  rung::test::AxisBench bench("device-units.plc");
  bench.beginWith();
  bench.move(1000);
  EXPECT_EQ(allocationsOf(bench, {"TAKE", "BEGIN"}), 0);
  EXPECT_NE(bench.command(), 5) << "nothing has moved";
  bench.bit("fault") = true;
  EXPECT_EQ(allocationsOf(bench, {"TAKE", "BEGIN"}), 0);
}

TEST(DevicesOfAProgram, TablesAndAreas) {
  const rung::TemporaryFolder folder;
  const std::string table = folder / "tools.PlcT";
  std::ofstream(table) << rung::test::scenarioProgram("tools.PlcT");
  DeviceBench tables("tables.plc");
  ASSERT_EQ(tables.devices.configure("PlcTableDef3", "tests/scenarios/technol/tools.PlcTDef"), "");
  ASSERT_EQ(tables.devices.configure("PlcTable3", table), "");
  tables.begin();
  EXPECT_EQ(allocationsOf(tables, {"GO_REAL", "GO_STR", "GO_BIN", "GO_SET", "GO_COL"}), 0);
  DeviceBench areas("shared-area.plc");
  areas.begin();
  EXPECT_EQ(allocationsOf(areas, {"GO1", "GO2"}), 0);
}

} // namespace
