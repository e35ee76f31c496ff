// One program takes over from another while it runs.
#include "rtlib/host/replacement.h"

#include <gtest/gtest.h>

#include "rtlib/host/instance.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung;
using namespace rung::host;
using test::TestProgram;

// COUNT and KEPT move by 16 bytes from one program to the other; SUM and DIFFERENCE belong to one of them.
constexpr uint32_t kMoved = 16;

uint32_t addOne(uint8_t* mem, rung_ctx* ctx, uint32_t) { return ++mem[0], ++mem[2], rung::test::popChunk(ctx); }
uint32_t addTwo(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  if (mem[kMoved] >= 200) return RUNG_PC_FAULT;
  return mem[kMoved] = static_cast<uint8_t>(mem[kMoved] + 2), --mem[kMoved + 3], rung::test::popChunk(ctx);
}
uint32_t ask(uint8_t*, rung_ctx* ctx, uint32_t) {
  ctx->host->service_request(ctx, 0, nullptr, 0);
  return rung::test::popChunk(ctx);
}

class ReplacementTest : public testing::Test {
protected:
  ReplacementTest() {
    build(one, 0, &addOne);
    one.addSymbol("SUM", 0, 2, RUNG_TYPE_I8);
    one.services = {"READ", "WRITE"};
    build(two, kMoved, &addTwo);
    two.addSymbol("DIFFERENCE", 0, kMoved + 3, RUNG_TYPE_I8);
    two.services = {"WRITE", "READ"};
    two.faults = {"other", "dead-loop"};
    two.tasks[0].budget_fault = 1;
    for (TestProgram* program : {&one, &two}) EXPECT_EQ(checkProgram(program->link()), "");
  }
  static void build(TestProgram& program, uint32_t byte, rung_chunk_fn main) {
    program.addPacked("R", 1, 64, 0);
    program.addSymbol("COUNT", 0, byte, RUNG_TYPE_I8);
    program.addSymbol("KEPT", 0, byte + 1, RUNG_TYPE_I8);
    program.addTask("MAIN", program.addChunk(main));
    program.addTask("ASK", program.addChunk(&ask));
    program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_SLOT, RUNG_NONE, 0}, {RUNG_STEP_RUN, 0, 1}};
  }
  static uint64_t read(const Instance& instance, const char* name) {
    return instance.read(refOf(*findSymbol(instance.program(), name)));
  }

  TestProgram one, two;
};

TEST_F(ReplacementTest, TheNewProgramContinuesWithTheState) {
  Instance instance(one.program);
  instance.scan();
  instance.scan();
  Replacement replacement(one.program, {two.program});
  EXPECT_EQ(replacement.transfer().changes().size(), 3u) << "COUNT and KEPT moved, SUM removed";
  EXPECT_EQ(instance.generation(), 0u);
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(instance.generation(), 1u);
  EXPECT_EQ(&instance.program(), &two.program);
  EXPECT_EQ(&replacement.next(), &one.program);
  EXPECT_EQ(read(instance, "COUNT"), 2u);
  EXPECT_EQ(instance.nowUs(), 16000);
  instance.scan();
  EXPECT_EQ(read(instance, "COUNT"), 4u);
  EXPECT_EQ(read(instance, "DIFFERENCE"), 255u);
  EXPECT_EQ(instance.nowUs(), 24000);
}

TEST_F(ReplacementTest, TheFormerProgramCanBePutBack) {
  Instance instance(one.program);
  instance.scan();
  Replacement replacement(one.program, {two.program});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  instance.scan();
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(&instance.program(), &one.program);
  EXPECT_EQ(read(instance, "COUNT"), 3u);
  EXPECT_EQ(read(instance, "SUM"), 1u) << "as it was when it was replaced";
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(read(instance, "DIFFERENCE"), 255u);
  EXPECT_EQ(instance.generation(), 3u);
}

TEST_F(ReplacementTest, NotWithinAPass) {
  Instance instance(one.program);
  Replacement replacement(one.program, {two.program});
  instance.slot();
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::WithinPass);
  EXPECT_EQ(&instance.program(), &one.program);
  instance.slot();
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
}

TEST_F(ReplacementTest, NotForAnotherProgram) {
  Instance instance(two.program);
  Replacement replacement(one.program, {two.program});
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::OtherProgram);
}

TEST_F(ReplacementTest, RequestsThatWaitKeepTheirMeaning) {
  Instance instance(one.program);
  Replacement replacement(one.program, {two.program});
  instance.runTask("ASK");
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::RequestsWait) << "its READ would be a WRITE";
  rt::ServiceRequest request;
  ASSERT_TRUE(instance.services().take(request));
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(instance.services().poll(request.ticket), uint32_t{RUNG_SERVICE_PENDING}) << "tickets continue";
}

TEST_F(ReplacementTest, AStoppedProgramStaysStopped) {
  Instance instance(two.program);
  EXPECT_EQ(instance.write(refOf(*findSymbol(two.program, "COUNT")), 200), std::nullopt);
  instance.scan();
  ASSERT_TRUE(instance.faulted());
  Replacement replacement(two.program, {one.program});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced) << "a pass that ended in a fault is over";
  EXPECT_TRUE(instance.faulted());
  instance.scan();
  EXPECT_EQ(read(instance, "COUNT"), 200u);
  instance.warmStart();
  instance.scan();
  EXPECT_EQ(read(instance, "COUNT"), 1u);
}

TEST_F(ReplacementTest, AFaultIsTheSameInTheOtherTables) {
  one.rungs[0].key = 77; // the new program has none with this key
  two.rungs[0].key = 5;
  Instance instance(one.program);
  ASSERT_TRUE(instance.halt("dead-loop"));
  Replacement replacement(one.program, {two.program});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_STREQ(two.program.faults[instance.fault().code], "dead-loop");
  EXPECT_EQ(instance.fault().rung, RUNG_NONE);
}

TEST_F(ReplacementTest, AMechanismThatWaitsElsewhereIsWaitedFor) {
  one.addContinuation("MECH.CONT", 8, {"beginning", "clamp", "turn"});
  two.addContinuation("MECH.CONT", 12, {"beginning", "turn"});
  one.link();
  two.link();
  Instance instance(one.program);
  Replacement replacement(one.program, {two.program});
  instance.block()[8] = 1;
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::MechanismWaits);
  instance.block()[8] = 2;
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(instance.block()[12], 1) << "it still turns";
}

class Hooks : public ScheduleHooks {
public:
  void onReplace(Instance& instance) override { programs.push_back(&instance.program()); }
  std::vector<const rung_program*> programs;
};

TEST_F(ReplacementTest, TheControlHears) {
  Hooks hooks;
  Instance instance(one.program, &hooks);
  Replacement replacement(one.program, {two.program});
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(hooks.programs, std::vector<const rung_program*>{&two.program});
}

} // namespace
