// Border copies leave out what no rung touches, and a host that looks there finds what is to be there, whenever it
// begins to.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>
#include <thread>

#include "tests/unit/runtime/test_image.h"

namespace {

using rung::test::TestProgram;

// A run copies AREA over SEEN. A rung takes byte 1000 of SEEN to COPY; nothing reads its byte 10.
constexpr uint32_t kCopy = 1, kArea = 64, kSeen = 2112, kBytes = 2048;

const uint8_t* block = nullptr;    // of the program that has run last
std::function<void()> withinAPass; // what somebody else does meanwhile

uint32_t take(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  block = mem;
  mem[kCopy] = mem[kSeen + 1000];
  if (withinAPass) withinAPass();
  return rung::test::popChunk(ctx);
}

TestProgram made() {
  TestProgram program;
  program.memorySize = 8192;
  program.addPacked("OWN", 1, 16, 0);
  program.addPacked("AREA", 1, kBytes, kArea);
  program.addPacked("SEEN", 1, kBytes, kSeen);
  program.addSymbol("COPY", 0, kCopy, RUNG_TYPE_I8);
  program.addSymbol("AREA10", 1, 10, RUNG_TYPE_I8);
  program.addSymbol("AREA1000", 1, 1000, RUNG_TYPE_I8);
  program.addSymbol("SEEN10", 2, 10, RUNG_TYPE_I8);
  program.addSymbol("SEEN_ARRAY", 2, 500, RUNG_TYPE_I32, 0, 200);
  program.addSymbol("SEEN1000", 2, 1000, RUNG_TYPE_I8);
  program.addTask("MAIN", program.addChunk(&take));
  program.addReads(0, {{kArea, kBytes}, {kSeen + 1000, 1}});
  program.writes = {{kCopy, 1, 255}};
  program.addBeginCopy(0, {RUNG_COPY_ALL, kArea, kSeen, 0, kBytes});
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 1000}, {RUNG_STEP_RUN, 0, 1}};
  return program;
}

class BytesThatCopiesLeaveOut : public testing::Test {
protected:
  BytesThatCopiesLeaveOut() {
    withinAPass = nullptr;
    area10 = plc.find("AREA10", rung::Access::Write);
    area1000 = plc.find("AREA1000", rung::Access::Write);
    copy = plc.find("COPY");
    plc.powerOn(rung::Power::Cold);
    scanWith(5);
  }
  ~BytesThatCopiesLeaveOut() override { withinAPass = nullptr; }

  template <class Work>
  static void byAnotherThread(Work work) {
    std::thread(work).join();
  }
  void scanWith(int value) {
    plc.write(area10, value);
    plc.write(area1000, value);
    plc.scan();
    EXPECT_EQ(plc.read<int>(copy), value);
  }

  TestProgram program = made();
  rung::Image image = rung::Image::adopt(program.link());
  rung::Instance plc{image};
  rung_cell area10, area1000, copy;
};

TEST_F(BytesThatCopiesLeaveOut, AreNotCopiedWhereNobodyLooks) {
  EXPECT_EQ(block[kSeen + 10], 0);
  plc.find("SEEN1000");
  scanWith(6);
  EXPECT_EQ(block[kSeen + 10], 0) << "what was found is copied anyway";
}

TEST_F(BytesThatCopiesLeaveOut, AreThereForWhoReadsThem) {
  const rung_cell cell = plc.find("SEEN10");
  EXPECT_EQ(plc.read<int>(cell), 5) << "found after the pass";
  scanWith(6);
  EXPECT_EQ(plc.read<int>(cell), 6);
}

TEST_F(BytesThatCopiesLeaveOut, AreThereForWhoReadsAnArrayThatReachesThere) {
  plc.find("SEEN_ARRAY");
  scanWith(6);
  EXPECT_EQ(block[kSeen + 10], 6);
}

TEST_F(BytesThatCopiesLeaveOut, AreThereForAWatchThatBeginsWithinAPass) {
  std::optional<rung::Watch> watch;
  withinAPass = [&] {
    if (watch) return;
    byAnotherThread([&] {
      const rung_cell cell = plc.find("SEEN10");
      watch.emplace(plc, std::span(&cell, 1), 4);
    });
  };
  scanWith(6);
  scanWith(7);
  for (const int value : {6, 7}) {
    const auto sample = watch->next();
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->values[0].integer, value);
  }
}

TEST_F(BytesThatCopiesLeaveOut, AreThereForCallbacks) {
  rung_cell cell = 0;
  rung_value value{};
  withinAPass = [&] {
    byAnotherThread([&] { cell = plc.find("SEEN10"); });
    rung::check(rung_instance_read(plc.handle(), cell, 0, 1, &value));
  };
  scanWith(6);
  EXPECT_EQ(value.integer, 6);
}

TEST_F(BytesThatCopiesLeaveOut, AreThereForVariablesAndBlocks) {
  plc.powerOff();
  int8_t variable = 0;
  std::array<uint8_t, 4> bytes{};
  rung::Instance variables(image), blocks(image);
  variables.bindOutput("SEEN10", variable);
  blocks.bindOutputBlock("SEEN10", bytes);
  for (rung::Instance* instance : {&variables, &blocks}) {
    instance->powerOn(rung::Power::Cold);
    instance->write(instance->find("AREA10", rung::Access::Write), 9);
    instance->scan();
  }
  EXPECT_EQ(variable, 9);
  EXPECT_EQ(bytes[0], 9);
}

TEST_F(BytesThatCopiesLeaveOut, AreThereForTheNextProgramAndWhoLooksAtThatAlone) {
  TestProgram next = made();
  next.reads[1] = {kSeen + 10, 1}; // of SEEN; so byte 1000 is left out
  const rung::Image other = rung::Image::adopt(next.link());
  const rung_cell seen1000 = plc.find("SEEN1000");
  rung::Replacement replacement(plc, other);
  rung::check(plc.replace(replacement));
  scanWith(6);
  EXPECT_EQ(block[kSeen + 10], 6);
  EXPECT_EQ(plc.read<int>(seen1000), 6);
}

TEST_F(BytesThatCopiesLeaveOut, AreCopiedInABlockOfTheHost) {
  alignas(4096) static std::array<uint8_t, 8192> memory;
  auto options = rung::sized<rung_instance_options>();
  options.memory = memory.data();
  options.memory_bytes = memory.size();
  rung::Instance instance(image, &options);
  instance.powerOn(rung::Power::Cold);
  instance.write(instance.find("AREA10", rung::Access::Write), 8);
  instance.scan();
  EXPECT_EQ(memory[kSeen + 10], 8);
}

} // namespace
