// Compiled programs between HAL pins, in the situations that are rare: faults at the start and their last module, the
// request to save, damaged and foreign files, a disk that is full, time slices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

#include "ir/support/temporary_folder.h"
#include "tests/support/compiled_program.h"
#include "tests/support/patience.h"
#include "tests/unit/host/bench.h"

namespace rung::host {
namespace {

using rung::testing::CompiledProgram;
using testing::Bench;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kMs;
using testing::textsOf;

// Of the scenarios.
std::string textOf(const std::string& path) {
  std::ifstream file("tests/scenarios/" + path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

// ---- TECHNOL: faults -----------------------------------------------------------------------------------------------

// FATAL stops the program: a division by zero, in MODULE_INIT if the cell is 1 that is kept. MODULE_HALT shows message
// 13.
constexpr const char* kFaults = R"(DATA
        DFM FATAL,LAMP,KEEP
Z:      DS 4
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_MAIN
        FL   1,LAMP
        LDR  KEEP
        JL0  FREE
        LOD  CNST.1
        STO  BYTE.PLC_MEM_BACKUP
FREE:   LDR  FATAL
        JL0  FINE
        LOD  CNST.5
        DIVB DWRD.Z
FINE:
MODULE_MAIN_END
MODULE_INIT
        LOD  BYTE.PLC_MEM_BACKUP
        EQ   CNST.1
        JL0  READY
        LOD  CNST.5
        DIVB DWRD.Z
READY:
MODULE_INIT_END
MODULE_DONE
MODULE_DONE_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
        ESET 13
MODULE_HALT_END
STOP
)";
constexpr const char* kFaultsMap = R"(
in.fatal = { type = "bit", name = "FATAL" }
in.keep = { type = "bit", name = "KEEP" }
out.lamp = { type = "bit", name = "LAMP" }
)";

class TechnolFaults : public ::testing::Test {
protected:
  static Bench start(const rung_program& program, const std::string& retain = {}) {
    Bench b(program, kFaultsMap, retain);
    EXPECT_THAT(b.errors, IsEmpty());
    return b;
  }
  static std::string reason(const Bench& b) { return b.host->fault()->code; }

  CompiledProgram program{"faults.plc", kFaults};
  TemporaryFolder folder;
};

TEST_F(TechnolFaults, ModuleHaltRunsInTheScanOfTheFault) {
  Bench b = start(program.program());
  b.run(20);
  EXPECT_TRUE(b["lamp"].bit);
  EXPECT_THAT(b.messages(&rung_message_info::number), IsEmpty());
  b["fatal"].bit = true;
  StepResult last = StepResult::Ran;
  for (int ms = 0; ms < 40 && last != StepResult::Failed; ++ms) last = b.host->step(kMs);
  EXPECT_EQ(last, StepResult::Failed);
  EXPECT_THAT(reason(b), HasSubstr("halt-status 2"));
  EXPECT_FALSE(b["lamp"].bit);
  EXPECT_THAT(b.messages(&rung_message_info::number), ElementsAre(13u));
  EXPECT_EQ(b.host->step(kMs), StepResult::Waiting);
  EXPECT_THAT(b.messages(&rung_message_info::number), IsEmpty()); // once
}

// The fault is there before the first scan, and shows in the first step; a restart comes to the same.
TEST_F(TechnolFaults, InModuleInit) {
  const std::string file = (folder / "plc").string();
  {
    Bench b = start(program.program(), file);
    b["keep"].bit = true;
    b.run(40);
    EXPECT_EQ(b.host->close(), "");
  }
  Bench b = start(program.program(), file);
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(b.host->step(kMs), StepResult::Failed);
    EXPECT_THAT(reason(b), HasSubstr("halt-status 2"));
    EXPECT_FALSE(b["lamp"].bit);
    EXPECT_EQ(b.host->state().scans, 0u);
    b.host->step(kMs, true);
    std::vector<Report> reports;
    EXPECT_TRUE(b.host->serve(reports));
    EXPECT_THAT(textsOf(reports), ElementsAre(HasSubstr("halt-status 2"), "the program has been restarted"));
  }
}

// ---- TECHNOL: memory that is kept -----------------------------------------------------------------------------------

constexpr const char* kBackupMap = R"(
in.go = { type = "bit", name = "GO" }
in.last = { type = "u32", name = "AREA[9]" }
out.asked = { type = "bit", name = "REQ_BACKUP_MEM" }
out.saved = { type = "bit", name = "SAVED" }
out.starts = { type = "u32", name = "PLC_MEM_BACKUP+9996:4" }
out.kept = { type = "u32", name = "PLC_MEM_BACKUP[29]" }
)";

// Files of this process cannot become longer meanwhile: the disk is full.
class FullDisk {
public:
  explicit FullDisk(rlim_t mostBytes) {
    before_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit small = {mostBytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

private:
  rlimit limit_{};
  void (*before_)(int) = nullptr;
};

// Counts its starts in what it keeps, and saves when GO rises.
class TechnolBackup : public ::testing::Test {
protected:
  Bench start() {
    Bench b(program.program(), kBackupMap, file);
    EXPECT_THAT(b.errors, IsEmpty());
    b.run(40);
    return b;
  }
  // Files are written by another thread, which looks five times a second.
  template <class Condition>
  static bool runUntil(Bench& b, Condition condition) {
    return test::soon([&] { return b.run(20), condition(); }, std::chrono::milliseconds(5));
  }
  void damage() const {
    for (const char* ending : {".a", ".b"}) std::ofstream(file + ending) << "junk";
  }

  CompiledProgram program{"backup.plc", textOf("technol/backup.plc")};
  TemporaryFolder folder;
  std::string file = (folder / "plc").string();
};

TEST_F(TechnolBackup, IsSavedWhenTheProgramAsksAndAtTheEnd) {
  {
    Bench b = start();
    EXPECT_EQ(b["starts"].u32, 1u);
    const uint64_t first = b.host->state().saves;
    b["go"].bit = true;
    b.run(20);
    b["go"].bit = false;
    EXPECT_TRUE(b["asked"].bit);
    EXPECT_FALSE(b["saved"].bit);
    ASSERT_TRUE(runUntil(b, [&] { return b["saved"].bit; }));
    EXPECT_FALSE(b["asked"].bit);
    EXPECT_GT(b.host->state().saves, first);
    b["last"].u32 = 0x5A; // MODULE_DONE keeps it
    b.run(20);
    EXPECT_EQ(b.host->close(), "");
  }
  Bench b = start();
  EXPECT_THAT(b.warnings, IsEmpty());
  EXPECT_EQ(b["starts"].u32, 2u);
  EXPECT_EQ(b["kept"].u32, 0x5Au);
}

TEST_F(TechnolBackup, DamagedFilesAreReportedAndItStartsCold) {
  EXPECT_EQ(start().host->close(), "");
  damage();
  {
    Bench b = start();
    EXPECT_THAT(b.warnings, ElementsAre(HasSubstr("plc.b: too short; starting cold")));
    EXPECT_EQ(b["starts"].u32, 1u);
    EXPECT_EQ(b.host->close(), "");
  }
  Bench b = start();
  EXPECT_THAT(b.warnings, IsEmpty());
  EXPECT_EQ(b["starts"].u32, 2u);
}

TEST_F(TechnolBackup, OneOfTwoFilesIsEnough) {
  EXPECT_EQ(start().host->close(), "");
  EXPECT_EQ(start().host->close(), "");
  std::ofstream(file + ".a") << "junk";
  Bench b = start();
  EXPECT_THAT(b.warnings, ElementsAre(HasSubstr(".a")));
  EXPECT_GE(b["starts"].u32, 2u);
}

TEST_F(TechnolBackup, AnotherProgramsFilesAreReportedAndItStartsCold) {
  const CompiledProgram other("other.pmc", "dialect gsk\nFUNC END1\nLD X0.0\nOUT Y0.0\nFUNC END2\n");
  {
    Bench b(other.program(), "", file);
    ASSERT_THAT(b.errors, IsEmpty());
    b.run(16);
    EXPECT_EQ(b.host->close(), "");
  }
  Bench b = start();
  EXPECT_EQ(b.warnings.size(), 1u);
  EXPECT_EQ(b["starts"].u32, 1u);
}

TEST_F(TechnolBackup, AFullDiskMakesTheProgramWait) {
  Bench b = start();
  {
    const FullDisk full(1000);
    b["go"].bit = true;
    ASSERT_TRUE(runUntil(b, [&] { return b.host->failsToSave(); }));
    b.run(200);
    EXPECT_TRUE(b["asked"].bit);
    EXPECT_FALSE(b["saved"].bit);
  }
  EXPECT_TRUE(runUntil(b, [&] { return b["saved"].bit; })); // tried again and again
  EXPECT_FALSE(b.host->failsToSave());
  EXPECT_EQ(b.host->close(), "");
}

TEST_F(TechnolBackup, ADiskThatIsFullAtTheEndIsReported) {
  Bench b = start();
  const FullDisk full(1000);
  EXPECT_THAT(b.host->close(), HasSubstr("cannot write"));
}

// ---- NCT
// -------------------------------------------------------------------------------------------------------------

// Five time slices of 2 ms are a cycle; INT0 runs in each.
TEST(NctSlices, Int0IsFasterThanMain) {
  const CompiledProgram program("int0.lad", textOf("nct/int0.lad"));
  Bench b(program.program(), R"(
in.input = { type = "bit", name = "INP000.00" }
out.main = { type = "bit", name = "OUT000.00" }
out.at-once = { type = "bit", name = "OUT000.01" }
out.cycles = { type = "u32", name = "N" }
out.slices = { type = "u32", name = "FAST" }
)");
  ASSERT_THAT(b.errors, IsEmpty());
  uint32_t slices = 0;
  for (int ms = 0; ms < 100; ++ms) {
    slices += b.host->step(kMs) == StepResult::Ran ? 1 : 0;
    EXPECT_EQ(b.host->state().scans, slices / 5);
  }
  EXPECT_EQ(slices, 50u);
  EXPECT_EQ(b["cycles"].u32, 10u);
  EXPECT_EQ(b["slices"].u32, 50u);
  b["input"].bit = true;
  int atOnce = 0;
  int main = 0;
  for (int ms = 1; ms <= 40 && main == 0; ++ms) {
    b.host->step(kMs);
    if (atOnce == 0 && b["at-once"].bit) atOnce = ms;
    if (b["main"].bit) main = ms;
  }
  EXPECT_EQ(atOnce, 2); // with the next time slice
  EXPECT_GE(main, 10);  // with the end of a cycle that has seen it
  EXPECT_LE(main, 20);
}

} // namespace
} // namespace rung::host
