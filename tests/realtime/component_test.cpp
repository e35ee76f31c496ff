// The component of LinuxCNC with another HAL around it: what its scan does in real time, and that loading and unloading
// leave nothing, wherever they fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ir/support/temporary_folder.h"
#include "tests/realtime/fake_hal.h"
#include "tests/realtime/guard.h"
#include "tests/support/patience.h"

namespace rung::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

constexpr int64_t kMs = 1'000'000;

// Message 99 at each scan while SHOW is on; MODULE_DONE switches LAMP off.
constexpr const char* kMessages = R"(DATA
        DFM SHOW,LAMP
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
        LDR SHOW
        ESET1 99
        FL 1,LAMP
MODULE_MAIN_END
MODULE_INIT
MODULE_INIT_END
MODULE_DONE
MODULE_DONE_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
)";
constexpr const char* kMessagesMap = "in.show = { type = \"bit\", name = \"SHOW\" }\n"
                                     "out.lamp = { type = \"bit\", name = \"LAMP\" }\n";

// RUNS is on; at its end the program switches it off and waits until ANSWERS is off too, for half a second.
constexpr const char* kEnding = R"(DATA
        DFM RUNS,ANSWERS
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
        MECH_BEGIN SHUT
        FL 0,RUNS
        EX
        LDR -ANSWERS
        TEX0 -,25,LATE,99
        JUM  GOOD
LATE:   ESET 99
GOOD:   MODULE_DONE_FINISHED
        MECH_END SHUT
MODULE_MAIN_END
MODULE_INIT
        FL 1,RUNS
MODULE_INIT_END
MODULE_DONE
        FL 1,SHUT
MODULE_DONE_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
)";
constexpr const char* kEndingMap = "in.answers = { type = \"bit\", name = \"ANSWERS\" }\n"
                                   "out.runs = { type = \"bit\", name = \"RUNS\" }\n";

size_t entriesOf(const char* folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}
size_t openFiles() { return entriesOf("/proc/self/fd"); }
size_t threads() { return entriesOf("/proc/self/task"); }

class Component : public testing::Test {
protected:
  // A GSK program that never ends while pin stick is on, and one of TECHNOL that shows messages.
  static void SetUpTestSuite() {
    built = std::make_unique<TemporaryFolder>();
    setenv("RUNG_SOCKETS", path("sockets").c_str(), 1); // other tests have components, too
    write("messages.plc", kMessages);
    write("messages.map", kMessagesMap);
    write("ending.plc", kEnding);
    write("ending.map", kEndingMap);
    build(path("ending.plc"), "ending.so");
    build("tests/cnc/stuck.pmc", "stuck.so");
    build(path("messages.plc"), "messages.so");
  }
  static void TearDownTestSuite() { built.reset(); }

  static std::string path(const char* name) { return (*built / name).string(); }
  static void write(const char* name, const std::string& text) { std::ofstream(*built / name) << text; }
  static void build(const std::string& source, const char* object) {
    const std::string command = std::string(RUNG_TEST_RUNGC) + " build -q " + source + " -o " + path(object);
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }

  // What rungctl says of it.
  static std::string statusText() {
    const fs::path rungctl = fs::path(RUNG_TEST_RUNGC).parent_path() / "rungctl";
    EXPECT_EQ(std::system((rungctl.string() + " status > " + path("status")).c_str()), 0);
    return built->contentsOf("status").value_or("");
  }

  int loadStuck(const std::string& retain = {}) { return hal.load(path("stuck.so"), "tests/cnc/stuck.map", retain); }
  int loadMessages() { return hal.load(path("messages.so"), path("messages.map")); }

  volatile bool& bit(const char* name) { return hal.value<bool>(std::string("rung.") + name); }
  volatile uint32_t& number(const char* name) { return hal.value<uint32_t>(std::string("rung.") + name); }

  // Milliseconds of a servo thread, under the guard.
  void scan(int ms) {
    const FakeHal::Function function = hal.function("rung.scan");
    Guard guard;
    for (int i = 0; i < ms; ++i) {
      const Guarded realTime(guard);
      function.call(kMs);
    }
    EXPECT_EQ(guard.offences(), "");
  }
  // Where something else than the scan is at work.
  template <class Condition>
  bool scanUntil(Condition condition) {
    return soon([&] { return scan(1), condition(); }, std::chrono::milliseconds(5));
  }

  // Waits for that many calls of the running thread.
  bool runs(uint64_t calls) {
    const uint64_t before = hal.calls();
    return soon([&] { return hal.calls() >= before + calls; });
  }

  void expectNothingLeft() {
    EXPECT_TRUE(hal.empty());
    EXPECT_EQ(hal.initialised(), 0);
    EXPECT_EQ(openFiles(), filesBefore);
    // The kernel may list a thread for a moment after it has been joined.
    EXPECT_TRUE(soon([&] { return threads() == threadsBefore; })) << threads() << " threads, before " << threadsBefore;
  }

  static std::unique_ptr<TemporaryFolder> built;
  size_t filesBefore = openFiles();
  size_t threadsBefore = threads();
  FakeHal hal;
};

std::unique_ptr<TemporaryFolder> Component::built;

TEST_F(Component, ScansBetweenItsPins) {
  ASSERT_EQ(loadStuck(), 0);
  bit("run") = true;
  number("number") = 7;
  scan(7);
  EXPECT_EQ(number("scans"), 0u);
  scan(1);
  EXPECT_EQ(number("scans"), 1u);
  EXPECT_TRUE(bit("lamp"));
  EXPECT_EQ(hal.value<double>("rung.value"), 7);
  EXPECT_FALSE(bit("fault"));
  hal.unload();
  EXPECT_THAT(hal.lines(), IsEmpty());
  EXPECT_THAT(hal.bitsAtExit(), ElementsAre("rung.run")); // an input, which is HAL's
  expectNothingLeft();
}

TEST_F(Component, FillsTheCellsOfItsPins) {
  ASSERT_EQ(loadStuck(), 0);
  bit("run") = true;
  volatile uint64_t& scans = hal.value<uint64_t>("rung.scans");
  volatile uint64_t& lamp = hal.value<uint64_t>("rung.lamp");
  scans = ~uint64_t{0};
  lamp = ~uint64_t{0};
  scan(8);
  EXPECT_EQ(scans, FakeHal::hasReferences() ? 1 : 0xffff'ffff'0000'0001);
  EXPECT_EQ(lamp, FakeHal::hasReferences() ? 1 : 0xffff'ffff'ffff'ff01);
  hal.unload();
}

TEST_F(Component, AFaultIsReportedAndResetRestarts) {
  ASSERT_EQ(loadStuck(), 0);
  bit("run") = true;
  scan(8);
  bit("stick") = true;
  scan(8);
  EXPECT_TRUE(bit("fault"));
  EXPECT_FALSE(bit("lamp"));
  EXPECT_EQ(number("fault-line"), 10u) << "who waits for `fault` finds the line";
  ASSERT_TRUE(scanUntil([&] { return !hal.lines().empty(); })); // the service says it
  EXPECT_THAT(hal.lines(), ElementsAre(HasSubstr(" the program has stopped: ")));
  EXPECT_THAT(hal.lines()[0], HasSubstr("dead-loop (rung 3, tests/cnc/stuck.pmc:10)"));
  bit("stick") = false;
  scan(100);
  EXPECT_TRUE(bit("fault")); // nobody has asked
  bit("reset") = true;
  ASSERT_TRUE(scanUntil([&] { return !bit("fault"); }));
  scan(8);
  EXPECT_TRUE(bit("lamp"));
  EXPECT_THAT(hal.lines(), Contains(HasSubstr(" the program has been restarted")));
  EXPECT_EQ(hal.errors(), 0u);
  hal.unload();
  expectNothingLeft();
}

// The parameter is in microseconds; the program would use its budget up much later.
TEST_F(Component, MaxTimeStopsTheProgram) {
  ASSERT_EQ(loadStuck(), 0);
  number("max-time") = 1;
  bit("stick") = true;
  scan(8);
  EXPECT_TRUE(bit("fault"));
  ASSERT_TRUE(scanUntil([&] { return !hal.lines().empty(); }));
  EXPECT_THAT(hal.lines()[0], HasSubstr("max-time: the slice took longer than the limit of its host ("));
  hal.unload();
  expectNothingLeft();
}

TEST_F(Component, MessagesArePrintedByTheService) {
  ASSERT_EQ(loadMessages(), 0);
  bit("show") = true;
  scan(60);
  EXPECT_TRUE(scanUntil([&] { return !hal.lines().empty(); }));
  EXPECT_THAT(hal.lines(), Contains(HasSubstr(" message ")));
  EXPECT_THAT(hal.lines(), Contains(HasSubstr("99")));
  EXPECT_EQ(hal.errors(), 0u) << "rung-operator shows them, as many as LinuxCNC takes";
  EXPECT_TRUE(bit("lamp"));
  hal.unload();
  EXPECT_THAT(hal.bitsAtExit(), ElementsAre("rung.show"));
  expectNothingLeft();
}

// Axis 4 of the program is a joint of which the test is the drive: feedback is the last command.
class AxisAtPins : public Component {
protected:
  void SetUp() override {
    build("tests/scenarios/technol/device-units.plc", "axes.so");
    write("axes.map", R"(
[in]
take = { type = "bit", name = "TAKE" }
begin = { type = "bit", name = "BEGIN" }
fail = { type = "bit", name = "FAULT" }
[out]
reached = { type = "bit", name = "POL" }
error = { type = "bit", name = "ERR" }
[const]
AXIS = 4
LEN = 100000
ACC = 500
FEED = 393216000
ALLOW = true
EACH = true
[devices.axes]
4 = { pins = "table", AccelerationEmergency = 4000 }
)");
    ASSERT_EQ(hal.load(path("axes.so"), path("axes.map")), 0);
    real("position-feedback") = 5;
    for (const char* pin : {"homed", "enabled"}) tableBit(pin) = true;
    turn(40);
    bit("take") = true;
    turn(20);
    bit("take") = false;
    turn(20);
    bit("begin") = true;
    turn(20);
    bit("begin") = false;
  }
  volatile double& real(const std::string& pin) { return hal.value<double>("rung.table." + pin); }
  volatile bool& tableBit(const std::string& pin) { return hal.value<bool>("rung.table." + pin); }
  double command() { return real("position-command"); }
  void turn(int ms) {
    for (int i = 0; i < ms; ++i) {
      scan(1);
      real("position-feedback") = command();
    }
  }
};

TEST_F(AxisAtPins, MovesByTheDistance) {
  EXPECT_TRUE(tableBit("enable"));
  turn(600);
  const double place = command();
  turn(10);
  EXPECT_NEAR(command() - place, 1, 1e-6); // 100 mm/s
  EXPECT_FALSE(bit("reached"));
  turn(1000);
  EXPECT_EQ(command(), 105);
  EXPECT_TRUE(bit("reached"));
  hal.unload();
  expectNothingLeft();
}

TEST_F(AxisAtPins, AFaultOfTheDriveIsAnError) {
  turn(400);
  const double place = command();
  tableBit("fault") = true;
  turn(60);
  EXPECT_NEAR(command() - place, 100. * 100 / 2 / 4000, 1e-6);
  EXPECT_TRUE(bit("error"));
  ASSERT_TRUE(scanUntil([&] { return !hal.lines().empty(); }));
  EXPECT_THAT(hal.lines(), Contains(HasSubstr(" axis 4: the positioning unit has lost the axis: its drive has a")));
  hal.unload();
}

// The command does not become 0, and the program begins anew when the axis stands.
TEST_F(AxisAtPins, AFaultOfTheProgramBrakesIt) {
  turn(400);
  bit("fail") = true;
  turn(20);
  ASSERT_TRUE(bit("fault"));
  bit("fail") = false;
  const double place = command();
  bit("reset") = true;
  turn(150);
  EXPECT_GT(command(), place + 5);
  EXPECT_TRUE(bit("fault"));
  ASSERT_TRUE(scanUntil([&] { return !bit("fault"); }));
  EXPECT_NEAR(command() - place, 10, 2); // of the ramp some steps were before
  hal.unload();
  EXPECT_THAT(hal.lines(), Contains(HasSubstr(" the program has been restarted")));
}

TEST_F(AxisAtPins, PoweredOffItHasComeToRest) {
  turn(400);
  const double place = command();
  bit("power-off") = true;
  turn(150);
  EXPECT_FALSE(bit("powered-off"));
  turn(150);
  EXPECT_TRUE(bit("powered-off"));
  EXPECT_FALSE(tableBit("enable"));
  EXPECT_NEAR(command() - place, 10, 3); // and the last scans of the program
  hal.unload();
  expectNothingLeft();
}

// What it switches off answers it, as long as HAL's thread runs.
TEST_F(Component, ThePinPowerOffIsTheRegularEnd) {
  ASSERT_EQ(hal.load(path("ending.so"), path("ending.map")), 0);
  bit("answers") = true;
  scan(40);
  EXPECT_TRUE(bit("runs"));
  EXPECT_FALSE(bit("powered-off"));
  bit("power-off") = true;
  scan(60);
  EXPECT_FALSE(bit("runs"));
  EXPECT_FALSE(bit("powered-off"));
  bit("power-off") = false; // it has begun
  bit("answers") = false;
  scan(60);
  EXPECT_TRUE(bit("powered-off"));
  const uint32_t scans = number("scans");
  scan(60);
  EXPECT_EQ(number("scans"), scans);
  hal.unload();
  EXPECT_THAT(hal.lines(), IsEmpty());
  expectNothingLeft();
}

TEST_F(Component, UnloadedNothingAnswersTheProgram) {
  ASSERT_EQ(hal.load(path("ending.so"), path("ending.map")), 0);
  bit("answers") = true;
  scan(40);
  hal.unload();
  EXPECT_THAT(hal.lines(), ElementsAre(HasSubstr("message PLC00099")));
  expectNothingLeft();
}

TEST_F(Component, AnotherPrefix) {
  ASSERT_EQ(hal.load(path("stuck.so"), "tests/cnc/stuck.map", {}, "plc"), 0);
  EXPECT_TRUE(hal.has("plc.lamp"));
  EXPECT_TRUE(hal.has("plc.scan"));
  EXPECT_FALSE(hal.has("rung.lamp"));
  hal.unload();
  expectNothingLeft();
}

TEST_F(Component, LoadsAgainWithWhatItHasKept) {
  const std::string retain = path("kept");
  ASSERT_EQ(loadStuck(retain), 0);
  bit("run") = true;
  number("number") = 7;
  scan(8);
  hal.unload();
  expectNothingLeft();
  ASSERT_EQ(loadStuck(retain), 0);
  scan(8); // nothing writes D0
  EXPECT_EQ(hal.value<double>("rung.value"), 7);
  hal.unload();
  ASSERT_EQ(loadMessages(), 0); // another program
  scan(20);
  EXPECT_TRUE(bit("lamp"));
  hal.unload();
  expectNothingLeft();
}

TEST_F(Component, ASecondOneDoesNotDisturbTheFirst) {
  ASSERT_EQ(loadStuck(), 0);
  EXPECT_LT(loadMessages(), 0);
  bit("run") = true;
  scan(8);
  EXPECT_TRUE(bit("lamp"));
  hal.unload();
  expectNothingLeft();
  EXPECT_EQ(loadMessages(), 0); // nothing is in its way
  hal.unload();
  expectNothingLeft();
}

// LinuxCNC does not call rtapi_app_exit when loading has failed.
TEST_F(Component, NothingIsLeftWhereverLoadingFails) {
  const std::string retain = path("failing");
  int tried = 0;
  for (;; ++tried) {
    SCOPED_TRACE(tried);
    ASSERT_LT(tried, 100);
    hal.failAt(tried + 1);
    const int before = hal.asked();
    if (loadStuck(retain) == 0) break;
    EXPECT_EQ(hal.asked(), before + tried + 1); // nothing is asked for after the failure
    expectNothingLeft();
  }
  EXPECT_GT(tried, 15); // hal_init, memory, status pins, those of the map, the parameter, the function, hal_ready
  bit("run") = true;
  scan(8);
  EXPECT_TRUE(bit("lamp"));
  hal.unload();
  expectNothingLeft();
}

TEST_F(Component, MistakesAreReportedAndNothingIsLeft) {
  write("wrong.map", "in.a = { type = \"bit\", name = \"NOT_THERE\" }\n");
  const auto mistake = [&](const std::string& program, const std::string& map, const std::string& retain = {}) {
    const size_t before = hal.lines().size();
    EXPECT_LT(hal.load(program, map, retain), 0);
    expectNothingLeft();
    const std::vector<std::string> lines = hal.lines();
    EXPECT_EQ(lines.size(), before + 1) << testing::PrintToString(lines);
    return lines.empty() ? "" : lines.back();
  };
  EXPECT_THAT(mistake("", "tests/cnc/stuck.map"),
              HasSubstr("so=PROGRAM.so, or source=PROGRAM, and map=MAPPING_FILE are needed"));
  EXPECT_THAT(mistake(path("stuck.so"), ""),
              HasSubstr("so=PROGRAM.so, or source=PROGRAM, and map=MAPPING_FILE are needed"));
  EXPECT_THAT(mistake(path("none.so"), "tests/cnc/stuck.map"), HasSubstr("none.so"));
  EXPECT_THAT(mistake("tests/cnc/stuck.map", "tests/cnc/stuck.map"), HasSubstr("stuck.map"));
  EXPECT_THAT(mistake(path("stuck.so"), "tests/cnc/none.map"), HasSubstr("cannot read tests/cnc/none.map"));
  EXPECT_THAT(mistake(path("stuck.so"), path("wrong.map")), HasSubstr("NOT_THERE"));
  EXPECT_THAT(mistake(path("stuck.so"), "tests/cnc/stuck.map", path("none") + "/plc"), HasSubstr("cannot write"));
}

// HAL takes the function out of its thread without waiting for a call that is on its way.
TEST_F(Component, UnloadsBesideARunningThread) {
  for (int round = 0; round < 5; ++round) {
    ASSERT_EQ(loadStuck(path("beside")), 0);
    bit("run") = true;
    hal.startThread("rung.scan", kMs);
    ASSERT_TRUE(runs(30));
    EXPECT_TRUE(bit("lamp"));
    hal.unload();
    EXPECT_THAT(hal.bitsAtExit(), ElementsAre("rung.run"));
    expectNothingLeft();
  }
}

// Level 1 and a part of Level 2 run in the eighth millisecond, in one function or in two.
TEST_F(Component, TheFastTaskHasAFunctionOfItsOwn) {
  ASSERT_EQ(loadStuck(), 0);
  bit("run") = true;
  const FakeHal::Function fast = hal.function("rung.fast");
  Guard guard;
  for (int ms = 0; ms < 8; ++ms) {
    EXPECT_FALSE(bit("lamp"));
    const Guarded realTime(guard);
    fast.call(kMs);
    hal.function("rung.scan").call(kMs);
  }
  EXPECT_EQ(guard.offences(), "");
  EXPECT_TRUE(bit("lamp"));
  EXPECT_EQ(number("scans"), 1u);
  hal.unload();
  expectNothingLeft();
}

// Whichever comes first.
TEST_F(Component, FunctionsInDifferentThreadsDoNotRun) {
  for (const char* threads : {"rung.scan", "rung.fast"}) {
    SCOPED_TRACE(threads);
    ASSERT_EQ(loadStuck(), 0);
    bit("run") = true;
    const FakeHal::Function other = hal.function(std::string(threads) == "rung.scan" ? "rung.fast" : "rung.scan");
    hal.startThread(threads, kMs);
    ASSERT_TRUE(runs(30));
    EXPECT_TRUE(soon([&] { return other.call(kMs), bit("fault") && !bit("lamp"); }));
    bit("reset") = true;
    ASSERT_TRUE(runs(50));
    EXPECT_TRUE(bit("fault"));
    EXPECT_THAT(hal.lines(), Contains(HasSubstr("rung.fast and rung.scan are in different threads")));
    EXPECT_THAT(statusText(), HasSubstr("\nit does not run: rung.fast and rung.scan are in different threads"));
    hal.unload();
    expectNothingLeft();
  }
}

// The thread scans while the restart is made ready.
TEST_F(Component, RestartsBesideARunningThread) {
  ASSERT_EQ(loadStuck(path("restarts")), 0);
  hal.startThread("rung.scan", kMs);
  const auto wait = [&](bool faulted) { return soon([&] { return bit("fault") == faulted; }); };
  for (int round = 0; round < 3; ++round) {
    bit("stick") = true;
    ASSERT_TRUE(wait(true));
    bit("stick") = false;
    bit("reset") = true;
    ASSERT_TRUE(wait(false));
    bit("reset") = false;
  }
  hal.unload();
}

} // namespace
} // namespace rung::test
