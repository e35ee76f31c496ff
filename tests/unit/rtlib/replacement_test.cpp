// One program takes over from another while it runs.
#include "rtlib/change/replacement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rtlib/run/instance.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung;
using namespace rung::runtime;
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
  EXPECT_EQ(read(instance, "SUM"), 1u) << "its address has had no name meanwhile";
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  EXPECT_EQ(read(instance, "DIFFERENCE"), 255u);
  EXPECT_EQ(instance.generation(), 3u);
}

TEST_F(ReplacementTest, TheFormerProgramCanContinueWithWhatItAloneHas) {
  Instance instance(one.program);
  instance.scan();
  Replacement replacement(one.program, {two.program});
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
  instance.scan();
  ASSERT_EQ(instance.replace(replacement, OwnContents::AsLeft), ReplaceResult::Replaced);
  EXPECT_EQ(read(instance, "COUNT"), 3u);
  EXPECT_EQ(read(instance, "SUM"), 1u);
}

TEST_F(ReplacementTest, NotWithinAPass) {
  Instance instance(one.program);
  Replacement replacement(one.program, {two.program});
  instance.slot();
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::WithinScan);
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
  core::ServiceRequest request;
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
  ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced) << "a scan that ended in a fault is over";
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

TEST_F(ReplacementTest, AfterAFaultNothingIsWaitedFor) {
  one.addContinuation("MECH.CONT", 8, {"beginning", "clamp", "turn"});
  two.addContinuation("MECH.CONT", 12, {"beginning", "turn"});
  one.link();
  two.link();
  Instance instance(one.program);
  instance.block()[8] = 1;
  ASSERT_TRUE(instance.halt("dead-loop"));
  Replacement replacement(one.program, {two.program});
  EXPECT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
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

// Two programs that keep most of their state in place: 512 bytes of memory, followed by slots.
class SharedBlockTest : public testing::Test {
protected:
  static constexpr uint32_t kMemory = 512;
  static void build(TestProgram& program, uint32_t memorySize) {
    program.memorySize = memorySize;
    program.addPacked("MEM", 1, kMemory, 0);
    program.addSymbol("STAYS", 0, 0, RUNG_TYPE_I8);
    program.addTask("MAIN", program.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return test::popChunk(ctx); }));
    program.scan = {{RUNG_STEP_RUN, 0, 1}};
  }
  // After `one` has become `two`, and back, and again: what stays, and what is of one program alone.
  void goesToAndFro(Instance& instance, Replacement& replacement) {
    uint8_t* block = instance.block().data();
    block[0] = 1;
    block[kMemory] = 11; // the slot of `one`
    ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
    block = instance.block().data();
    EXPECT_EQ(block[0], 1);
    EXPECT_EQ(block[kMemory], 0) << "a slot that is new";
    EXPECT_EQ(block[kMemory + 8], 11) << "the same one, elsewhere";
    block[0] = 2;
    block[kMemory] = 22;
    block[kMemory + 8] = 12;
    ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
    block = instance.block().data();
    EXPECT_EQ(block[0], 2);
    EXPECT_EQ(block[kMemory], 12);
    block[0] = 3;
    ASSERT_EQ(instance.replace(replacement), ReplaceResult::Replaced);
    block = instance.block().data();
    EXPECT_EQ(block[0], 3);
    EXPECT_EQ(block[kMemory], 0) << "new, as on the first way";
    EXPECT_EQ(block[kMemory + 8], 12);
  }
  void link(uint32_t sizeOfTwo) {
    build(one, kMemory + 16);
    one.addSlot("EDGE", kMemory, RUNG_TYPE_I32);
    build(two, sizeOfTwo);
    two.addSlot("ANOTHER", kMemory, RUNG_TYPE_I32);
    two.addSlot("EDGE", kMemory + 8, RUNG_TYPE_I32);
    for (TestProgram* program : {&one, &two}) ASSERT_EQ(checkProgram(program->link()), "");
  }

  TestProgram one, two;
};

TEST_F(SharedBlockTest, TheNextProgramTakesTheBlockOver) {
  link(kMemory + 16);
  Instance instance(one.program);
  Replacement replacement(one.program, {two.program});
  const uint8_t* block = instance.block().data();
  goesToAndFro(instance, replacement);
  EXPECT_EQ(instance.block().data(), block);
  EXPECT_LT(replacement.bytes(), kMemory / 2);
}

TEST_F(SharedBlockTest, AProgramThatHasGrownTooMuchHasABlockOfItsOwn) {
  link(kMemory + 88); // the block has room for an eighth more
  Instance instance(one.program);
  Replacement replacement(one.program, {two.program});
  const uint8_t* block = instance.block().data();
  goesToAndFro(instance, replacement);
  EXPECT_NE(instance.block().data(), block);
  EXPECT_LT(replacement.bytes(), kMemory) << "a shared block was planned";
}

TEST_F(SharedBlockTest, TheBlockOfAHostStaysInUse) {
  link(kMemory + 16);
  alignas(64) uint8_t memory[kMemory + 16] = {};
  Instance instance(Runnable{one.program, nullptr, memory});
  Replacement replacement(one.program, {two.program});
  goesToAndFro(instance, replacement);
  EXPECT_EQ(instance.block().data(), memory);
  EXPECT_EQ(memory[0], 3);
}

TEST_F(SharedBlockTest, ABlockThatTheNextProgramCannotUseIsLeft) {
  link(kMemory + 16);
  two.program.memory_align = 64;
  alignas(64) uint8_t memory[kMemory + 24] = {};
  Instance instance(Runnable{one.program, nullptr, memory + 8});
  Replacement replacement(one.program, {two.program});
  goesToAndFro(instance, replacement);
  EXPECT_NE(instance.block().data(), memory + 8);
}

// Programs with the same spaces, and names and slots at random.
void buildAtRandom(TestProgram& program, std::mt19937& random) {
  const auto below = [&](uint32_t limit) { return static_cast<uint32_t>(random() % limit); };
  constexpr uint32_t kTypes[] = {RUNG_TYPE_I8, RUNG_TYPE_I16, RUNG_TYPE_I32};
  constexpr const char* kNames[] = {"N0", "N1", "N2", "N3", "N4", "N5", "N6", "N7"};
  constexpr const char* kKeys[] = {"S0", "S1", "S2", "S3", "S4", "S5", "S6", "S7"};
  program.memorySize = 4600 + below(200);
  program.addPacked("MEM", 1, 4096, 0);
  program.addPacked("MINE", 1, 64, 4096);
  program.spaces.back().flags = RUNG_SPACE_ALLOCATED;
  program.addSpace("BITS", 1, {{0, 16, 4160, below(2) == 0 ? RUNG_REPR_PACKED : RUNG_REPR_BYTE_PER_BIT}});
  for (uint32_t i = 0; i < 8; ++i) {
    if (below(3) != 0) program.addSymbol(kNames[i], below(2), 4 * below(16), kTypes[below(3)]);
    if (below(3) != 0) program.addSlot(kKeys[i], 4288 + 4 * (i + 8 * below(2)), RUNG_TYPE_I32);
  }
  program.addTask("MAIN", program.addChunk([](uint8_t*, rung_ctx* ctx, uint32_t) { return test::popChunk(ctx); }));
  program.scan = {{RUNG_STEP_RUN, 0, 1}};
}

TEST(SharedBlock, HasWhatTwoBlocksWouldHave) {
  uint32_t shared = 0;
  constexpr uint32_t kPairs = 500;
  for (uint32_t seed = 0; seed < kPairs; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    TestProgram one, two;
    for (TestProgram* program : {&one, &two}) {
      buildAtRandom(*program, random);
      ASSERT_EQ(checkProgram(program->link()), "");
    }
    Instance inOne(one.program), inTwo(one.program);
    alignas(64) uint8_t memory[8192]; // a program in a host's memory does not share another block
    Replacement sharing(one.program, {two.program}), copying(one.program, {two.program, nullptr, memory});
    const uint8_t* block = inOne.block().data();
    for (int change = 0; change < 4; ++change) {
      for (uint8_t& byte : inOne.block()) byte = random() % 2;
      std::ranges::copy(inOne.block(), inTwo.block().begin());
      ASSERT_EQ(inOne.replace(sharing), ReplaceResult::Replaced);
      ASSERT_EQ(inTwo.replace(copying), ReplaceResult::Replaced);
      ASSERT_TRUE(std::ranges::equal(inOne.block(), inTwo.block())) << "change " << change;
    }
    shared += inOne.block().data() == block && sharing.bytes() < copying.bytes() ? 1 : 0;
  }
  EXPECT_GT(shared, kPairs / 2) << "otherwise little is tested here";
}

} // namespace
