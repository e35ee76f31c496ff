// Forced cells through the API: of a hand-made program, whose "compiler" is hand-made, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "tests/unit/runtime/test_image.h"

namespace {

using rung::test::adopted;
using rung::test::popChunk;
using rung::test::TestProgram;

using testing::HasSubstr;

// DOOR is latched to offset 16 and from there goes to SEEN; COUNT is written by the program, which faults at 100.
constexpr uint32_t kInput = 8, kLatched = 16, kSeen = 24, kCount = 25, kLamp = 32;

uint32_t work(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  mem[kSeen] = mem[kLatched];
  mem[kLamp] = mem[kLatched];
  if (++mem[kCount] == 100) {
    ctx->fault = {1, 0, 10, 0};
    return RUNG_PC_FAULT;
  }
  return popChunk(ctx);
}

// The same with COUNT forced, as a compiler makes it: `engine` is what it is forced to be.
uint32_t forcedWork(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  mem[kSeen] = mem[kLatched];
  mem[kLamp] = mem[kLatched];
  mem[kCount] = *static_cast<const uint8_t*>(ctx->engine);
  return popChunk(ctx);
}

void build(TestProgram& program) {
  program.addPacked("R", 1, 8, 0);
  program.addPacked("INPUT", 1, 8, kInput);
  program.addPacked("IN", 1, 8, kLatched);
  program.addPacked("W", 1, 8, kSeen);
  program.addPacked("OUT", 1, 8, kLamp);
  program.addSymbol("SPEED", 0, 0, RUNG_TYPE_F64);
  program.addSymbol("DOOR", 1, 0, RUNG_TYPE_BIT, 3);
  program.addSymbol("GUARD", 1, 0, RUNG_TYPE_BIT, 4);
  program.addSymbol("PORT", 1, 0, RUNG_TYPE_I8);
  program.addSymbol("LATCHED", 2, 0, RUNG_TYPE_BIT, 3);
  program.addSymbol("SEEN", 3, 0, RUNG_TYPE_I8);
  program.addSymbol("COUNT", 3, kCount - kSeen, RUNG_TYPE_I8);
  program.addSymbol("LAMP", 4, 0, RUNG_TYPE_I8);
  program.addSymbol("NOTE", 0, 0, RUNG_TYPE_TEXT, 0, 8);
  program.addConstant("LIMIT", 5);
  program.safeSpans = {{kLamp, 8}};
  program.writes = {{kSeen, 2, 255}, {kLamp, 1, 255}};
  program.addTask("MAIN", program.addChunk(&work));
  program.addBeginCopy(0, {RUNG_COPY_ALL, kInput, kLatched, 0, 8});
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_ADVANCE, RUNG_NONE, 4000}, {RUNG_STEP_RUN, 0, 1}};
  program.link();
}

struct Program : TestProgram {
  Program() { build(*this); }
};

struct Maker {
  int alive = 0;
  int32_t answer = RUNG_OK;
};

const rung_chunk_fn kForcedChunks[] = {&forcedWork};

int32_t makeCode(void* user, const rung_image* image, void*, const rung_forced_byte* forced, uint32_t count,
                 rung_forced_code* code, char* problem, size_t bytes) {
  auto& maker = *static_cast<Maker*>(user);
  if (maker.answer != RUNG_OK) {
    snprintf(problem, bytes, maker.answer == RUNG_LATER ? "this compiler is at work" : "this compiler is out of order");
    return maker.answer;
  }
  EXPECT_NE(rung_image_program(image), nullptr);
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(forced[0].space, 3u);
  EXPECT_EQ(forced[0].mask, 255u);
  static std::array<uint8_t, 8> values; // one set at a time, in these tests
  values[0] = static_cast<uint8_t>(forced[0].value);
  ++maker.alive;
  *code = {.chunk_fns = kForcedChunks,
           .engine = values.data(),
           .release = [](void* owner) { --static_cast<Maker*>(owner)->alive; },
           .owner = user};
  return RUNG_OK;
}

class Forcing : public testing::Test {
protected:
  Forcing() : image_(adopted(program_)), plc_(image_) { plc_.powerOn(); }

  void serve() {
    const rung_code_maker maker{.size = sizeof maker, .force = &makeCode, .user = &maker_};
    ASSERT_EQ(rung_image_serve(image_.handle(), &maker), RUNG_OK) << rung_error_text();
  }
  static rung_forced_cell cell(const char* name, int64_t value, const char* owner = nullptr) {
    return {name, owner, {.integer = value}};
  }
  rung::Forces forces(const std::vector<rung_forced_cell>& cells) { return rung::Forces(plc_, cells); }
  int32_t put(const rung::Forces& forces) { return plc_.force(forces); }
  int64_t value(const char* name) { return plc_.read<int64_t>(plc_.find(name)); }
  int32_t failing(const std::vector<rung_forced_cell>& cells) {
    rung_forces* none = nullptr;
    return rung_forces_new(plc_.handle(), nullptr, cells.data(), static_cast<uint32_t>(cells.size()), &none);
  }

  Maker maker_;
  Program program_;
  rung::Image image_;
  rung::Instance plc_;
};

TEST_F(Forcing, AnInputAtItsLatch) {
  const rung_cell door = plc_.find("DOOR", rung::Access::Write);
  {
    const rung::Forces open = forces({cell("DOOR", 1, "me")});
    EXPECT_TRUE(plc_.forced().empty()) << "prepared, not in effect";
    ASSERT_EQ(put(open), RUNG_OK);
    EXPECT_EQ(value("DOOR"), 1);
    EXPECT_EQ(value("LATCHED"), 1) << "before it is copied";
    plc_.write(door, 0);
    EXPECT_EQ(value("DOOR"), 1) << "for every reader";
    plc_.scan();
    EXPECT_EQ(value("SEEN"), 8);
    EXPECT_EQ(value("LATCHED"), 1) << "wherever it is copied to";
    const std::vector<rung_force_info> all = plc_.forced();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_STREQ(all[0].name, "DOOR");
    EXPECT_STREQ(all[0].owner, "me");
    EXPECT_EQ(all[0].type, uint32_t{RUNG_TYPE_BIT});
    EXPECT_EQ(all[0].value.integer, 1);
    EXPECT_EQ(all[0].since_us, 0);
  } // a set that is in effect ends with its handle
  EXPECT_TRUE(plc_.forced().empty());
  plc_.write(door, 0);
  plc_.scan();
  EXPECT_EQ(value("SEEN"), 0);
}

TEST_F(Forcing, AnotherSetTakesItsPlaceAndTimesLast) {
  const rung::Forces one = forces({cell("DOOR", 1), cell("GUARD", 1)});
  const rung::Forces two = forces({cell("GUARD", 0), cell("DOOR", 1)});
  ASSERT_EQ(put(one), RUNG_OK);
  plc_.scan();
  EXPECT_EQ(value("SEEN"), 0x18);
  ASSERT_EQ(put(two), RUNG_OK);
  plc_.scan();
  EXPECT_EQ(value("SEEN"), 0x08);
  const std::vector<rung_force_info> all = plc_.forced();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_STREQ(all[0].name, "DOOR");
  EXPECT_EQ(all[0].since_us, 0);
  EXPECT_EQ(all[1].since_us, 8000);
  ASSERT_EQ(plc_.endForces(), RUNG_OK);
  EXPECT_TRUE(plc_.forced().empty());
  ASSERT_EQ(put(one), RUNG_OK) << "a set serves as often as one likes";
}

TEST_F(Forcing, TheValueIsThatOfTheCell) {
  const rung::Forces even = forces({cell("DOOR", 74)});
  ASSERT_EQ(put(even), RUNG_OK);
  EXPECT_EQ(value("DOOR"), 0);
  EXPECT_EQ(plc_.forced()[0].value.integer, 0);
  plc_.scan();
  const rung::Forces zero = forces({cell("DOOR", 0)});
  ASSERT_EQ(put(zero), RUNG_OK);
  EXPECT_EQ(plc_.forced()[0].since_us, 0) << "it is forced to the same as before";
}

TEST_F(Forcing, WhatTheProgramWritesNeedsACompiler) {
  EXPECT_EQ(failing({cell("COUNT", 7)}), RUNG_REFUSED);
  EXPECT_THAT(rung_error_text(), HasSubstr("rung_compiler_serve"));
  serve();
  maker_.answer = RUNG_FAILED;
  EXPECT_EQ(failing({cell("COUNT", 7)}), RUNG_FAILED);
  EXPECT_STREQ(rung_error_text(), "this compiler is out of order");
  maker_.answer = RUNG_OK;
  {
    const rung::Forces count = forces({cell("COUNT", 7)});
    plc_.scan();
    EXPECT_EQ(value("COUNT"), 1);
    ASSERT_EQ(put(count), RUNG_OK);
    EXPECT_EQ(value("COUNT"), 7);
    plc_.scan();
    EXPECT_EQ(value("COUNT"), 7);
    EXPECT_EQ(maker_.alive, 1);
  }
  EXPECT_EQ(maker_.alive, 0);
  plc_.scan();
  EXPECT_EQ(value("COUNT"), 8) << "it goes on from where it was";
}

TEST_F(Forcing, EndsAtAFault) {
  const rung::Forces lit = forces({cell("DOOR", 1)});
  plc_.scan();
  ASSERT_EQ(put(lit), RUNG_OK);
  while (!plc_.fault()) plc_.scan();
  EXPECT_TRUE(plc_.forced().empty());
  EXPECT_EQ(value("LAMP"), 0) << "safe outputs win";
  EXPECT_EQ(put(lit), RUNG_FAULTED);
  EXPECT_TRUE(plc_.forced().empty());
}

TEST_F(Forcing, EndsAtAStopAndAPowerOn) {
  const rung::Forces open = forces({cell("DOOR", 1)});
  ASSERT_EQ(put(open), RUNG_OK);
  ASSERT_EQ(plc_.stop(), RUNG_OK);
  EXPECT_TRUE(plc_.forced().empty());
  EXPECT_EQ(put(open), RUNG_WRONG_STATE);
  EXPECT_THAT(rung_error_text(), HasSubstr("stopped"));
  ASSERT_EQ(plc_.start(), RUNG_OK);
  ASSERT_EQ(put(open), RUNG_OK);
  plc_.powerOn();
  EXPECT_TRUE(plc_.forced().empty());
  plc_.scan();
  EXPECT_EQ(value("SEEN"), 0);
  plc_.powerOff();
  EXPECT_EQ(put(open), RUNG_WRONG_STATE) << "off";
}

TEST_F(Forcing, EndsWhenAnotherProgramTakesOver) {
  const Program next;
  const rung::Image nextImage = adopted(next);
  rung::Replacement change(plc_, nextImage);
  const rung::Forces now = forces({cell("DOOR", 1)});
  const std::vector<rung_forced_cell> cells = {cell("DOOR", 1)};
  const rung::Forces later(plc_, cells, &change);
  EXPECT_EQ(put(later), RUNG_WRONG_STATE) << "of a program that does not run yet";
  ASSERT_EQ(put(now), RUNG_OK);
  plc_.scan();
  ASSERT_EQ(plc_.replace(change), RUNG_OK);
  EXPECT_TRUE(plc_.forced().empty());
  EXPECT_EQ(put(now), RUNG_WRONG_STATE);
  ASSERT_EQ(put(later), RUNG_OK) << "kept, without a scan between";
  plc_.scan();
  EXPECT_EQ(value("SEEN"), 8);
}

// The scan thread faults now and then, and is switched on again.
TEST_F(Forcing, SetsArePreparedBesideTheScan) {
  std::atomic<rung_forces*> handedOver{nullptr};
  std::atomic<bool> stop{false};
  uint32_t put = 0, held = 0;
  std::thread scanning([&] {
    while (!stop) {
      if (rung_forces* next = handedOver.exchange(nullptr); next != nullptr)
        put += rung_instance_force(plc_.handle(), next) == RUNG_OK ? 1 : 0;
      if (plc_.scan() == RUNG_FAULTED) plc_.powerOn(rung::Power::Cold);
      held += plc_.forced().empty() ? 0 : 1;
    }
  });
  std::vector<rung::Forces> sets;
  for (int i = 0; i < 300; ++i) {
    sets.push_back(forces({cell("DOOR", i % 2), cell("GUARD", 1)}));
    while (handedOver.load() != nullptr) std::this_thread::yield();
    handedOver = sets.back().handle();
  }
  while (handedOver.load() != nullptr) std::this_thread::yield();
  stop = true;
  scanning.join();
  EXPECT_EQ(put, 300u);
  EXPECT_GT(held, 0u);
}

TEST_F(Forcing, BadArguments) {
  EXPECT_EQ(failing({}), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(failing({cell(nullptr, 1)}), RUNG_BAD_ARGUMENT);
  EXPECT_EQ(failing({cell("NOBODY", 1)}), RUNG_NOT_FOUND);
  EXPECT_THAT(rung_error_text(), HasSubstr("NOBODY"));
  EXPECT_EQ(failing({cell("NOTE", 1)}), RUNG_WRONG_TYPE);
  EXPECT_EQ(failing({cell("LIMIT", 1)}), RUNG_WRONG_TYPE);
  EXPECT_EQ(failing({cell("DOOR", 1), cell("PORT", 0)}), RUNG_BAD_ARGUMENT);
  EXPECT_THAT(rung_error_text(), HasSubstr("different values in one place: DOOR and PORT"));
  rung::Instance other(image_);
  const rung::Forces open = forces({cell("DOOR", 1), cell("PORT", 8)});
  EXPECT_EQ(other.force(open), RUNG_WRONG_STATE) << "off";
  rung_code_maker maker{.size = sizeof maker};
  EXPECT_EQ(rung_image_serve(image_.handle(), &maker), RUNG_BAD_ARGUMENT);
  serve();
  maker.force = &makeCode;
  EXPECT_EQ(rung_image_serve(image_.handle(), &maker), RUNG_WRONG_STATE);
  std::array<char, 4> bytes{};
  size_t count = bytes.size();
  EXPECT_EQ(rung_image_file(image_.handle(), 0, bytes.data(), &count), RUNG_EMPTY);
}

TEST_F(Forcing, ACompilerThatNeedsTime) {
  serve();
  maker_.answer = RUNG_LATER;
  EXPECT_EQ(failing({cell("COUNT", 9)}), RUNG_LATER);
  EXPECT_STREQ(rung_error_text(), "this compiler is at work");
  EXPECT_THROW(forces({cell("COUNT", 9)}), rung::Error);
  EXPECT_TRUE(plc_.forced().empty());
  maker_.answer = RUNG_OK;
  const rung::Forces made = forces({cell("COUNT", 9)});
  ASSERT_EQ(put(made), RUNG_OK);
  plc_.scan();
  EXPECT_EQ(value("COUNT"), 9);
}

TEST_F(Forcing, AReal) {
  const rung_forced_cell speed{"SPEED", nullptr, {.real = 2.5}};
  const rung::Forces fast = forces({speed});
  ASSERT_EQ(put(fast), RUNG_OK);
  plc_.write(plc_.find("SPEED", rung::Access::Write), 7.0);
  EXPECT_EQ(plc_.read<double>(plc_.find("SPEED")), 2.5);
}

} // namespace
