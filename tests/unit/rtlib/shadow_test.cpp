// A program runs beside another one, on what that one reads and is answered.
#include "rtlib/change/shadow.h"

#include <gtest/gtest.h>

#include "rtlib/change/forcing.h"
#include "rtlib/run/instance.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung;
using namespace rung::runtime;
using test::TestProgram;

// X (0) is an input, Y (1) an output, TICKET (4..7) memory; SERVICE results come to Y.
uint32_t copyInput(uint8_t* mem, rung_ctx* ctx, uint32_t) { return mem[16] = mem[0], rung::test::popChunk(ctx); }
uint32_t addToInput(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  return mem[16] = static_cast<uint8_t>(mem[0] + (mem[0] > 4 ? 1 : 0)), rung::test::popChunk(ctx);
}
uint32_t count(uint8_t* mem, rung_ctx* ctx, uint32_t) { return mem[16] = ++mem[8], rung::test::popChunk(ctx); }
uint32_t countToThree(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  if (mem[8] == 3) return ctx->fault.code = 0, RUNG_PC_FAULT;
  return mem[16] = ++mem[8], rung::test::popChunk(ctx);
}
// Asks when nothing is under way, with X as argument, and shows the result.
template <uint32_t Service>
uint32_t ask(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  uint32_t ticket;
  std::memcpy(&ticket, mem + 4, sizeof ticket);
  if (ticket == 0) {
    const int64_t x = mem[0];
    ticket = ctx->host->service_request(ctx, Service, &x, 1);
  } else if (ctx->host->service_poll(ctx, ticket) == RUNG_SERVICE_DONE) {
    mem[16] = static_cast<uint8_t>(ctx->host->service_result(ctx, ticket, 0));
    ticket = 0;
  }
  std::memcpy(mem + 4, &ticket, sizeof ticket);
  return rung::test::popChunk(ctx);
}

std::string describe(const rung_program& program, const Ref& place) {
  return std::string(program.spaces[place.space].name) + std::to_string(place.byte) + "." + std::to_string(place.bit);
}

void build(TestProgram& program, rung_chunk_fn main) {
  program.addPacked("R", 1, 16, 0);
  program.addSpace("Y", 1, {{0, 4, 16, RUNG_REPR_PACKED}}, RUNG_SPACE_OUTPUT);
  program.addSymbol("COUNT", 0, 8, RUNG_TYPE_I8);
  program.addSymbol("OUT", 1, 0, RUNG_TYPE_I8);
  program.addSymbol("X", 0, 0, RUNG_TYPE_I8);
  program.addTask("MAIN", program.addChunk(main));
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_SLOT, RUNG_NONE, 0}, {RUNG_STEP_RUN, 0, 1}};
  EXPECT_EQ(checkProgram(program.link()), "");
}

// Answers at once what is asked for by an even number, and lets the shadow know of all.
struct Answering final : ScheduleHooks {
  bool respond(Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    if (shadow != nullptr) shadow->requested(request);
    if (request.args[0] % 2 != 0) return false;
    reply.resultCount = 1;
    reply.results[0] = request.args[0] + 100;
    return true;
  }
  Shadow* shadow = nullptr;
};

struct Pair {
  Pair(rung_chunk_fn live, rung_chunk_fn next, uint32_t scans = 100, uint32_t room = 8) {
    build(one, live);
    build(two, next);
    instance.emplace(one.program, &hooks);
    shadow.emplace(one.program, Runnable{two.program}, &describe, scans, room);
    hooks.shadow = &*shadow;
    EXPECT_EQ(shadow->problem(), "");
  }
  void scan(uint8_t x, bool works = true) {
    instance->memory().writeByte(0, 0, x);
    instance->scan();
    if (works)
      while (shadow->work()) {
      }
  }
  TestProgram one, two;
  Answering hooks;
  std::optional<Instance> instance;
  std::optional<Shadow> shadow;
};

TEST(Shadow, SeesWhatTheRunningProgramSees) {
  Pair pair(&copyInput, &copyInput);
  EXPECT_FALSE(pair.shadow->work()) << "not begun";
  EXPECT_EQ(pair.shadow->state(), ShadowState::Prepared);
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (uint8_t x = 0; x < 10; ++x) pair.scan(x);
  EXPECT_EQ(pair.shadow->runs(), 10u);
  EXPECT_EQ(pair.shadow->state(), ShadowState::Running);
  EXPECT_TRUE(pair.shadow->differences().empty());
}

TEST(Shadow, ReportsWhereItDoesOtherwise) {
  Pair pair(&copyInput, &addToInput);
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (uint8_t x = 0; x < 8; ++x) pair.scan(x);
  const std::vector<ShadowDifference> found = pair.shadow->differences();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "OUT");
  EXPECT_EQ(found[0].live, 5u);
  EXPECT_EQ(found[0].next, 6u);
  EXPECT_EQ(found[0].runs, 3u);
  EXPECT_EQ(found[0].firstUs, 48000);
  EXPECT_EQ(pair.instance->memory().readByte(1, 0), 7u) << "nothing of it gets out";
}

TEST(Shadow, KnowsWhatIsForced) {
  Pair pair(&copyInput, &addToInput);
  const ForcedCell out{.ref = intRef(1, 0, 8), .bits = 9};
  Forcing forcing(pair.one.program, nullptr, {&out, 1});
  ASSERT_EQ(forcing.problem(), "");
  const rung_chunk_fn heldMain[] = {[](uint8_t*, rung_ctx* ctx, uint32_t) { return rung::test::popChunk(ctx); }};
  forcing.setCode({heldMain, nullptr});
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  pair.scan(1);
  ASSERT_TRUE(pair.instance->force(forcing));
  for (uint8_t x = 2; x < 8; ++x) pair.scan(x);
  EXPECT_EQ(pair.instance->memory().readByte(1, 0), 9u);
  EXPECT_TRUE(pair.shadow->differences().empty()) << "the new program's output is forced, too";
  pair.instance->endForces();
  pair.scan(6);
  EXPECT_EQ(pair.shadow->differences().size(), 1u) << "no longer";
}

TEST(Shadow, ReportsOutputsWithoutAName) {
  Pair pair(&copyInput, [](uint8_t* mem, rung_ctx* ctx, uint32_t) -> uint32_t {
    return mem[16] = mem[0], mem[18] = 4, rung::test::popChunk(ctx);
  });
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  pair.scan(1);
  ASSERT_EQ(pair.shadow->differences().size(), 1u);
  EXPECT_EQ(pair.shadow->differences()[0].name, "Y2.2");
}

TEST(Shadow, BeginsWithTheStateOfTheMoment) {
  Pair pair(&count, &count);
  for (int i = 0; i < 5; ++i) pair.instance->scan();
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (int i = 0; i < 5; ++i) pair.scan(0);
  EXPECT_TRUE(pair.shadow->differences().empty());
  pair.instance->memory().writeByte(0, 8, 100); // by a host, between two scans
  pair.scan(0);
  EXPECT_TRUE(pair.shadow->differences().empty());
}

TEST(Shadow, EndsAfterItsPasses) {
  Pair pair(&count, &count, 3);
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (int i = 0; i < 5; ++i) pair.scan(0);
  EXPECT_EQ(pair.shadow->state(), ShadowState::Finished);
  EXPECT_EQ(pair.shadow->runs(), 3u);
  EXPECT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::OtherProgram) << "once";
}

TEST(Shadow, EndsWhereItHasNoRoom) {
  Pair pair(&count, &count, 100, 4);
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (int i = 0; i < 6; ++i) pair.scan(0, false);
  EXPECT_EQ(pair.shadow->state(), ShadowState::Running) << "there is something to do";
  while (pair.shadow->work()) {
  }
  EXPECT_EQ(pair.shadow->state(), ShadowState::TooSlow);
  EXPECT_EQ(pair.shadow->runs(), 4u);
  EXPECT_EQ(pair.instance->memory().readByte(0, 8), 6u);
}

TEST(Shadow, AFaultOfTheNewProgramIsReported) {
  Pair pair(&count, &countToThree);
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (int i = 0; i < 6; ++i) pair.scan(0);
  EXPECT_EQ(pair.shadow->state(), ShadowState::Faulted);
  EXPECT_NE(pair.shadow->faultText(), "");
  EXPECT_FALSE(pair.instance->faulted());
}

TEST(Shadow, AFaultOfTheRunningProgramEndsIt) {
  Pair pair(&countToThree, &count);
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (int i = 0; i < 6; ++i) pair.scan(0);
  EXPECT_EQ(pair.shadow->state(), ShadowState::Stopped);
  EXPECT_EQ(pair.shadow->runs(), 3u);
}

TEST(Shadow, GetsTheAnswersOfTheRunningProgram) {
  Pair pair(&ask<0>, &ask<0>);
  uint8_t x = 0;
  const auto answer = [&] { // what nobody has answered at once
    core::ServiceRequest request;
    while (pair.instance->services().take(request))
      (void)pair.instance->services().complete(
          {.ticket = request.ticket, .resultCount = 1, .results = {request.args[0] + 50}});
  };
  for (; x < 7; ++x) pair.instance->memory().writeByte(0, 0, x), pair.instance->scan(), answer(); // one is under way
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (; x < 40; ++x) {
    pair.scan(x);
    if (x % 3 == 0) answer();
  }
  for (const ShadowDifference& d : pair.shadow->differences())
    ADD_FAILURE() << d.name << " " << d.live << " " << d.next;
  EXPECT_EQ(pair.shadow->state(), ShadowState::Running);
}

TEST(Shadow, ARequestOfItsOwnIsReportedAndStaysUnanswered) {
  Pair pair(&ask<0>, &ask<1>);
  ASSERT_EQ(pair.shadow->begin(*pair.instance), ReplaceResult::Replaced);
  for (uint8_t x = 2; x < 8; x += 2) pair.scan(x);
  std::vector<std::string> names;
  for (const ShadowDifference& d : pair.shadow->differences()) names.push_back(d.name);
  EXPECT_EQ(names, (std::vector<std::string>{"OUT", "WINDW"}));
  EXPECT_EQ(pair.instance->services().pending(), 0u);
}

TEST(Shadow, NeedsTheSameSchedule) {
  TestProgram one, two, three;
  build(one, &count);
  build(two, &count);
  two.scan[0].arg = 4000;
  two.link();
  build(three, &count);
  three.tasks[0].name = "OTHER";
  three.link();
  for (const TestProgram* next : {&two, &three})
    EXPECT_NE(Shadow(one.program, {next->program}, &describe, 1, 1).problem(), "");
}

} // namespace
