// The frame of the simulated NCT control: power-on and cycles for hosts that run slices, the order of requests, and
// what is kept on disk.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

#include "rtlib/nc/nct/parameters.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "sim/retained_tables.h"
#include "tests/unit/sim/nct_machine.h"

namespace {

using namespace rung::sim;
using test::NctMachine;
namespace fs = std::filesystem;

// ---- time --------------------------------------------------------------------------------------------------------

TEST(NctControl, TheFirstCycleIsOneForHostsThatRunSlices) {
  NctMachine machine;
  for (int slice = 0; slice < 4; ++slice) {
    EXPECT_EQ(machine.get("N_FIRSTCC"), 1u) << slice;
    machine.instance().slice();
  }
  machine.instance().slice(); // MAIN runs here for the first time
  EXPECT_EQ(machine.get("N_FIRSTCC"), 1u);
  EXPECT_EQ(machine.get("N_P2T"), 0u);
  for (int slice = 0; slice < 5; ++slice) machine.instance().slice();
  EXPECT_EQ(machine.get("N_FIRSTCC"), 0u);
  EXPECT_EQ(machine.get("N_P2T"), 1u);
}

TEST(NctControl, ATimeSliceOfItsOwnBelongsToNoCycle) {
  NctMachine machine;
  for (int i = 0; i < 7; ++i) machine.machine().fast();
  machine.scan();
  EXPECT_EQ(machine.get("N_FIRSTCC"), 1u);
  machine.scan();
  EXPECT_EQ(machine.get("N_FIRSTCC"), 0u);
}

// ---- requests ----------------------------------------------------------------------------------------------------

TEST(NctControl, ARequestAtWorkDoesNotHoldUpTheOthers) {
  NctMachine machine;
  const NcArgument number{.key = "number", .integer = 5};
  const NcArgument channel{.key = "channel", .integer = 1};
  const NcArgument blocks{.key = "blocks", .isText = true, .text = "G4 P100"};
  ASSERT_EQ(machine.nc().event(machine.instance(), "program", {channel, number, blocks}), "");
  machine.set("AP_PLCR", 1);
  machine.set("AP_GOR", 1);
  machine.scan(2);
  const auto move = [&](double way) {
    const int64_t args[] = {0, 1, 0, std::bit_cast<int64_t>(way)};
    return machine.instance().services().request(4, args, 4);
  };
  move(1000);
  move(1);
  const uint32_t third = move(1); // the buffer is full: it waits
  EXPECT_EQ(machine.instance().services().poll(third), uint32_t{RUNG_SERVICE_PENDING});
  machine.scan();
  EXPECT_EQ(machine.ask(false, 10, {3, 0, 6000, 1}), 0);
  EXPECT_EQ(machine.instance().services().poll(third), uint32_t{RUNG_SERVICE_PENDING});
  machine.nc().setQuantity("MPOS.1", 999.99);
  machine.scan(4);
  machine.instance().services().deliver();
  EXPECT_EQ(machine.instance().services().poll(third), uint32_t{RUNG_SERVICE_DONE});
}

TEST(NctControl, UnknownFunctionsAndBlocksOutsideTheirSpace) {
  NctMachine machine;
  EXPECT_EQ(machine.ask(false, 11, {3, 0, 6000, 1}), 1); // of MW
  EXPECT_EQ(machine.ask(true, -1, {3}), 1);
  const int64_t args[] = {10, 7000, 1};
  const uint32_t ticket = machine.instance().services().request(0, args, 3);
  machine.scan();
  EXPECT_EQ(machine.answer(ticket), 1);
}

TEST(NctControl, EveryScopeSymbolHasAValue) {
  NctMachine machine;
  for (int64_t i = 0; i < static_cast<int64_t>(rung::nc::nct::scopeSymbols().size()); ++i) {
    const rung::nc::nct::ScopeSymbol& symbol = rung::nc::nct::scopeSymbols()[static_cast<size_t>(i)];
    const int64_t least[] = {i, symbol.param1.min, symbol.param2.min};
    const uint32_t ticket = machine.instance().services().request(5, least, 3);
    EXPECT_EQ(machine.instance().services().poll(ticket), uint32_t{RUNG_SERVICE_DONE}) << symbol.name;
    const int64_t outside[] = {i, symbol.param1.maximum(4000) + 1, symbol.param2.min};
    if (outside[1] > INT32_MAX) continue;
    const uint32_t refused = machine.instance().services().request(5, outside, 3);
    EXPECT_EQ(machine.instance().services().poll(refused), uint32_t{RUNG_SERVICE_ERROR}) << symbol.name;
  }
}

TEST(NctControl, EveryParameterIsReadAndWritten) {
  NctMachine machine;
  for (const rung::nc::nct::ParameterRow& row : rung::nc::nct::parameterRows())
    for (int32_t number = row.number; number < row.number + row.numbers; ++number) {
      const bool real = row.format == rung::nc::nct::ParameterFormat::Double;
      const int32_t index =
          row.index == rung::nc::nct::ParameterIndex::Global ? 0 : static_cast<int32_t>(valuesOf(row.index));
      EXPECT_EQ(machine.ask(true, real ? 35 : 34, {real ? 4 : 3, number, index, 0x40, 0x40}), 0) << number;
      EXPECT_EQ(machine.ask(false, real ? 32 : 31, {real ? 4 : 3, number, index}), 0) << number;
      EXPECT_EQ(machine.blockWord(4), 0x40) << number;
      EXPECT_EQ(machine.ask(false, real ? 31 : 32, {4, number, index}), 33) << number;
    }
}

// ---- configuration -----------------------------------------------------------------------------------------------

TEST(NctControl, WrongConfigurationIsToldAsSuch) {
  const std::unique_ptr<SimulatedNc> model = makeSimulatedNct();
  for (const auto& [key, value] : std::vector<std::pair<const char*, const char*>>{{"nc", "real"},
                                                                                   {"nvecat", "yes"},
                                                                                   {"nvram", "bad"},
                                                                                   {"network", "internet"},
                                                                                   {"display", "1"},
                                                                                   {"axes", ""},
                                                                                   {"axes", "XY1"},
                                                                                   {"encoders", "none"},
                                                                                   {"rapid", "0"},
                                                                                   {"jog", "fast"},
                                                                                   {"spindles", "17"},
                                                                                   {"spindles", "1.5"},
                                                                                   {"param.9999", "1"},
                                                                                   {"param.1209.1", "1"},
                                                                                   {"param.0516.33", "1"},
                                                                                   {"param.0516.1", "x"},
                                                                                   {"param.1209", "0.5"},
                                                                                   {"param.1201", "256"},
                                                                                   {"ethercat.1", "can"},
                                                                                   {"ethercat.0", "coe"},
                                                                                   {"ethercat.9.coe.1.0", "1"},
                                                                                   {"ethercat.1.coe.1", "1"},
                                                                                   {"ethercat.1.coe.1.0", "1/9"},
                                                                                   {"follow.INP001", "OUT010.00"},
                                                                                   {"follow.INP001.03", "OUT010.40"},
                                                                                   {"follow.INP001.03", "OUT010.00@5"},
                                                                                   {"follow.INP001.03", "OUT010.00@"},
                                                                                   {"follow.MB_NONE", "OUT010.00"},
                                                                                   {"nothing", "1"}})
    EXPECT_NE(model->config(key, value), "") << key << " " << value;
}

TEST(NctControl, WrongEventsAreToldAsSuch) {
  NctMachine machine;
  const auto event = [&](const char* name, const std::vector<NcArgument>& keys) {
    return machine.nc().event(machine.instance(), name, keys);
  };
  EXPECT_NE(event("nothing", {}), "");
  EXPECT_NE(event("handwheel", {}), "");
  EXPECT_NE(event("handwheel", {{.key = "pulses", .integer = 1}, {.key = "wheel", .integer = 5}}), "");
  EXPECT_NE(event("axis_alarm", {{.key = "axis", .integer = 33}}), "");
  EXPECT_NE(event("spindle", {{.key = "number", .integer = 17}}), "");
  EXPECT_NE(event("drive", {{.key = "address", .integer = 49}, {.key = "error", .integer = 1}}), "");
  EXPECT_NE(event("display", {}), "");
  EXPECT_NE(event("ethercat", {{.key = "device", .integer = 1}}), "");
  EXPECT_NE(event("device", {}), "");
  EXPECT_NE(event("device", {{.key = "open", .isText = true, .text = "udp"}}), "");
  EXPECT_NE(event("device", {{.key = "send", .integer = 1}}), "");
  EXPECT_NE(event("damage_nvram", {{.key = "word", .integer = 1}}), "");
}

// ---- what is kept ------------------------------------------------------------------------------------------------

class NctKept : public testing::Test {
protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "rung_nct_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    file_ = (folder_ / "plc").string();
  }
  void TearDown() override { fs::remove_all(folder_); }

  // The marks of one image: the same number in several tables.
  static void mark(NctMachine& machine, int number) {
    machine.nc().setQuantity("NVRAM.0", number);
    machine.nc().setQuantity("PARAM.1209", number);
    machine.nc().setQuantity("MACRO.8.999", number);
  }
  static void expectMark(NctMachine& machine, int number) {
    EXPECT_EQ(machine.nc().quantity("NVRAM.0"), number);
    EXPECT_EQ(machine.nc().quantity("PARAM.1209"), number);
    EXPECT_EQ(machine.nc().quantity("MACRO.8.999"), number);
  }
  // Runs `work` between a start from the files and a regular end.
  template <class Work>
  void session(bool found, Work work) {
    NctMachine machine;
    RetainedTables tables(machine.nc(), file_);
    std::string error;
    report_.clear();
    EXPECT_EQ(tables.load(report_, error), found) << report_;
    EXPECT_EQ(error, "");
    machine.machine().powerOn(rung::nc::PowerOn::Cold); // of the program: its own memory was not kept
    work(machine);
    EXPECT_EQ(tables.finish(), "");
  }
  void damage(const char* ending) {
    std::fstream file(file_ + ".nc" + ending, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(100);
    file.put('\x5A');
    ASSERT_TRUE(file.good());
  }

  fs::path folder_;
  std::string file_;
  std::string report_;
};

TEST_F(NctKept, TablesComeBackWhateverTheProgramKept) {
  session(false, [](NctMachine& machine) {
    mark(machine, 7);
    machine.nc().setQuantity("MACRO.1.100", 5); // volatile
    machine.nc().setQuantity("MPOS.3", -1.25);
  });
  EXPECT_EQ(report_, "");
  session(true, [](NctMachine& machine) {
    expectMark(machine, 7);
    EXPECT_EQ(machine.nc().quantity("MACRO.1.100"), 0);
    EXPECT_EQ(machine.nc().quantity("MPOS.3"), -1.25);
    machine.scan();
    EXPECT_EQ(machine.get("N_PDW1"), 7u); // in the NC area too
  });
}

TEST_F(NctKept, ADamagedImageLeavesTheOlderOne) {
  session(false, [](NctMachine& machine) { mark(machine, 1); }); // .a as delivered, .b with 1
  session(true, [](NctMachine& machine) { mark(machine, 2); });  // .a again with 1, .b with 2
  damage(".b");
  session(true, [](NctMachine& machine) { expectMark(machine, 1); });
  EXPECT_NE(report_, "");
  damage(".a");
  damage(".b");
  session(false, [](NctMachine& machine) { expectMark(machine, 0); });
  EXPECT_NE(report_, "");
}

// The configuration of tables is their layout: the image of another one is not taken.
TEST_F(NctKept, AnImageOfAnotherSizeIsNotTaken) {
  std::string error;
  const std::vector<uint8_t> bytes(10);
  ASSERT_TRUE(rung::runtime::RetainStore(file_ + ".nc", 0x52554E474E430001, 10).save(bytes, error)) << error;
  session(false, [](NctMachine& machine) { expectMark(machine, 0); });
  EXPECT_NE(report_, "");
}

TEST_F(NctKept, APlaceThatCannotBeWrittenIsToldAtOnce) {
  NctMachine machine;
  RetainedTables tables(machine.nc(), (folder_ / "none" / "plc").string());
  std::string report;
  std::string error;
  EXPECT_FALSE(tables.load(report, error));
  EXPECT_NE(error, "");
}

// Killed at any moment while images are written: the next start finds one that is whole.
TEST_F(NctKept, KilledWhileWriting) {
  int last = 0;
  for (int round = 0; round < 6; ++round) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      NctMachine machine;
      RetainedTables tables(machine.nc(), file_, std::chrono::milliseconds(1));
      std::string report;
      std::string error;
      tables.load(report, error);
      machine.machine().powerOn(rung::nc::PowerOn::Cold);
      static_cast<void>(write(ready[1], "r", 1) == 1);
      for (int i = static_cast<int>(machine.nc().quantity("NVRAM.0").value_or(0)) + 1;; ++i) {
        mark(machine, i);
        tables.offer();
        usleep(200);
      }
    }
    char byte = 0;
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    usleep(30'000 + 7'000 * static_cast<useconds_t>(round));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    close(ready[0]);
    close(ready[1]);
    session(true, [&](NctMachine& machine) {
      const auto number = static_cast<int>(machine.nc().quantity("NVRAM.0").value_or(-1));
      EXPECT_GE(number, last);
      expectMark(machine, number);
      last = number;
    });
  }
  EXPECT_GT(last, 0);
}

TEST(NctControlScripted, KeepsNoTables) {
  const std::unique_ptr<SimulatedNc> model = makeSimulatedNct();
  EXPECT_EQ(model->retainedSize(), 0u);
}

} // namespace
