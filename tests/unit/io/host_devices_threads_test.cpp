// The threads that serve devices: signals are for the thread that waits for them, and real-time priority is the scan's.
#include <pty.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <set>
#include <thread>

#include "ir/support/temporary_folder.h"
#include "rtlib/run/realtime.h"
#include "tests/unit/io/host_devices_bench.h"

namespace {

using rung::test::DeviceBench;

std::set<pid_t> threads() {
  std::set<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task"))
    found.insert(std::stoi(entry.path().filename()));
  return found;
}

std::string signalsBlockedBy(pid_t thread) {
  std::ifstream status("/proc/self/task/" + std::to_string(thread) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigBlk:\t")) return line.substr(8);
  return {};
}

// All but SIGKILL, SIGSTOP and the two of the C library.
constexpr const char* kAllSignals = "fffffffe7ffbfeff";

TEST(ThreadsOfDevices, GetNoSignalsAndNoPriority) {
  int bus[2], master = -1, slave = -1;
  std::array<char, 64> name{};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, bus), 0);
  ASSERT_EQ(openpty(&master, &slave, name.data(), nullptr, nullptr), 0);
  const rung::TemporaryFolder folder;
  const std::string table = folder / "tools.PlcT";
  std::ofstream(table) << rung::test::scenarioProgram("tools.PlcT");
  {
    DeviceBench bench("tables.plc");
    ASSERT_EQ(bench.devices.configure("PlcTableDef3", "tests/scenarios/technol/tools.PlcTDef"), "");
    ASSERT_EQ(bench.devices.configure("PlcTable3", table), "");
    ASSERT_EQ(bench.devices.setCom(std::string("1=") + name.data()), "");
    std::thread([] {}).join(); // a sanitizer starts one of its own with the first
    const std::set<pid_t> before = threads();
    {
      const rung::runtime::RealTimeThread raised({.priority = 1}); // where the system grants it
      bench.devices.adoptCan(2, bus[0]);
      bench.begin();
    }
    uint32_t count = 0;
    for (const pid_t thread : threads()) {
      if (before.contains(thread)) continue;
      ++count;
      EXPECT_TRUE(bench.soon([&] { return signalsBlockedBy(thread) == kAllSignals; })) << signalsBlockedBy(thread);
      EXPECT_TRUE(bench.soon([&] { return sched_getscheduler(thread) == SCHED_OTHER; }));
    }
    EXPECT_EQ(count, 3u) << "CAN, serial ports, tables";
  }
  close(bus[1]);
  close(slave);
  close(master);
}

} // namespace
