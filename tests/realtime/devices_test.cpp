// What a host does with real devices of a TECHNOL program in a step, while all of them are at work: a CAN bus that is a
// socket pair, a serial port that is a pseudo terminal, tables in files, shared areas in memory, an axis.
#include <gtest/gtest.h>

#include <pty.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <thread>

#include "machine/io/host_devices.h"
#include "rung/runtime.hpp"
#include "tests/realtime/guard.h"

namespace rung::test {
namespace {

namespace fs = std::filesystem;

class DevicesInAStep : public testing::Test {
protected:
  DevicesInAStep() { fs::create_directories(folder_); }
  ~DevicesInAStep() override { fs::remove_all(folder_); }

  std::string inFolder(const std::string& name) const { return folder_ / name; }
  // A program of the scenarios, stepped for half a second with bits that it resets set again and again, and values that
  // it reads.
  void run(const std::string& program, std::initializer_list<const char*> bits,
           std::initializer_list<std::pair<const char*, int64_t>> values = {}) {
    const std::string object = inFolder(program + ".so");
    ASSERT_EQ(std::system((RUNG_TEST_RUNGC " build -q tests/scenarios/technol/" + program + " -o " + object).c_str()),
              0);
    const Image image(object);
    Instance plc = devices_.instance(image, sized<rung_instance_options>());
    plc.powerOn(Power::Cold);
    devices_.start();
    for (const auto& [name, value] : values) plc.write(plc.find(name, Access::Write), value);
    std::vector<rung_cell> cells;
    for (const char* bit : bits) cells.push_back(plc.find(bit, Access::Write));
    Guard guard;
    for (int i = 0; i < 500; ++i) {
      for (const rung_cell cell : cells) plc.write(cell, 1);
      {
        const Guarded guarded(guard);
        devices_.step(1'000'000);
        plc.runDue(1'000'000);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(guard.offences(), "");
    plc.powerOff();
    devices_.end();
  }

  io::HostDevices devices_;

private:
  fs::path folder_ = fs::temp_directory_path() / ("rung-devices-" + std::to_string(getpid()));
};

TEST_F(DevicesInAStep, Can) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends), 0);
  ASSERT_EQ(devices_.configure("CAN[1].InOut08Cnt", "8"), "");
  devices_.adoptCan(2, ends[0]);
  run("can.plc", {"DO1", "DO2", "DO3", "DO4", "DO5"});
  close(ends[1]);
}

TEST_F(DevicesInAStep, Com) {
  int master = -1, slave = -1;
  std::array<char, 64> name{};
  ASSERT_EQ(openpty(&master, &slave, name.data(), nullptr, nullptr), 0);
  ASSERT_EQ(devices_.setCom(std::string("1=") + name.data()), "");
  run("com.plc", {"DO1", "DO2", "DO3"});
  close(slave);
  close(master);
}

TEST_F(DevicesInAStep, Tables) {
  fs::copy_file("tests/scenarios/technol/tools.PlcT", inFolder("tools.PlcT"));
  ASSERT_EQ(devices_.configure("PlcTableDef3", "tests/scenarios/technol/tools.PlcTDef"), "");
  ASSERT_EQ(devices_.configure("PlcTable3", inFolder("tools.PlcT")), "");
  run("tables.plc", {"GO_REAL", "GO_STR", "GO_BIN", "GO_SET", "GO_COL"});
}

// An axis whose drive does what it is told.
TEST_F(DevicesInAStep, Axes) {
  host::File map;
  map.devices.push_back({host::DeviceSetting::Kind::Axis, "4", "table", {}});
  std::vector<std::string> errors;
  devices_.set(map, errors);
  devices_.addAxisPins(map, errors);
  ASSERT_TRUE(errors.empty());
  double place = 0; // where it is commanded to
  bool on = true, fault = false, enable = false;
  const auto cellOf = [&](const host::Pin& pin) -> host::PinCell {
    if (pin.type == host::PinType::Float) return {.real = &place};
    if (pin.direction == host::Direction::Out) return {.bit = &enable};
    return {.bit = pin.name.ends_with("fault") ? &fault : &on};
  };
  std::vector<host::PinCell> cells;
  for (const host::Pin& pin : map.pins) cells.push_back(cellOf(pin));
  devices_.connectAxes(cells.data(), host::kVariables);
  run("device-units.plc", {"TAKE", "BEGIN", "EACH", "ALLOW"},
      {{"AXIS", 4}, {"LEN", 1000}, {"ACC", 500}, {"FEED", int64_t{6000} << 16}});
  EXPECT_TRUE(enable);
  EXPECT_GT(place, 0);
}

TEST_F(DevicesInAStep, Areas) { run("shared-area.plc", {"GO1", "GO2"}); }

} // namespace
} // namespace rung::test
