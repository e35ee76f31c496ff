// The scan of the component: pins, time, faults, auxiliary functions, and that a step allocates nothing.
#include "machine/host/plc_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "rtlib/nc/technol/signals.h"
#include "rtlib/retain/retain.h"
#include "tests/support/count_allocations.h"
#include "tests/support/patience.h"
#include "tests/unit/host/bench.h"
#include "tests/unit/host/test_program.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::host {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using rung::test::allocationsOf;
using testing::Bench;
using testing::kMs;
using testing::textsOf;

TEST(PlcHost, PinsOfAllTypes) {
  Bench b(host::testing::gskProgram(), R"(
in.i = { type = "bit", name = "X0.0" }
out.o = { type = "bit", name = "Y0.0" }
in.si = { type = "s32", name = "F10:4" }
out.so = { type = "s32", name = "D4:4" }
out.byte = { type = "s32", name = "D4" }
out.fo = { type = "float", name = "D4:4" }
in.ui = { type = "u32", name = "F14:4" }
out.uo = { type = "u32", name = "D8:4" }
in.fi = { type = "float", name = "F20:2" }
out.back = { type = "float", name = "F20:2" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  b["i"].bit = true;
  b["si"].s32 = -2;
  b["ui"].u32 = 0x80000001;
  b["fi"].real = -3.6;
  b.scans(1);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_EQ(b["so"].s32, -2);
  EXPECT_EQ(b["byte"].s32, -2); // the low byte with its sign
  EXPECT_EQ(b["fo"].real, -2.0);
  EXPECT_EQ(b["uo"].u32, 0x80000001u);
  EXPECT_EQ(b["back"].real, -4.0); // rounded
  b["i"].bit = false;
  b["fi"].real = 1e9;
  b.scans(1);
  EXPECT_FALSE(b["o"].bit);
  EXPECT_EQ(b["back"].real, 32767.0); // saturated
}

struct Counted {
  Value value;
  int reads = 0;
  int writes = 0;
};

TEST(PlcHost, ReadsAndWritesEachPinOnceAStep) {
  Bench b(host::testing::gskProgram(), R"(
in.i = { type = "bit", name = "X0.0" }
out.o = { type = "bit", name = "Y0.0" }
send = [
  { pin = "i", edge = "rise", function = "M", code = 3, done = "done" },
  { pin = "i", edge = "fall", function = "M", code = 5 },
]
abort = [{ pin = "i", edge = "fall" }]
)");
  ASSERT_THAT(b.errors, IsEmpty());
  const PinAccess access{[](host::PinType, const PinCell& cell) noexcept {
                           Counted& pin = *static_cast<Counted*>(cell.any);
                           ++pin.reads;
                           return pin.value;
                         },
                         [](host::PinType, const PinCell& cell, const Value& value) noexcept {
                           Counted& pin = *static_cast<Counted*>(cell.any);
                           ++pin.writes;
                           pin.value = value;
                         }};
  Counted i, o, done;
  const PinCell cells[] = {{.any = &i}, {.any = &o}, {.any = &done}};
  b.host->connect(cells, access);
  i.reads = o.writes = done.writes = 0;
  b.scans(1);
  EXPECT_EQ(i.reads, 1);
  EXPECT_EQ(o.writes, 1);
  EXPECT_EQ(done.writes, 1);
  i.value.bit = true;
  b.scans(1);
  EXPECT_TRUE(o.value.bit);
  EXPECT_EQ(i.reads, 2);
  EXPECT_EQ(o.writes, 2);
  EXPECT_EQ(i.writes + o.reads + done.reads, 0);
}

TEST(PlcHost, ASliceRunsWhenItsTimeHasCome) {
  Bench b(host::testing::gskProgram(), R"(out.count = { type = "u32", name = "D0:2" })");
  ASSERT_THAT(b.errors, IsEmpty());
  for (int ms = 1; ms <= 80; ++ms) {
    EXPECT_EQ(b.host->step(kMs), ms % 8 == 0 ? StepResult::Ran : StepResult::Waiting) << ms;
    EXPECT_EQ(b["count"].u32, static_cast<uint32_t>(ms / 8));
  }
  EXPECT_EQ(b.host->state().scans, 10u);
  for (int i = 0; i < 8; ++i) b.host->step(3 * kMs); // 24 ms in steps that do not divide the period
  EXPECT_EQ(b["count"].u32, 13u);
  b.host->step(20 * kMs); // two are due and one runs; 4 ms are owed
  EXPECT_EQ(b["count"].u32, 14u);
  EXPECT_EQ(b.host->state().missed, 1u);
  b.host->step(4 * kMs);
  EXPECT_EQ(b["count"].u32, 15u);
}

TEST(PlcHost, PassesInAStepAreBounded) {
  Bench b(host::testing::gskProgram(), R"(out.count = { type = "u32", name = "D0:2" })", {}, 11);
  b.host->step(88 * kMs); // one is due, ten are late
  EXPECT_EQ(b["count"].u32, 11u);
  EXPECT_EQ(b.host->state().missed, 0u);
  b.host->step(804 * kMs);
  EXPECT_EQ(b["count"].u32, 22u);
  EXPECT_EQ(b.host->state().missed, 89u);
  b.host->step(3 * kMs);
  EXPECT_EQ(b["count"].u32, 22u);
  b.host->step(kMs); // the time of what was left out has passed, too
  EXPECT_EQ(b["count"].u32, 23u);
}

TEST(PlcHost, ASlottedScheduleCountsWholePasses) {
  Bench b(host::testing::nctProgram(), R"(
in.i = { type = "bit", name = "0056.17" }
out.o = { type = "bit", name = "0400.00" }
out.on = { type = "bit", name = "N_ON" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  b["i"].bit = true;
  b.host->step(5 * kMs);
  EXPECT_EQ(b.host->state().scans, 0u);
  EXPECT_FALSE(b["o"].bit);
  b.host->step(5 * kMs);
  EXPECT_EQ(b.host->state().scans, 1u);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_TRUE(b["on"].bit); // the NC's constant signal, without a line in the map
}

TEST(PlcHost, ConstantsHold) {
  Bench b(host::testing::gskProgram(), R"(
const."X0.0" = true
out.o = { type = "bit", name = "Y0.0" }
const."D0:2" = 100
out.count = { type = "u32", name = "D0:2" }
const."F20:2" = 7.0
out.f = { type = "u32", name = "F20:2" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  b.scans(3);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_EQ(b["count"].u32, 101u); // written anew in front of every slice
  EXPECT_EQ(b["f"].u32, 7u);
}

TEST(PlcHost, BitsOfACell) {
  Bench b(host::testing::gskProgram(), R"(
in.key = { type = "bit", name = "X0", bits = 2 }
in.byte = { type = "bit", name = "F10", bits = 8 }
out.lamp = { type = "bit", name = "D4", bits = 8 }
out.o = { type = "bit", name = "Y0.0" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  b["key-0"].bit = true;
  b["byte-0"].bit = true;
  b["byte-7"].bit = true;
  b.scans(1);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_TRUE(b["lamp-0"].bit);
  EXPECT_FALSE(b["lamp-1"].bit);
  EXPECT_TRUE(b["lamp-7"].bit);
  b["key-0"].bit = false;
  b["byte-7"].bit = false;
  b.scans(1);
  EXPECT_FALSE(b["o"].bit);
  EXPECT_FALSE(b["lamp-7"].bit);
}

// D0 counts scans; who has written last counts.
TEST(PlcHost, PinsThatBothSidesWrite) {
  Bench b(host::testing::gskProgram(), R"(
io.count = { type = "u32", name = "D0:2" }
io.free = { type = "s32", name = "D40:4" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  b.scans(3);
  EXPECT_EQ(b["count"].u32, 3u);
  b["count"].u32 = 100;
  b["free"].s32 = -5;
  b.scans(2);
  EXPECT_EQ(b["count"].u32, 102u);
  EXPECT_EQ(b["free"].s32, -5);
}

TEST(PlcHost, Parameters) {
  Bench b(host::testing::gskProgram(), R"(
param.count = { type = "u32", name = "D0:2", value = 100 }
param.own = { type = "u32", name = "D40:2" }
param.real = { type = "float", name = "F20:2", scale = 10, value = 2.5 }
out.count-now = { type = "u32", name = "D0:2" }
out.real-now = { type = "s32", name = "F20:2" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  EXPECT_EQ(b["count"].u32, 100u); // before the first scan
  EXPECT_EQ(b["own"].u32, 0u);
  EXPECT_EQ(b["real"].real, 2.5);
  b.scans(3);
  EXPECT_EQ(b["count-now"].u32, 101u); // what the program writes does not last
  EXPECT_EQ(b["count"].u32, 100u);
  EXPECT_EQ(b["real-now"].s32, 25);
  b["count"].u32 = 7;
  b.scans(1);
  EXPECT_EQ(b["count-now"].u32, 8u);
}

TEST(PlcHost, SafeValues) {
  Bench b(host::testing::gskProgram(), R"(
in.i = { type = "bit", name = "X0.0" }
in.bad = { type = "bit", name = "X1.0" }
out.o = { type = "bit", name = "Y0.0" }
out.kept = { type = "bit", name = "Y0.0", safe = "hold" }
out.brake = { type = "bit", name = "Y0.1", safe = true }
out.speed = { type = "float", name = "D0:2", safe = -1.5 }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  EXPECT_THAT(b.warnings, ElementsAre("pin kept holds its last value while the program does not run"));
  EXPECT_TRUE(b["brake"].bit); // before the first scan
  EXPECT_EQ(b["speed"].real, -1.5);
  b["i"].bit = true;
  b.scans(1);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_FALSE(b["brake"].bit);
  EXPECT_EQ(b["speed"].real, 1);
  b["bad"].bit = true;
  EXPECT_EQ(b.host->step(8 * kMs), StepResult::Failed);
  EXPECT_FALSE(b["o"].bit);
  EXPECT_TRUE(b["kept"].bit);
  EXPECT_TRUE(b["brake"].bit);
  EXPECT_EQ(b["speed"].real, -1.5);
  b["brake"].bit = false;
  EXPECT_EQ(b.host->close(), "");
  EXPECT_TRUE(b["brake"].bit);
  EXPECT_TRUE(b["kept"].bit);
}

TEST(PlcHost, AFaultClearsTheOutputsForGood) {
  Bench b(host::testing::gskProgram(),
          R"(
in.i = { type = "bit", name = "X0.0" }
in.bad = { type = "bit", name = "X1.0" }
out.o = { type = "bit", name = "Y0.0" }
out.count = { type = "u32", name = "D0:2" }
out.fc = { type = "float", name = "D0:2" }
)");
  b["i"].bit = true;
  b.scans(2);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_EQ(b["fc"].real, 2.0);
  b["bad"].bit = true;
  EXPECT_EQ(b.host->step(8 * kMs), StepResult::Failed);
  EXPECT_EQ(b.host->fault()->line, 42u);
  EXPECT_FALSE(b["o"].bit);
  EXPECT_EQ(b["count"].u32, 0u);
  EXPECT_EQ(b["fc"].real, 0.0);
  EXPECT_TRUE(b["i"].bit); // inputs are HAL's
  b["bad"].bit = false;
  EXPECT_EQ(b.host->step(8 * kMs), StepResult::Waiting);
  EXPECT_FALSE(b["o"].bit);
  EXPECT_EQ(b.host->state().scans, 2u);
}

// The end code 6 of a window function that the CNC does not provide (man. l.8668-8676).
TEST(PlcHost, WindowRequestsEndAtOnceWithCode6) {
  Bench b(host::testing::gskProgram(), R"(
in.ask = { type = "bit", name = "X1.1" }
out.state = { type = "u32", name = "D12" }
out.end = { type = "u32", name = "D13" }
)");
  b["ask"].bit = true;
  b.scans(300); // more than may be pending
  EXPECT_EQ(b["state"].u32, static_cast<uint32_t>(RUNG_SERVICE_DONE));
  EXPECT_EQ(b["end"].u32, 6u);
}

TEST(PlcHost, MachinePositionsComeFromHal) {
  Bench b(host::testing::gskProgram(), R"(
in.x = { type = "float", name = "NC.MPOS.1", scale = 1000 }
in.y = { type = "s32", name = "NC.MPOS.2" }
out.gotx = { type = "s32", name = "D16:4" }
out.goty = { type = "float", name = "D20:4", scale = 1000 }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  b["x"].real = -12.3456; // mm
  b["y"].s32 = 250;       // 0.001 mm
  b.scans(1);
  EXPECT_EQ(b["gotx"].s32, -12346);
  EXPECT_EQ(b["goty"].real, 0.25);
  b["x"].real = 1e30;
  b.scans(1);
  EXPECT_EQ(b["gotx"].s32, INT32_MAX);
}

class BoxRetained : public ::testing::Test {
protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "rung_box_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    file = pattern + "/plc";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
  std::string file;
};

TEST_F(BoxRetained, GoesOn) {
  for (uint32_t round = 1; round <= 3; ++round) {
    Bench b(host::testing::gskProgram(), R"(
out.count = { type = "u32", name = "D0:2" }
in.value = { type = "s32", name = "F10:4" }
)",
            file);
    ASSERT_THAT(b.errors, IsEmpty());
    EXPECT_EQ(allocationsOf([&] { b.scans(5); }), 0);
    EXPECT_EQ(b["count"].u32, 5 * round);
    EXPECT_EQ(b.host->close(), "");
  }
  Bench nowhere(host::testing::gskProgram(), "", (folder / "none" / "plc").string());
  EXPECT_THAT(nowhere.errors, ElementsAre(::testing::HasSubstr("cannot write")));
  EXPECT_EQ(nowhere.host, nullptr);
  Bench first(host::testing::gskProgram(), "", file);
  Bench second(host::testing::gskProgram(), "", file);
  EXPECT_THAT(second.errors, ElementsAre(::testing::HasSubstr("is in use by another process")));
  EXPECT_EQ(second.host, nullptr);
}

// Counts in D0, which a fault makes safe; with X0.0 the program stops when it has counted.
TEST_F(BoxRetained, AFaultLeavesTheLastScan) {
  test::TestProgram program;
  program.dialect = "gsk";
  program.addSpace("X", 1, {{0, 16, 0, RUNG_REPR_PACKED}}, RUNG_SPACE_INPUT);
  program.addPacked("D", 1, 16, 16);
  program.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) {
    mem[17] = ++mem[16];
    return (mem[0] & 1) != 0 ? RUNG_PC_FAULT : RUNG_PC_DONE;
  });
  program.addTask("MAIN", 0);
  program.retains = {{16, 16}};
  program.safeSpans = {{16, 1}};
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
  program.link();
  {
    Bench b(program.program, R"(
in.stop = { type = "bit", name = "X0.0" }
out.count = { type = "u32", name = "D0" }
)",
            file);
    ASSERT_THAT(b.errors, IsEmpty());
    b.scans(5);
    b["stop"].bit = true;
    EXPECT_EQ(b.host->step(8 * kMs), StepResult::Failed);
    EXPECT_EQ(b.host->step(8 * kMs), StepResult::Waiting);
    EXPECT_EQ(b.host->close(), "");
  }
  Bench b(program.program, R"(
out.count = { type = "u32", name = "D0" }
out.second = { type = "u32", name = "D1" }
)",
          file);
  ASSERT_THAT(b.errors, IsEmpty());
  b.scans(1);
  EXPECT_EQ(b["count"].u32, 6u);
  EXPECT_EQ(b["second"].u32, 6u);
}

TEST_F(BoxRetained, NctLearnsThatItsMemoryIsLost) {
  const auto start = [&] {
    Bench b(host::testing::nctProgram(), R"(out.ok = { type = "bit", name = "N_NVRAMOK" })", file);
    EXPECT_THAT(b.errors, IsEmpty());
    b.host->step(10 * kMs);
    const bool ok = b["ok"].bit;
    EXPECT_EQ(ok, b.warnings.empty());
    EXPECT_EQ(b.host->close(), "");
    return ok;
  };
  EXPECT_TRUE(start());
  EXPECT_TRUE(start());
  for (const char* ending : {".a", ".b"}) std::ofstream(file + ending) << "junk";
  EXPECT_FALSE(start());
  EXPECT_TRUE(start());
  for (const char* ending : {".a", ".b"}) std::filesystem::remove(file + ending);
  EXPECT_FALSE(start());
  {
    EXPECT_EQ(Bench(host::testing::gskProgram(), "", file).host->close(), "");
  }
  EXPECT_FALSE(start()); // it is another program's
}

// A TECHNOL program that counts in PLC_MEM_BACKUP and asks for saving when ASK comes. Its code finds the cells here.
struct BackupPlaces {
  uint32_t count;
  uint32_t request;
  uint8_t mask;
  uint32_t ask;
} places;

void buildBackup(test::TestProgram& program) {
  const uint32_t cells = nc::areaBytes(nc::technolSignals(), "I");
  const nc::Signal& backup = *nc::findSignal(nc::technolSignals(), "PLC_MEM_BACKUP", "I");
  const nc::Signal& request = *nc::findSignal(nc::technolSignals(), "REQ_BACKUP_MEM", "I");
  places = {backup.byteOffset, request.byteOffset, static_cast<uint8_t>(1u << request.bit), cells};
  program.dialect = "technol";
  program.memorySize = cells + 8;
  program.addSpace("NCI", 1, {{0, cells, 0, RUNG_REPR_PACKED}}, RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT);
  program.addPacked("DATA", 1, 8, cells);
  program.addSymbol("ASK", 1, 0, RUNG_TYPE_BIT);
  program.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) {
    ++mem[places.count];
    uint8_t* ask = mem + places.ask;
    if ((ask[0] & 1) != 0 && ask[1] == 0) mem[places.request] |= places.mask;
    ask[1] = ask[0] & 1;
    return RUNG_PC_DONE;
  });
  program.addTask("MAIN", 0);
  program.retains = {{backup.byteOffset, backup.count}};
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 20000}, {RUNG_STEP_RUN, 0, 1}, {RUNG_STEP_HOOK, RUNG_NONE, 2}};
  program.link();
}

TEST_F(BoxRetained, ATechnolRequestIsAnsweredWhenItIsOnDisk) {
  test::TestProgram program;
  buildBackup(program);
  Bench b(program.program, R"(
in.ask = { type = "bit", name = "ASK" }
out.asked = { type = "bit", name = "REQ_BACKUP_MEM" }
)",
          file);
  ASSERT_THAT(b.errors, IsEmpty());
  const runtime::RetainMap map(program.program);
  const auto onDisk = [&] { return runtime::RetainStore(file, map.layout().hash, map.size()).load().bytes.at(0); };
  const auto step = [&] { ASSERT_EQ(b.host->step(20 * kMs), StepResult::Ran); };
  const auto ask = [&] {
    b["ask"].bit = false;
    step();
    b["ask"].bit = true;
    step();
    EXPECT_TRUE(b["asked"].bit); // nothing can be on disk in the same scan
  };
  // The program counts its scans in a byte: it does not scan while it waits for the disk.
  const auto saves = [&](uint64_t count) { return test::soon([&] { return b.host->state().saves >= count; }); };
  const auto answered = [&] {
    return test::soon([&] { return step(), !b["asked"].bit; }, std::chrono::milliseconds(10));
  };
  for (int i = 0; i < 3; ++i) step();
  EXPECT_EQ(onDisk(), 0); // nothing is saved without a request
  ask();
  ASSERT_TRUE(saves(1));
  ASSERT_TRUE(answered());
  EXPECT_EQ(onDisk(), 5); // of the fifth scan, where it was asked for
  EXPECT_EQ(b.host->state().saves, 1u);
  for (const char* ending : {".a.tmp", ".b.tmp"}) std::filesystem::create_directory(file + ending);
  ask();
  ASSERT_TRUE(test::soon([&] { return b.host->failsToSave(); }));
  for (int i = 0; i < 20; ++i) step();
  EXPECT_TRUE(b["asked"].bit); // the program waits
  EXPECT_EQ(onDisk(), 5);
  for (const char* ending : {".a.tmp", ".b.tmp"}) std::filesystem::remove(file + ending);
  ASSERT_TRUE(saves(2));
  ASSERT_TRUE(answered());
  EXPECT_FALSE(b.host->failsToSave());
  EXPECT_GT(onDisk(), 5);
  EXPECT_EQ(b.host->close(), "");
}

// Without a file there is nothing to wait for.
TEST_F(BoxRetained, ATechnolRequestWithoutAFile) {
  test::TestProgram program;
  buildBackup(program);
  Bench b(program.program, R"(
in.ask = { type = "bit", name = "ASK" }
out.asked = { type = "bit", name = "REQ_BACKUP_MEM" }
)");
  b["ask"].bit = true;
  b.host->step(20 * kMs);
  EXPECT_FALSE(b["asked"].bit);
  EXPECT_EQ(b.host->state().saves, 0u);
}

TEST(PlcHost, MessagesWaitForWhoTakesThem) {
  Bench b(host::testing::gskProgram(), R"(in.show = { type = "bit", name = "X1.2" })");
  b["show"].bit = true;
  b.scans(2);
  EXPECT_THAT(b.messages(&rung_message_info::number), ElementsAre(7u, 7u));
  EXPECT_THAT(b.messages(), IsEmpty());
}

// The NC's part of messages works here too: the program learns what is on the screen, and CANCEL is a pin.
TEST(PlcHost, NctMessages) {
  Bench b(host::testing::nctProgram(), R"(
in.show = { type = "bit", name = "0056.18" }
in.cancel = { type = "bit", name = "N_CLRMSG" }
out.on = { type = "bit", name = "0400.01" }
out.any = { type = "bit", name = "N_MSGA" }
out.code = { type = "u32", name = "N_ACTMSG" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  const auto cycle = [&] { b.host->step(10 * kMs); };
  b["show"].bit = true;
  cycle();
  EXPECT_FALSE(b["on"].bit);
  cycle();
  EXPECT_TRUE(b["on"].bit && b["any"].bit);
  EXPECT_EQ(b["code"].u32, 3000705u);
  b["cancel"].bit = true;
  cycle();
  EXPECT_TRUE(b["on"].bit) << "with N_CLRMSG at once";
  cycle();
  EXPECT_FALSE(b["on"].bit || b["any"].bit);
  b["show"].bit = b["cancel"].bit = false;
  cycle();
  b["show"].bit = true;
  cycle();
  cycle();
  EXPECT_TRUE(b["on"].bit);
  EXPECT_THAT(
      b.messages(&rung_message_info::op),
      ElementsAre(uint32_t{RUNG_MESSAGE_SHOW_LOG}, uint32_t{RUNG_MESSAGE_CLEAR}, uint32_t{RUNG_MESSAGE_SHOW_LOG}));
}

TEST(PlcHost, RefusesMapsThatDoNotFit) {
  EXPECT_THAT(Bench(host::testing::gskProgram(), "in.a = { type = \"bit\", name = \"Y0.0\" }\ntimeout = 0").errors,
              ElementsAre("m.map:2:11: timeout: found 0, expected seconds, above 0 and at most 1000000; write for "
                          "example timeout = 30",
                          "m.map:1:31: in.a.name: found Y0.0, an output of the program, expected a name that HAL may "
                          "write; move the pin to [out]"));
}

// ---- after a fault -----------------------------------------------------------------------------------------------

TEST(PlcHost, AResetRestartsTheProgram) {
  Bench b(host::testing::gskProgram(), R"(
in.bad = { type = "bit", name = "X1.0" }
in.i = { type = "bit", name = "X0.0" }
out.o = { type = "bit", name = "Y0.0" }
out.count = { type = "u32", name = "D0:2" }
)");
  b["i"].bit = true;
  b.scans(3);
  b["bad"].bit = true;
  EXPECT_EQ(b.host->step(8 * kMs), StepResult::Failed);
  EXPECT_FALSE(b.host->running());
  EXPECT_EQ(b.host->faultLine(), 42u) << "at once: a host shows it together with the fault";
  EXPECT_FALSE(b["o"].bit);
  std::vector<Report> reports;
  EXPECT_TRUE(b.host->serve(reports));
  EXPECT_THAT(
      textsOf(reports),
      ElementsAre("the program has stopped: dead-loop (rung 1 \"all of it\", main.pmc:42); output pins have their safe "
                  "values until pin reset rises"));
  reports.clear();
  EXPECT_FALSE(b.host->serve(reports)); // nobody has asked
  b["bad"].bit = false;
  EXPECT_EQ(b.host->step(8 * kMs, true), StepResult::Waiting);
  EXPECT_EQ(b.host->step(8 * kMs, true), StepResult::Waiting); // until it is served
  EXPECT_TRUE(b.host->serve(reports));
  EXPECT_THAT(textsOf(reports), ElementsAre("the program has been restarted"));
  EXPECT_TRUE(b.host->running());
  EXPECT_EQ(b.host->step(8 * kMs, true), StepResult::Ran);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_EQ(b["count"].u32, 1u); // from the beginning
  b["bad"].bit = true;           // the pin that is still on does not restart it again
  EXPECT_EQ(b.host->step(8 * kMs, true), StepResult::Failed);
  EXPECT_EQ(b.host->step(8 * kMs, true), StepResult::Waiting);
  b.host->serve(reports);
  EXPECT_FALSE(b.host->running());
}

TEST(PlcHost, MeasuresScansOnRequest) {
  std::vector<std::string> errors, warnings;
  const auto host = PlcHost::make(Image::adopt(host::testing::gskProgram()), parseMap("", "m.map", errors),
                                  {.measure = true}, errors, warnings);
  ASSERT_NE(host, nullptr);
  EXPECT_EQ(host->step(8 * kMs), StepResult::Ran);
  EXPECT_GT(host->state().last_ns, 0);
  EXPECT_GE(host->state().worst_ns, host->state().last_ns);
}

TEST_F(BoxRetained, ARestartTakesTheLastWholeScan) {

  Bench b(host::testing::gskProgram(), R"(
in.bad = { type = "bit", name = "X1.0" }
out.count = { type = "u32", name = "D0:2" }
)",
          file);
  b.scans(5);
  b["bad"].bit = true;
  EXPECT_EQ(b.host->step(8 * kMs), StepResult::Failed);
  b["bad"].bit = false;
  b.host->step(8 * kMs, true);
  std::vector<Report> reports;
  EXPECT_TRUE(b.host->serve(reports));
  EXPECT_THAT(textsOf(reports), ElementsAre(HasSubstr("dead-loop"), "the program has been restarted"))
      << "both, at once";
  b.scans(1);
  EXPECT_EQ(b["count"].u32, 6u);
}

TEST(PlcHost, ItsEndSwitchesTheOutputsOff) {
  Bench b(host::testing::gskProgram(), R"(
in.i = { type = "bit", name = "X0.0" }
out.o = { type = "bit", name = "Y0.0" }
)");
  b["i"].bit = true;
  b.scans(1);
  EXPECT_TRUE(b["o"].bit);
  EXPECT_EQ(b.host->close(), "");
  EXPECT_FALSE(b["o"].bit);
}

// N_SIMU says that the NC runs on a simulator; a program passes its interlocks by then.
TEST(PlcHost, AMachineIsNoSimulator) {
  Bench b(host::testing::nctProgram(), R"(
out.simulator = { type = "bit", name = "N_SIMU" }
out.ready = { type = "bit", name = "N_NCREADY" }
)");
  b.host->step(10 * kMs);
  EXPECT_FALSE(b["simulator"].bit);
  EXPECT_TRUE(b["ready"].bit);
}

// ---- M, S and T functions -----------------------------------------------------------------------------------------

constexpr std::string_view kFunctions = R"(
in.held = { type = "bit", name = "X1.3" }
in.fin = { type = "bit", name = "X2.0" }
out.mf = { type = "bit", name = "F7.0" }
out.tf = { type = "bit", name = "F7.3" }
out.done = { type = "bit", name = "G4.3" }
out.m = { type = "s32", name = "F10:4" }
out.t = { type = "s32", name = "F26:4" }
timeout = 1.5
send = [
  { pin = "cw", edge = "rise", function = "M", code = 3 },
  { pin = "cw", edge = "fall", function = "M", code = 5 },
  { pin = "change", edge = "rise", function = "M", code = 6, done = "changed" },
  { pin = "prepare", edge = "rise", function = "T", code = "number", done = "prepared" }
]
abort = [{ pin = "estop", edge = "rise" }]
)";

TEST(Functions, OneHandshake) {
  Bench b(host::testing::gskProgram(), kFunctions);
  ASSERT_THAT(b.errors, IsEmpty());
  b.scans(1);
  EXPECT_EQ(b["m"].s32, 0); // a pin that is 0 from the beginning has not fallen
  EXPECT_FALSE(b.host->functions().busy());
  b["change"].bit = true;
  b.scans(1); // the code
  EXPECT_EQ(b["m"].s32, 6);
  EXPECT_FALSE(b["mf"].bit);
  EXPECT_TRUE(b.host->functions().busy());
  b.scans(1); // the strobe; the program answers in the same scan
  EXPECT_TRUE(b["mf"].bit);
  EXPECT_TRUE(b["done"].bit);
  EXPECT_FALSE(b["changed"].bit);
  b.scans(1);
  EXPECT_FALSE(b["mf"].bit);
  EXPECT_FALSE(b["done"].bit);
  EXPECT_EQ(b["m"].s32, 6);
  EXPECT_FALSE(b["changed"].bit);
  b.scans(1);
  EXPECT_EQ(b["m"].s32, 0);
  EXPECT_TRUE(b["changed"].bit);
  EXPECT_FALSE(b.host->functions().busy());
  b.scans(5); // it is done once
  EXPECT_FALSE(b["mf"].bit);
  EXPECT_TRUE(b["changed"].bit);
  b["change"].bit = false;
  EXPECT_EQ(b.host->step(kMs), StepResult::Waiting); // the acknowledge does not wait for a slice
  EXPECT_FALSE(b["changed"].bit);
}

TEST(Functions, CodesFromPinsAndCodesThatStay) {
  Bench b(host::testing::gskProgram(), kFunctions);
  b["number"].s32 = 12;
  b["prepare"].bit = true;
  b.scans(4);
  EXPECT_TRUE(b["prepared"].bit);
  EXPECT_EQ(b["t"].s32, 12);
  EXPECT_EQ(b["m"].s32, 0);
}

// A tool is asked for, withdrawn, and another asked for while the first is on its way: the end of the first does not
// answer the second.
TEST(Functions, TheAcknowledgeIsOfTheLastCause) {
  Bench b(host::testing::gskProgram(), kFunctions);
  b["held"].bit = true; // the program keeps its answer back
  b["number"].s32 = 5;
  b["prepare"].bit = true;
  b.scans(3);
  EXPECT_EQ(b["t"].s32, 5);
  b["prepare"].bit = false;
  b.host->step(kMs);
  b["number"].s32 = 7;
  b["prepare"].bit = true;
  b.host->step(kMs);
  b["held"].bit = false;
  bool early = false;
  for (int i = 0; i < 20 && b["t"].s32 == 5; ++i) {
    b.scans(1);
    early = early || (b["prepared"].bit && b["t"].s32 == 5);
  }
  EXPECT_FALSE(early);
  EXPECT_EQ(b["t"].s32, 7);
  EXPECT_FALSE(b["prepared"].bit);
  b.scans(6);
  EXPECT_TRUE(b["prepared"].bit);
}

TEST(Functions, OfOneKindWaitInTheirOrder) {
  Bench b(host::testing::gskProgram(), kFunctions);
  std::vector<int32_t> codes;
  const auto oneMs = [&] {
    b.host->step(kMs);
    if (b["mf"].bit && (codes.empty() || codes.back() != b["m"].s32)) codes.push_back(b["m"].s32);
  };
  b["cw"].bit = true; // all of this between two slices
  oneMs();
  b["cw"].bit = false;
  oneMs();
  b["change"].bit = true;
  oneMs();
  for (int i = 0; i < 200; ++i) oneMs();
  EXPECT_THAT(codes, ElementsAre(3, 5, 6));
  EXPECT_TRUE(b["changed"].bit);
}

// FIN is common: functions of one slot run side by side, a later one waits for it.
TEST(Functions, OfOneSlotRunSideBySide) {
  Bench b(host::testing::gskProgram(), kFunctions);
  b["held"].bit = true;
  b["cw"].bit = b["prepare"].bit = true;
  b.scans(2);
  EXPECT_TRUE(b["mf"].bit);
  EXPECT_TRUE(b["tf"].bit);
  b["cw"].bit = false;
  b.scans(3);
  EXPECT_EQ(b["m"].s32, 3);
  b["fin"].bit = true;
  b.scans(2);
  EXPECT_FALSE(b["mf"].bit);
  EXPECT_FALSE(b["tf"].bit);
  b["fin"].bit = false;
  b.scans(2);
  EXPECT_TRUE(b["prepared"].bit);
  EXPECT_EQ(b["m"].s32, 5);
}

// A tool that takes its time to come does not hold up the spindle's stop.
TEST(Functions, OfTheHighSpeedModeDoNotWaitForOtherKinds) {
  Bench b(host::testing::gskProgram(), std::string(kFunctions) + R"(
high-speed = true
in.tool-there = { type = "bit", name = "X2.1" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  b["prepare"].bit = true;
  b.scans(3);
  EXPECT_TRUE(b["tf"].bit);
  b["change"].bit = true;
  b.scans(3);
  EXPECT_TRUE(b["changed"].bit);
  EXPECT_FALSE(b["prepared"].bit);
  b["tool-there"].bit = true;
  b.scans(2);
  EXPECT_TRUE(b["prepared"].bit);
}

TEST(Functions, AnAnswerCountsOnceItWasAbsent) {
  Bench b(host::testing::gskProgram(), kFunctions);
  b["held"].bit = b["fin"].bit = true; // finished before anything was asked
  b["change"].bit = true;
  b.scans(20);
  EXPECT_TRUE(b["mf"].bit);
  EXPECT_FALSE(b["changed"].bit);
  b["fin"].bit = false;
  b.scans(2);
  EXPECT_TRUE(b["mf"].bit);
  b["fin"].bit = true;
  b.scans(2);
  EXPECT_FALSE(b["mf"].bit);
  EXPECT_FALSE(b["changed"].bit);
  b["fin"].bit = false;
  b.scans(2);
  EXPECT_TRUE(b["changed"].bit);
}

TEST(Functions, AnAbortEndsThemAndWhatItSendsGoesAtOnce) {
  Bench b(host::testing::gskProgram(), kFunctions);
  b["cw"].bit = true;
  b.scans(5);
  b["held"].bit = true;
  b["prepare"].bit = b["change"].bit = true;
  b.scans(3);
  EXPECT_TRUE(b["mf"].bit);
  EXPECT_TRUE(b["tf"].bit);
  b["estop"].bit = true;
  b["cw"].bit = false; // with the same event
  b.scans(1);
  EXPECT_FALSE(b["mf"].bit);
  EXPECT_FALSE(b["tf"].bit);
  EXPECT_EQ(b["m"].s32, 5);
  b["held"].bit = false;
  b.scans(5);
  EXPECT_FALSE(b["changed"].bit);
  EXPECT_FALSE(b["prepared"].bit);
  EXPECT_FALSE(b.host->functions().busy());
}

TEST(Functions, OneThatTakesTooLongShows) {
  Bench b(host::testing::gskProgram(), kFunctions);
  b["held"].bit = true;
  b["change"].bit = true;
  for (int i = 0; i < 1500; ++i) b.host->step(kMs);
  EXPECT_FALSE(b.host->functions().late());
  EXPECT_FALSE(b.host->functions().state().oldest[0].late);
  b["prepare"].bit = true;
  b.host->step(2 * kMs);
  EXPECT_TRUE(b.host->functions().late());
  const FunctionState state = b.host->functions().state();
  EXPECT_EQ(state.count, 2u);
  const FunctionState::Function& first = state.oldest[0];
  EXPECT_EQ(std::tuple(first.kind, first.code, first.channel), std::tuple(RUNG_FUNCTION_M, 6u, 0u));
  EXPECT_GE(first.ageNs, 1500 * kMs);
  EXPECT_TRUE(first.begun);
  EXPECT_TRUE(first.late);
  EXPECT_EQ(state.oldest[1].kind, RUNG_FUNCTION_T);
  EXPECT_FALSE(state.oldest[1].late);
  b["prepare"].bit = false;
  b["held"].bit = false; // it still ends
  b.scans(4);
  EXPECT_TRUE(b["changed"].bit);
  b.host->step(kMs);
  EXPECT_FALSE(b.host->functions().late());
}

TEST(Functions, NoAcknowledgeWhenTheCauseHasGone) {
  Bench b(host::testing::gskProgram(), kFunctions);
  b["change"].bit = true;
  b.scans(1);
  b["change"].bit = false;
  b.scans(6);
  EXPECT_FALSE(b["changed"].bit);
}

// A restart is a start: what is on already is an edge, whatever the pins were when the program stopped.
class RestartedFunctions : public ::testing::Test {
protected:
  void restart() {
    b["bad"].bit = true;
    EXPECT_EQ(b.host->step(8 * kMs), StepResult::Failed);
    b["bad"].bit = false;
    b.host->step(0, true);
    std::vector<Report> reports;
    EXPECT_TRUE(b.host->serve(reports));
  }

  Bench b{host::testing::gskProgram(), std::string(kFunctions) + R"(in.bad = { type = "bit", name = "X1.0" })"};
};

TEST_F(RestartedFunctions, AreHandedOverAgain) {
  ASSERT_THAT(b.errors, IsEmpty());
  b["change"].bit = true;
  b.scans(5);
  EXPECT_TRUE(b["changed"].bit);
  restart();
  EXPECT_FALSE(b["changed"].bit);
  b.scans(1);
  EXPECT_EQ(b["m"].s32, 6);
  b.scans(4);
  EXPECT_TRUE(b["changed"].bit);
}

TEST_F(RestartedFunctions, AreNewWithoutTheirPins) {
  b["cw"].bit = true;
  b.scans(5);
  b["held"].bit = true;
  b["change"].bit = b["prepare"].bit = true;
  b.scans(200);
  EXPECT_TRUE(b.host->functions().late());
  EXPECT_EQ(b["m"].s32, 6);
  EXPECT_TRUE(b["tf"].bit);
  b["cw"].bit = b["change"].bit = b["prepare"].bit = false;
  restart();
  EXPECT_FALSE(b.host->functions().late());
  b.scans(3);
  EXPECT_EQ(b["m"].s32, 0); // nor has "cw", which is off, fallen
  EXPECT_FALSE(b["tf"].bit);
  EXPECT_FALSE(b.host->functions().busy());
}

TEST(Functions, PinsOfAbortsAreEdgesAfterARestart) {
  std::vector<std::string> errors;
  const host::File map = host::parseMap(R"(
send = [{ pin = "a", edge = "rise", function = "M", code = 3 }]
abort = [{ pin = "on", edge = "rise" }, { pin = "off", edge = "fall" }]
)",
                                        "m.map", errors);
  ASSERT_THAT(errors, IsEmpty());
  bool a = false, on = true, off = false;
  const PinCell cells[] = {{.bit = &a}, {.bit = &on}, {.bit = &off}};
  Pins pins(map.pins);
  pins.connect(cells, kVariables);
  Instance plc(Image::adopt(host::testing::gskProgram()));
  plc.powerOn();
  // Whether a function that is under way is still so after the pins have been looked at.
  FunctionQueue functions(map, plc.handle());
  const auto survives = [&] {
    uint32_t line = 0;
    for (int i = 0; i < 20 && rung_instance_begin_function(plc.handle(), 0, RUNG_FUNCTION_M, 3, &line) != RUNG_OK; ++i)
      plc.scan();
    EXPECT_EQ(rung_instance_function_done(plc.handle(), 0, line), RUNG_LATER);
    pins.read();
    functions.sample(pins, kMs);
    const bool goesOn = rung_instance_function_done(plc.handle(), 0, line) == RUNG_LATER;
    rung_instance_abort_functions(plc.handle(), 0);
    return goesOn;
  };
  for (int round = 0; round < 2; ++round) {
    EXPECT_FALSE(survives()) << round;
    EXPECT_TRUE(survives()) << round;
    functions.restart();
  }
}

TEST(Functions, WhatFindsTheQueueFullIsCounted) {
  Bench b(
      host::testing::gskProgram(),
      R"(send = [{ pin = "a", edge = "rise", function = "M", code = 3 }])"); // no slice runs, so nothing is finished
  for (uint32_t i = 0; i < FunctionQueue::kRoom + 3; ++i) {
    b["a"].bit = true;
    b.host->step(kMs / 1000);
    b["a"].bit = false;
    b.host->step(kMs / 1000);
  }
  EXPECT_EQ(b.host->functions().lost(), 3u);
}

// Two functions for the two levels of a pin: the last level arrives, even where some before it were lost.
TEST(Functions, TheEndOfALevelIsNotLost) {
  Bench b(host::testing::gskProgram(), kFunctions);
  ASSERT_THAT(b.errors, IsEmpty());
  b.scans(1);
  b["change"].bit = true; // takes a place, so that the last one that finds room is the beginning of a level
  b.host->step(kMs / 1000);
  for (uint32_t i = 0; i < FunctionQueue::kRoom / 2; ++i)
    for (const bool on : {true, false}) {
      b["cw"].bit = on;
      b.host->step(kMs / 1000);
    }
  EXPECT_EQ(b.host->functions().lost(), 1u);
  uint32_t begun[7] = {};
  for (int32_t former = 0, i = 0; b.host->functions().busy() && i < 1000; ++i) {
    b.scans(1);
    const int32_t now = b["m"].s32;
    if (now != former && now != 0) ++begun[now];
    former = now;
  }
  EXPECT_EQ(begun[3], FunctionQueue::kRoom / 2);
  EXPECT_EQ(begun[5], FunctionQueue::kRoom / 2) << "the last one found the queue full, and its cause is still there";
  EXPECT_EQ(b.host->functions().lost(), 1u);
}

// ---- real time -----------------------------------------------------------------------------------------------------

int allocationsIn(Bench& b, int64_t ms) {
  return allocationsOf([&] {
    for (int64_t i = 0; i < ms; ++i) b.host->step(kMs);
  });
}

// By hand, so that what calls the host in every scan is among it; tests/realtime does it with compiled programs.
TEST(PlcHost, AStepAllocatesNothing) {
  Bench gsk(host::testing::gskProgram(), kFunctions);
  gsk["change"].bit = gsk["cw"].bit = true;
  EXPECT_EQ(allocationsIn(gsk, 200), 0);
  EXPECT_TRUE(gsk["changed"].bit);

  Bench busy(host::testing::gskProgram(), R"(
in.ask = { type = "bit", name = "X1.1" }
in.show = { type = "bit", name = "X1.2" }
in.bad = { type = "bit", name = "X1.0" }
out.o = { type = "bit", name = "Y0.0" }
)");
  busy["ask"].bit = busy["show"].bit = true;
  EXPECT_EQ(allocationsIn(busy, 100), 0);
  busy["bad"].bit = true;
  EXPECT_EQ(allocationsIn(busy, 8), 0);
  EXPECT_STREQ(busy.host->fault()->code, "dead-loop");

  Bench nct(host::testing::nctProgram(), R"(
in.i = { type = "bit", name = "0056.17" }
out.o = { type = "bit", name = "0400.00" }
in.show = { type = "bit", name = "0056.18" }
)");
  EXPECT_EQ(allocationsIn(nct, 1000), 0);
  nct["show"].bit = true;
  EXPECT_EQ(allocationsIn(nct, 500), 0);
  nct["show"].bit = false;
  EXPECT_EQ(allocationsIn(nct, 500), 0);
  EXPECT_EQ(nct.host->state().scans, 200u);
}

} // namespace
} // namespace rung::host
