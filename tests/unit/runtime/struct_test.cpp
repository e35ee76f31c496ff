// Structs of the host: bit-fields, whole copies of what its writer guards by counters, and the layout that a program
// was compiled for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstring>
#include <thread>
#include <vector>

#include "tests/unit/runtime/test_image.h"

namespace {

using rung::test::adopted;
using testing::HasSubstr;

constexpr uint32_t kIn = 32, kOut = 96; // offsets of the spaces

// What the control of a test writes and reads.
struct NcBlock {
  uint32_t head = 0;
  int32_t position = 0;
  uint8_t fields[8] = {};
  double feed = 0;
  int32_t flag = 0;
  int32_t copy = 0; // of `position`: an inconsistent copy shows
  uint8_t buttons[4] = {};
  uint8_t lamps[8] = {};
  uint32_t tail = 0;
};

rung_member row(const char* name, const char* member, size_t offset, uint32_t bytes, uint32_t type,
                uint32_t direction = RUNG_TO_PROGRAM) {
  return {name, member, static_cast<uint32_t>(offset), bytes, type, direction, 0, 0, 0};
}

rung_member bits(const char* name, size_t offset, uint32_t bit, uint32_t count, uint32_t type,
                 uint32_t direction = RUNG_TO_PROGRAM) {
  return {name, "fields", static_cast<uint32_t>(offset), (bit + count + 7) / 8, type, direction, bit, count, 0};
}

rung_layout layoutOf(const std::vector<rung_member>& members, bool guarded = false) {
  rung_layout layout{};
  layout.size = sizeof layout;
  layout.bytes = sizeof(NcBlock);
  layout.name = "NcBlock";
  layout.text = "NcBlock: 48 bytes\nin position: i32 at 4 = POSITION\n";
  layout.hash = 7;
  layout.members = members.data();
  layout.member_count = static_cast<uint32_t>(members.size());
  layout.counter_bytes = guarded ? 4 : 0;
  layout.head = offsetof(NcBlock, head);
  layout.tail = offsetof(NcBlock, tail);
  return layout;
}

// Copies IN to OUT, and notes where two cells that are always the same are not: OUT 40.
uint32_t copyAll(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  std::memcpy(mem + kOut, mem + kIn, 40);
  if (std::memcmp(mem + kIn, mem + kIn + 8, 4) != 0) mem[kOut + 40] = 1;
  return rung::test::popChunk(ctx);
}

void build(rung::test::TestProgram& program) {
  program.addPacked("IN", 1, 48, kIn);
  program.addPacked("OUT", 1, 48, kOut);
  program.addSymbol("POSITION", 0, 0, RUNG_TYPE_I32);
  program.addSymbol("BYTE", 0, 4, RUNG_TYPE_I8);
  program.addSymbol("BIT", 0, 5, RUNG_TYPE_BIT, 3);
  program.addSymbol("COPY", 0, 8, RUNG_TYPE_I32);
  program.addSymbol("FEED", 0, 16, RUNG_TYPE_F64);
  program.addSymbol("BUTTONS", 0, 24, RUNG_TYPE_I8);
  program.addSymbol("POSITION_OUT", 1, 0, RUNG_TYPE_I32);
  program.addSymbol("BYTE_OUT", 1, 4, RUNG_TYPE_I8);
  program.addSymbol("BIT_OUT", 1, 5, RUNG_TYPE_BIT, 3);
  program.addSymbol("BUTTONS_OUT", 1, 24, RUNG_TYPE_I8);
  program.addSymbol("TORN", 1, 40, RUNG_TYPE_I8);
  program.addTask("MAIN", program.addChunk(&copyAll));
  program.addReads(0, {{kIn, 40}});
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 1000}, {RUNG_STEP_RUN, 0, 1}};
}

class Structs : public testing::Test {
protected:
  Structs() {
    build(program_);
    program_.link();
    image_.emplace(adopted(program_));
    plc_.emplace(*image_);
  }
  int32_t bind(const std::vector<rung_member>& members, bool guarded = false) {
    const rung_layout layout = layoutOf(members, guarded);
    return rung_instance_bind_struct(plc_->handle(), &layout, &host_);
  }
  void scan() {
    if (!on_) plc_->powerOn();
    on_ = true;
    ASSERT_EQ(rung_instance_scan(plc_->handle()), RUNG_OK);
  }
  template <class T>
  T read(const char* name) {
    return plc_->read<T>(plc_->find(name));
  }

  rung::test::TestProgram program_;
  std::optional<rung::Image> image_;
  NcBlock host_;
  std::optional<rung::Instance> plc_;
  bool on_ = false;
};

TEST_F(Structs, MembersAreCells) {
  ASSERT_EQ(bind({row("POSITION", "position", offsetof(NcBlock, position), 4, RUNG_HOST_I32),
                  row("FEED", "feed", offsetof(NcBlock, feed), 8, RUNG_HOST_F64),
                  row("BIT", "flag", offsetof(NcBlock, flag), 4, RUNG_HOST_I32),
                  row("BUTTONS", "buttons", offsetof(NcBlock, buttons), 4, 0),
                  row("BUTTONS_OUT", "lamps", offsetof(NcBlock, lamps), 4, 0, RUNG_FROM_PROGRAM),
                  row("POSITION_OUT", "copy", offsetof(NcBlock, copy), 4, RUNG_HOST_I32, RUNG_FROM_PROGRAM)}),
            RUNG_OK)
      << rung_error_text();
  host_.position = -5;
  host_.feed = 1.5;
  host_.flag = 16; // not 0
  std::memcpy(host_.buttons, "\1\2\3\4", 4);
  scan();
  EXPECT_EQ(read<double>("FEED"), 1.5);
  EXPECT_EQ(read<int>("BIT"), 1);
  EXPECT_EQ(host_.copy, -5);
  EXPECT_EQ(std::memcmp(host_.lamps, "\1\2\3\4\0\0\0\0", 8), 0);
  plc_->powerOff();
  EXPECT_EQ(host_.copy, 0);
  EXPECT_EQ(host_.lamps[0], 0);
}

TEST_F(Structs, BitFieldsAreThemselvesAlone) {
  const size_t at = offsetof(NcBlock, fields);
  ASSERT_EQ(bind({bits("BYTE", at, 6, 5, RUNG_HOST_I64), bits("BIT", at + 2, 1, 1, RUNG_HOST_U32),
                  bits("BYTE_OUT", at + 4, 3, 7, RUNG_HOST_I64, RUNG_FROM_PROGRAM),
                  bits("BIT_OUT", at + 6, 7, 1, RUNG_HOST_BOOL, RUNG_FROM_PROGRAM)}),
            RUNG_OK)
      << rung_error_text();
  host_.fields[0] = 0xC0 | 0x15; // the lowest two of 5 bits
  host_.fields[1] = 0xA0 | 0x4;  // 10011: -13
  host_.fields[2] = 0xFD;        // bit 1 is 0
  host_.fields[4] = 0x02;
  host_.fields[5] = 0x80;
  host_.fields[6] = 0x11;
  scan();
  EXPECT_EQ(read<int>("BYTE"), -13);
  EXPECT_EQ(read<int>("BIT"), 0);
  EXPECT_EQ(host_.fields[4], 0x02 | 0x98); // -13 in 7 bits: 1110011
  EXPECT_EQ(host_.fields[5], 0x80 | 0x03);
  EXPECT_EQ(host_.fields[6], 0x11);
  host_.fields[2] = 0x02;
  scan();
  EXPECT_EQ(read<int>("BIT"), 1);
  EXPECT_EQ(host_.fields[6], 0x91);
}

TEST_F(Structs, ATornCopyIsNotGivenToTheProgram) {
  ASSERT_EQ(bind({row("POSITION", "position", offsetof(NcBlock, position), 4, RUNG_HOST_I32),
                  row("BUTTONS", "buttons", offsetof(NcBlock, buttons), 4, 0)},
                 true),
            RUNG_OK);
  uint32_t inconsistent = 99;
  host_.position = 1;
  host_.buttons[0] = 1;
  scan();
  EXPECT_EQ(read<int>("POSITION"), 1);
  ASSERT_EQ(rung_instance_inconsistent(plc_->handle(), &host_, &inconsistent), RUNG_OK);
  EXPECT_EQ(inconsistent, 0u);
  ++host_.head; // begins to write
  host_.position = 2;
  host_.buttons[0] = 2;
  for (int i = 0; i < 3; ++i) scan();
  EXPECT_EQ(read<int>("POSITION"), 1);
  EXPECT_EQ(read<int>("BUTTONS"), 1);
  ASSERT_EQ(rung_instance_inconsistent(plc_->handle(), &host_, &inconsistent), RUNG_OK);
  EXPECT_EQ(inconsistent, 3u);
  host_.tail = host_.head;
  scan();
  EXPECT_EQ(read<int>("POSITION"), 2);
  EXPECT_EQ(read<int>("BUTTONS"), 2);
  ASSERT_EQ(rung_instance_inconsistent(plc_->handle(), &host_, &inconsistent), RUNG_OK);
  EXPECT_EQ(inconsistent, 0u);
  EXPECT_EQ(rung_instance_inconsistent(plc_->handle(), &inconsistent, &inconsistent), RUNG_NOT_FOUND);
}

// As the controller of a machine does, in a thread of its own.
void writeOften(NcBlock& block, const std::atomic<bool>& ends) {
  for (int32_t i = 1; !ends.load(std::memory_order_relaxed); ++i) {
    const uint32_t count = block.head + 1;
    __atomic_store_n(&block.head, count, __ATOMIC_RELAXED);
    __atomic_thread_fence(__ATOMIC_RELEASE);
    __atomic_store_n(&block.position, i, __ATOMIC_RELAXED);
    for (int wait = 0; wait < 20; ++wait) __atomic_signal_fence(__ATOMIC_SEQ_CST);
    __atomic_store_n(&block.copy, i, __ATOMIC_RELAXED);
    __atomic_store_n(&block.tail, count, __ATOMIC_RELEASE);
    for (int wait = 0; wait < 200; ++wait) __atomic_signal_fence(__ATOMIC_SEQ_CST);
  }
}

TEST_F(Structs, NoCopyIsTornWhileAnotherThreadWrites) {
  ASSERT_EQ(bind({row("POSITION", "position", offsetof(NcBlock, position), 4, RUNG_HOST_I32),
                  row("COPY", "copy", offsetof(NcBlock, copy), 4, RUNG_HOST_I32)},
                 true),
            RUNG_OK);
  std::atomic<bool> ends{false};
  std::thread writer([&] { writeOften(host_, ends); });
  int64_t last = 0;
  uint32_t different = 0;
  for (int i = 0; i < 20'000 || (different < 100 && i < 2'000'000); ++i) {
    scan();
    const int64_t now = read<int64_t>("POSITION");
    ASSERT_GE(now, last);
    if (now != last) ++different;
    last = now;
  }
  ends = true;
  writer.join();
  EXPECT_EQ(read<int>("TORN"), 0);
  EXPECT_GE(different, 100u);
}

TEST_F(Structs, AProgramForAnotherLayoutIsRefused) {
  const std::vector<rung_member> members = {row("POSITION", "position", offsetof(NcBlock, position), 4, RUNG_HOST_I32)};
  rung::test::TestProgram other;
  build(other);
  other.symbols.push_back({RUNG_LAYOUT_SYMBOL "NcBlock", "NcBlock: 48 bytes\nin position: i32 at 8 = POSITION\n",
                           RUNG_NONE, 0, 0, RUNG_TYPE_I64, 1, RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN, 8});
  other.link();
  const rung::Image next = adopted(other);
  rung::Instance instance(next);
  const rung_layout layout = layoutOf(members);
  const auto* said =
      "test was compiled for another layout of NcBlock than this host's: it has \"in position: i32 at 8 = "
      "POSITION\", the host \"in position: i32 at 4 = POSITION\"; run rungc bind again, and compile both";
  EXPECT_EQ(rung_instance_bind_struct(instance.handle(), &layout, &host_), RUNG_REFUSED);
  EXPECT_STREQ(rung_error_text(), said);
  // Nor may it replace one without such a claim.
  ASSERT_EQ(bind(members), RUNG_OK);
  rung_replacement* change = nullptr;
  EXPECT_EQ(rung_replacement_new(plc_->handle(), next.handle(), nullptr, 0, &change), RUNG_REFUSED);
  EXPECT_STREQ(rung_error_text(), said);
  rung_shadow* shadow = nullptr;
  EXPECT_EQ(rung_shadow_new(plc_->handle(), next.handle(), 10, 10, &shadow), RUNG_REFUSED);
  // With the same hash it is the right one.
  rung_layout same = layout;
  same.hash = 8;
  EXPECT_EQ(rung_instance_bind_struct(instance.handle(), &same, &host_), RUNG_OK);
}

const char* somethingMoved() { return "keys.start"; }

TEST_F(Structs, WhatCannotBeBound) {
  const auto wrong = [&](const rung_member& member, int32_t status, const char* text) {
    EXPECT_EQ(bind({member}), status);
    EXPECT_THAT(rung_error_text(), HasSubstr(text));
  };
  wrong(row("POSITION", "position", 68, 4, RUNG_HOST_I32), RUNG_BAD_ARGUMENT, "has a member beyond its end");
  wrong(row("POSITION", "position", 0xFFFFFFFC, 4, RUNG_HOST_I32), RUNG_BAD_ARGUMENT, "has a member beyond its end");
  wrong(row("POSITION", "position", 4, 2, RUNG_HOST_I32), RUNG_BAD_ARGUMENT, "whose type has another width");
  wrong(row("POSITION", "position", 4, 4, 11), RUNG_BAD_ARGUMENT, "no type or no direction");
  wrong(row(nullptr, "position", 4, 4, RUNG_HOST_I32), RUNG_BAD_ARGUMENT, "a member without a name");
  wrong(bits("BYTE", 8, 60, 5, RUNG_HOST_I64), RUNG_BAD_ARGUMENT, "more bits than its bytes");
  wrong(row("NOTHING", "position", 4, 4, RUNG_HOST_I32), RUNG_NOT_FOUND, "NOTHING is not a name");
  wrong(row("BUTTONS", "buttons", 4, 40, 0), RUNG_BAD_ARGUMENT, "there are not 40 bytes from BUTTONS on");
  const std::vector<rung_member> none;
  rung_layout layout = layoutOf(none);
  layout.moved = &somethingMoved;
  EXPECT_EQ(rung_instance_bind_struct(plc_->handle(), &layout, &host_), RUNG_REFUSED);
  EXPECT_THAT(rung_error_text(), HasSubstr("the bit-field keys.start of NcBlock lies elsewhere"));
  layout = layoutOf(none, true);
  layout.tail = 6;
  EXPECT_EQ(rung_instance_bind_struct(plc_->handle(), &layout, &host_), RUNG_BAD_ARGUMENT);
  EXPECT_THAT(rung_error_text(), HasSubstr("counters that are not aligned"));
  EXPECT_EQ(rung_instance_bind_struct(plc_->handle(), &layout, nullptr), RUNG_BAD_ARGUMENT);
  layout.size = 3;
  EXPECT_EQ(rung_instance_bind_struct(plc_->handle(), &layout, &host_), RUNG_BAD_ARGUMENT);
}

} // namespace
