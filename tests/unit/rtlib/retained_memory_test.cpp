// What a host does with the retained memory: whole scans alone reach the disk, and a request is answered when its bytes
// are there.
#include "rtlib/retain/retained_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kNever = std::chrono::hours(1); // the saver looks only when it must: a slow disk

// Two slices a scan. Byte 0 counts scans, bytes 4 to 6 are retained copies of it, the last one of the second slice.
// Where the count is byte 8 or byte 9, the program stops in its first or second slice, and byte 5 is made safe.
class RetainedMemoryTest : public testing::Test {
protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "rung_retained_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    file = (folder / "plc").string();
    test.addPacked("R", 1, 64, 0);
    test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) {
      mem[4] = mem[5] = ++mem[0];
      return mem[8] != 0 && mem[0] == mem[8] ? RUNG_PC_FAULT : RUNG_PC_DONE;
    });
    test.addChunk([](uint8_t* mem, rung_ctx*, uint32_t) {
      mem[6] = mem[0];
      return mem[9] != 0 && mem[0] == mem[9] ? RUNG_PC_FAULT : RUNG_PC_DONE;
    });
    test.addTask("MAIN", 0, 1000);
    test.addTask("LATE", 1, 1000);
    test.retains = {{4, 3}};
    test.safeSpans = {{5, 1}};
    test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 4000},
                 {RUNG_STEP_RUN, 0, 1},
                 {RUNG_STEP_ADVANCE, RUNG_NONE, 4000},
                 {RUNG_STEP_RUN, 1, 1}};
    test.link();
    instance = std::make_unique<Instance>(test.program);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::unique_ptr<RetainedMemory> started(RetainWhen when, std::chrono::milliseconds period = kNever) {
    auto memory = std::make_unique<RetainedMemory>(test.program, file, when, &takeRetainedOf, period);
    found = memory->load(*instance, report, error);
    EXPECT_EQ(error, "");
    return memory;
  }
  void slices(RetainedMemory& memory, int count) {
    for (int i = 0; i < count; ++i) {
      instance->slice();
      memory.offer(*instance, false);
    }
  }
  std::vector<uint8_t> onDisk() const {
    return RetainStore(file, RetainMap(test.program).layout().hash, RetainMap(test.program).size()).load().bytes;
  }
  using Bytes = std::vector<uint8_t>;

  fs::path folder;
  std::string file;
  TestProgram test;
  std::unique_ptr<Instance> instance;
  std::string report;
  std::string error;
  bool found = false;
};

TEST_F(RetainedMemoryTest, ContinuesWhereItStopped) {
  {
    const auto memory = started(RetainWhen::Always);
    EXPECT_FALSE(found);
    EXPECT_FALSE(memory->lost());
    slices(*memory, 6);
    EXPECT_EQ(memory->finish(*instance), "");
  }
  instance = std::make_unique<Instance>(test.program);
  const auto memory = started(RetainWhen::Always);
  EXPECT_TRUE(found);
  EXPECT_EQ(instance->memory().readByte(0, 4), 3);
}

// The fault is in the second slice of the third scan: neither its bytes nor what was made safe are saved.
TEST_F(RetainedMemoryTest, AFaultLeavesTheLastWholeScan) {
  instance->memory().writeByte(0, 9, 3);
  const auto memory = started(RetainWhen::Always);
  slices(*memory, 10);
  ASSERT_TRUE(instance->faulted());
  EXPECT_EQ(instance->memory().readByte(0, 4), 3);
  EXPECT_EQ(instance->memory().readByte(0, 5), 0);
  EXPECT_FALSE(memory->offer(*instance, true));
  EXPECT_EQ(memory->finish(*instance), "");
  EXPECT_EQ(onDisk(), (Bytes{2, 2, 2}));
}

TEST_F(RetainedMemoryTest, AFaultInTheFirstSliceToo) {
  instance->memory().writeByte(0, 8, 3);
  const auto memory = started(RetainWhen::Always, std::chrono::milliseconds(1));
  slices(*memory, 10);
  ASSERT_TRUE(instance->faulted());
  EXPECT_EQ(memory->finish(*instance), "");
  EXPECT_EQ(onDisk(), (Bytes{2, 2, 2}));
}

TEST_F(RetainedMemoryTest, AFaultInTheFirstScanLeavesWhatWasLoaded) {
  {
    const auto memory = started(RetainWhen::Always);
    slices(*memory, 8);
    EXPECT_EQ(memory->finish(*instance), "");
  }
  instance = std::make_unique<Instance>(test.program);
  instance->memory().writeByte(0, 8, 1);
  const auto memory = started(RetainWhen::Always);
  slices(*memory, 2);
  ASSERT_TRUE(instance->faulted());
  EXPECT_EQ(memory->finish(*instance), "");
  EXPECT_EQ(onDisk(), (Bytes{4, 4, 4}));
}

TEST_F(RetainedMemoryTest, WithoutARequestOnlyTheEndIsSaved) {
  const auto memory = started(RetainWhen::OnRequest);
  slices(*memory, 20);
  EXPECT_TRUE(memory->flush());
  EXPECT_EQ(onDisk(), (Bytes{0, 0, 0}));
  EXPECT_EQ(memory->finish(*instance), "");
  EXPECT_EQ(onDisk(), (Bytes{10, 10, 10}));
}

TEST_F(RetainedMemoryTest, ARequestIsAnsweredWhenItsBytesAreOnDisk) {
  const auto memory = started(RetainWhen::OnRequest);
  slices(*memory, 3);
  EXPECT_FALSE(memory->offer(*instance, true)); // in the middle of a scan: it waits for its end
  slices(*memory, 1);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(memory->offer(*instance, true)); // the disk is slow
    instance->scan();
  }
  EXPECT_EQ(onDisk(), (Bytes{0, 0, 0}));
  EXPECT_TRUE(memory->flush());
  EXPECT_EQ(onDisk(), (Bytes{2, 2, 2}));
  EXPECT_TRUE(memory->offer(*instance, true));
  EXPECT_FALSE(memory->offer(*instance, false));
  EXPECT_EQ(memory->saved(), 1u);
  // The next one asks for bytes of its own, even if the last ones are on disk.
  instance->scan();
  EXPECT_FALSE(memory->offer(*instance, true));
  EXPECT_TRUE(memory->flush());
  EXPECT_TRUE(memory->offer(*instance, true));
  EXPECT_EQ(onDisk()[0], instance->memory().readByte(0, 4));
}

// A request that was withdrawn is not answered with the next one.
TEST_F(RetainedMemoryTest, ARequestThatWasWithdrawn) {
  const auto memory = started(RetainWhen::OnRequest);
  EXPECT_FALSE(memory->offer(*instance, true));
  EXPECT_TRUE(memory->flush());
  EXPECT_FALSE(memory->offer(*instance, false));
  instance->scan();
  EXPECT_FALSE(memory->offer(*instance, true));
}

TEST_F(RetainedMemoryTest, ARequestWaitsForADiskThatFails) {
  const auto memory = started(RetainWhen::OnRequest, std::chrono::milliseconds(1));
  instance->scan();
  for (const char* ending : {".a.tmp", ".b.tmp"}) fs::create_directory(file + ending);
  EXPECT_FALSE(memory->offer(*instance, true));
  EXPECT_FALSE(memory->flush());
  EXPECT_FALSE(memory->offer(*instance, true));
  EXPECT_TRUE(memory->failing());
  EXPECT_GE(memory->failed(), 1u);
  EXPECT_THAT(memory->problem(), HasSubstr("cannot write"));
  EXPECT_NE(memory->finish(*instance), "");
  for (const char* ending : {".a.tmp", ".b.tmp"}) fs::remove(file + ending);
  EXPECT_TRUE(memory->flush());
  EXPECT_TRUE(memory->offer(*instance, true));
  EXPECT_EQ(onDisk(), (Bytes{1, 1, 1}));
  EXPECT_EQ(memory->finish(*instance), ""); // what went wrong before is over
}

TEST_F(RetainedMemoryTest, AFaultDoesNotTakeBackARequest) {
  instance->memory().writeByte(0, 8, 3);
  const auto memory = started(RetainWhen::OnRequest);
  slices(*memory, 4);
  EXPECT_FALSE(memory->offer(*instance, true));
  slices(*memory, 2);
  ASSERT_TRUE(instance->faulted());
  EXPECT_EQ(memory->finish(*instance), "");
  EXPECT_EQ(onDisk(), (Bytes{2, 2, 2}));
}

TEST_F(RetainedMemoryTest, WhatIsLost) {
  EXPECT_EQ(started(RetainWhen::Always)->finish(*instance), "");
  EXPECT_FALSE(started(RetainWhen::Always)->lost());
  EXPECT_TRUE(found);
  EXPECT_EQ(report, "");
  fs::resize_file(file + ".a", 10);
  EXPECT_FALSE(started(RetainWhen::Always)->lost()); // the other one was good
  EXPECT_NE(report, "");
  for (const char* ending : {".a", ".b"}) fs::resize_file(file + ending, 10);
  EXPECT_TRUE(started(RetainWhen::Always)->lost());
  for (const char* ending : {".a", ".b"}) fs::remove(file + ending);
  EXPECT_TRUE(started(RetainWhen::Always)->lost());
  EXPECT_FALSE(found);
  EXPECT_FALSE(started(RetainWhen::Always)->lost());
}

TEST_F(RetainedMemoryTest, OneProgramAtATime) {
  const auto memory = started(RetainWhen::Always);
  RetainedMemory second(test.program, file);
  EXPECT_FALSE(second.load(*instance, report, error));
  EXPECT_THAT(error, HasSubstr("in use by another process"));
}

} // namespace
