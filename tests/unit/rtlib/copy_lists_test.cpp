// What of border copies is needed: what rungs touch, and in masks what they write.
#include "rtlib/run/loaded_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "rtlib/run/instance.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr uint32_t kM = 0, kTs = 2000, kMask = 4000, kOut = 6000, kBytes = 2000, kApart = 8000;

// A run copies TS over M, adds M 500 to M 1000, marks M 1000 as written, and M goes where it is marked to OUT.
uint32_t add(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  mem[kM + 1000] += mem[kM + 500];
  mem[kMask + 1000] = 255;
  return rung::test::popChunk(ctx);
}

class CopiesShortOfWhatNoRungTouches : public testing::Test {
protected:
  CopiesShortOfWhatNoRungTouches() {
    test.memorySize = 8192;
    for (const auto& [name, offset] : {std::pair{"M", kM}, {"TS", kTs}, {"@W", kMask}, {"OUT", kOut}})
      test.addPacked(name, 1, kBytes, offset);
    task = test.addTask("MAIN", test.addChunk(&add));
    test.addReads(task, {{kM + 500, 1}, {kM + 1000, 1}, {kTs, kBytes}});
    test.writes = {{kM + 1000, 1, 255}, {kMask + 1000, 1, 255}};
    test.addBeginCopy(task, {RUNG_COPY_ALL, kTs, kM, 0, kBytes});
    test.addEndCopy(task, {RUNG_COPY_MASKED, kM, kOut, kMask, kBytes});
    test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 1000}, {RUNG_STEP_RUN, task, 1}};
  }
  static std::vector<std::pair<uint32_t, uint32_t>> ends(std::span<const rung_copy> copies) {
    std::vector<std::pair<uint32_t, uint32_t>> list;
    for (const rung_copy& copy : copies) {
      EXPECT_EQ(copy.from, copy.kind == RUNG_COPY_ALL ? copy.to - kM + kTs : copy.to - kOut + kM);
      list.emplace_back(copy.to, copy.size);
    }
    return list;
  }
  uint32_t task;
  TestProgram test;
};

TEST_F(CopiesShortOfWhatNoRungTouches, HaveItsPieces) {
  const CopyLists lists(test.link(), false);
  const rung::core::NeededCopies copies = lists.views();
  EXPECT_THAT(ends(copies.of(copies.tasks[task].begin)), ElementsAre(std::pair(448u, 64u), std::pair(960u, 64u)));
  EXPECT_THAT(ends(copies.leftOut), ElementsAre(std::pair(0u, 448u), std::pair(512u, 448u), std::pair(1024u, 976u)));
  EXPECT_TRUE(copies.leavesOut(447, 2));
  EXPECT_FALSE(copies.leavesOut(448, 64));
  EXPECT_TRUE(copies.leavesOut(1999, 1));
  EXPECT_FALSE(copies.leavesOut(2000, 8)) << "where it is copied from";
}

TEST_F(CopiesShortOfWhatNoRungTouches, HaveMasksWhereTheyAreWritten) {
  const CopyLists lists(test.link(), false);
  const rung::core::NeededCopies copies = lists.views();
  const auto end = copies.of(copies.tasks[task].end);
  EXPECT_THAT(ends(end), ElementsAre(std::pair(kOut + 960, 64u)));
  EXPECT_EQ(end[0].mask, kMask + 960);
}

TEST_F(CopiesShortOfWhatNoRungTouches, JoinWhatIsNear) {
  test.reads[0] = {kM + 840, 1}; // two pieces before that of byte 1000
  const CopyLists lists(test.link(), false);
  const rung::core::NeededCopies copies = lists.views();
  EXPECT_THAT(ends(copies.of(copies.tasks[task].begin)), ElementsAre(std::pair(832u, 192u)));
}

TEST_F(CopiesShortOfWhatNoRungTouches, KeepWhatAnotherCopyTakes) {
  const uint32_t other = test.addTask("FAST", 0);
  test.addEndCopy(other, {RUNG_COPY_ALL, kM + 4, kOut + 4, 0, 4});
  const CopyLists lists(test.link(), false);
  EXPECT_EQ(lists.views().leftOut[0].to, 64u);
}

TEST_F(CopiesShortOfWhatNoRungTouches, KeepWhatIsRetained) {
  test.retains = {{kM + 100, 4}};
  const CopyLists lists(test.link(), false);
  EXPECT_FALSE(lists.views().leavesOut(kM + 100, 4));
}

TEST_F(CopiesShortOfWhatNoRungTouches, AreWholeWhereAProgramDoesNotSayWhatItReads) {
  test.addReads(task, {});
  EXPECT_THAT(CopyLists(test.link(), false).views().leftOut, IsEmpty());
}

TEST_F(CopiesShortOfWhatNoRungTouches, AreWholeWhereTheyAreShortOrOthersLook) {
  EXPECT_THAT(CopyLists(test.link(), true).views().leftOut, IsEmpty());
  test.copies[0].size = 255;
  EXPECT_THAT(CopyLists(test.link(), false).views().leftOut, IsEmpty());
}

class InstanceThatLeavesOut : public CopiesShortOfWhatNoRungTouches {
protected:
  // Byte i of TS becomes i + more.
  void fill(Instance& instance, uint8_t more) {
    const auto slice = instance.block().subspan(kTs, kBytes);
    std::iota(slice.begin(), slice.end(), more);
  }
  static bool isCopied(const Instance& instance, uint32_t byte) {
    return instance.block()[kM + byte] == instance.block()[kTs + byte];
  }
};

TEST_F(InstanceThatLeavesOut, DoesTheSameForRungsAndOutputs) {
  const rung_program& program = test.link();
  Instance whole(program), needed(program);
  needed.setNeededCopiesOnly(true);
  for (uint8_t pass = 1; pass < 5; ++pass) {
    for (Instance* instance : {&whole, &needed}) {
      fill(*instance, pass);
      instance->scan();
    }
    EXPECT_TRUE(isCopied(whole, 10));
    EXPECT_FALSE(isCopied(needed, 10));
    EXPECT_TRUE(std::ranges::equal(whole.block().subspan(kMask), needed.block().subspan(kMask))) << "masks, outputs";
  }
  needed.setNeededCopiesOnly(false);
  EXPECT_TRUE(std::ranges::equal(whole.block(), needed.block())) << "what was left out is brought in";
  fill(needed, 99);
  needed.scan();
  EXPECT_TRUE(isCopied(needed, 10));
}

TEST_F(InstanceThatLeavesOut, CopiesAllWhileSomebodyLooksOn) {
  class : public TaskWatch {
    void begins(const Instance&, uint32_t) override {}
    void ended(const Instance&, uint32_t) override {}
  } watch;
  Instance instance(test.link());
  instance.setNeededCopiesOnly(true);
  fill(instance, 1);
  instance.scan();
  instance.setTaskWatch(&watch);
  EXPECT_TRUE(isCopied(instance, 10));
  fill(instance, 2);
  instance.scan();
  EXPECT_TRUE(isCopied(instance, 10));
  instance.setTaskWatch(nullptr);
  fill(instance, 3);
  instance.scan();
  EXPECT_FALSE(isCopied(instance, 10));
}

// Counts runs elsewhere.
uint32_t touchNothingThatIsCopied(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  ++mem[kApart];
  return rung::test::popChunk(ctx);
}

TEST_F(InstanceThatLeavesOut, LeavesAllOutUntilSomebodyNeedsIt) {
  test.tasks[task].longest = 1; // so that nothing is counted
  TestProgram next = test;      // needs copies
  test.functions[0] = &touchNothingThatIsCopied;
  test.reads = {};
  test.addReads(task, {{kApart, 1}});
  test.writes = {{kApart, 1, 255}};
  class : public TaskWatch {
  public:
    int runs = 0;

  private:
    void begins(const Instance&, uint32_t) override { ++runs; }
    void ended(const Instance&, uint32_t) override {}
  } watch;
  const rung_program& running = test.link();
  Instance instance(running);
  instance.setNeededCopiesOnly(true);
  fill(instance, 1);
  instance.scan();
  EXPECT_FALSE(isCopied(instance, 500));
  EXPECT_EQ(instance.block()[kApart], 1);

  instance.setTaskWatch(&watch);
  instance.scan();
  EXPECT_EQ(watch.runs, 1);
  EXPECT_TRUE(isCopied(instance, 500));
  instance.setTaskWatch(nullptr);
  fill(instance, 2);
  instance.scan();
  EXPECT_EQ(watch.runs, 1);
  EXPECT_FALSE(isCopied(instance, 500));
  EXPECT_EQ(instance.block()[kApart], 3);

  Replacement replacement(running, {next.link()});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  fill(instance, 3);
  instance.scan();
  EXPECT_TRUE(isCopied(instance, 500));
  EXPECT_FALSE(isCopied(instance, 10));
}

TEST_F(InstanceThatLeavesOut, BringsItInForTheNextProgram) {
  TestProgram next = test;
  const rung_program& running = test.link();
  Instance instance(running);
  instance.setNeededCopiesOnly(true);
  fill(instance, 7);
  instance.scan();
  Replacement replacement(running, {next.link()});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_TRUE(isCopied(instance, 10));
  fill(instance, 8);
  instance.scan();
  EXPECT_FALSE(isCopied(instance, 10));
}

TEST_F(InstanceThatLeavesOut, CopiesAllInABlockOfItsHost) {
  std::vector<uint8_t> block(8192 + 4096);
  void* at = block.data();
  size_t room = block.size();
  auto* memory = static_cast<uint8_t*>(std::align(4096, 8192, at, room));
  Instance instance(Runnable{test.link(), nullptr, memory});
  instance.setNeededCopiesOnly(true);
  fill(instance, 1);
  instance.scan();
  EXPECT_TRUE(isCopied(instance, 10));
}

} // namespace
