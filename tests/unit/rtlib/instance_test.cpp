// An instance as the scenario runner and the controls use it.
#include "rtlib/run/instance.h"

#include <gtest/gtest.h>

#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using namespace rung::core;
using rung::test::TestProgram;

// Space R: byte 0 counts scans, byte 1 is retained, byte 2 has an initial value, byte 3 is an output.
class InstanceTest : public testing::Test {
protected:
  InstanceTest() {
    test.addPacked("R", 1, 64, 0);
    test.addSymbol("COUNT", 0, 0, RUNG_TYPE_I8);
    test.addSymbol("KEPT", 0, 1, RUNG_TYPE_I8);
    static const uint8_t kInit = 17;
    test.inits = {{2, 1, &kInit}};
    test.retains = {{1, 1}, {40, 2}};
    test.safeSpans = {{3, 1}};
    test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) {
      ++mem[0];
      mem[3] = 1;
      if (mem[0] < 100) return RUNG_PC_DONE;
      ctx->fault = {1, 0, 12, RUNG_NONE};
      return RUNG_PC_FAULT;
    });
    test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) { // asks once, takes what comes
      int64_t arg = 5;
      if (mem[8] == 0) mem[8] = static_cast<uint8_t>(ctx->host->service_request(ctx, 1, &arg, 1));
      mem[9] = static_cast<uint8_t>(ctx->host->service_poll(ctx, mem[8]));
      mem[10] = static_cast<uint8_t>(ctx->host->service_result(ctx, mem[8], 0));
      return RUNG_PC_DONE;
    });
    test.addTask("MAIN", 0);
    test.addTask("ASK", 1);
    test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_HOOK, RUNG_NONE, 3}, {RUNG_STEP_RUN, 0, 1}};
    test.link();
  }
  uint64_t byte(const Instance& instance, uint32_t number) { return instance.read(intRef(0, number, 8)); }
  TestProgram test;
};

TEST_F(InstanceTest, StartsColdAndScans) {
  Instance instance(test.program);
  EXPECT_EQ(byte(instance, 2), 17u);
  instance.scan();
  instance.scan();
  EXPECT_EQ(instance.read(refOf(*findSymbol(test.program, "COUNT"))), 2u);
  EXPECT_EQ(instance.nowUs(), 16000);
}

TEST_F(InstanceTest, ColdStartForgetsWarmStartKeeps) {
  Instance instance(test.program);
  for (const bool warm : {false, true}) {
    for (uint32_t i : {0u, 1u, 2u, 40u, 41u}) EXPECT_EQ(instance.write(intRef(0, i, 8), 50 + i), std::nullopt);
    instance.runTask("ASK");
    EXPECT_EQ(instance.services().waiting(), 1u);
    instance.messages().push({});
    warm ? instance.warmStart() : instance.coldStart();
    EXPECT_EQ(byte(instance, 0), 0u);
    EXPECT_EQ(byte(instance, 1), warm ? 51u : 0u);
    EXPECT_EQ(byte(instance, 2), 17u);
    EXPECT_EQ(byte(instance, 40), warm ? 90u : 0u);
    EXPECT_EQ(byte(instance, 41), warm ? 91u : 0u);
    EXPECT_EQ(instance.services().waiting(), 0u);
    EXPECT_EQ(instance.services().pending(), 0u);
    EXPECT_EQ(instance.messages().size(), 0u);
  }
}

TEST_F(InstanceTest, RetainedMemoryGoesOutAndIn) {
  Instance first(test.program);
  EXPECT_EQ(first.write(intRef(0, 1, 8), 7), std::nullopt);
  EXPECT_EQ(first.write(intRef(0, 40, 16), 0x1234), std::nullopt);
  std::vector<uint8_t> image(first.retainedSize());
  ASSERT_EQ(image.size(), 3u);
  first.copyRetained(image);
  Instance second(test.program);
  EXPECT_TRUE(second.restoreRetained(image));
  EXPECT_EQ(byte(second, 1), 7u);
  EXPECT_EQ(second.read(intRef(0, 40, 16)), 0x1234u);
  image.push_back(0);
  EXPECT_FALSE(second.restoreRetained(image));
}

TEST_F(InstanceTest, RunForAdvancesAtLeastThatMuch) {
  Instance instance(test.program);
  instance.runFor(20000);
  EXPECT_EQ(instance.nowUs(), 24000);
  EXPECT_EQ(byte(instance, 0), 3u);
  instance.runFor(0);
  EXPECT_EQ(byte(instance, 0), 3u);
}

TEST_F(InstanceTest, RunForEndsWithAFaultOrWithoutTime) {
  Instance instance(test.program);
  instance.runFor(10'000'000);
  EXPECT_TRUE(instance.faulted());
  EXPECT_EQ(byte(instance, 0), 100u);
  EXPECT_EQ(byte(instance, 3), 0u); // safe
  EXPECT_EQ(instance.faultText(), "division by zero (rung 1, main.pmc:12)");
  instance.scan();
  EXPECT_EQ(byte(instance, 0), 100u);
  instance.coldStart();
  EXPECT_FALSE(instance.faulted());
  EXPECT_EQ(instance.faultText(), "");

  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 0}, {RUNG_STEP_RUN, 0, 1}};
  test.link();
  Instance timeless(test.program);
  timeless.runFor(1000);
  EXPECT_EQ(byte(timeless, 0), 1u);
}

TEST_F(InstanceTest, TasksByNameAndNumber) {
  Instance instance(test.program);
  EXPECT_TRUE(instance.runTask("MAIN"));
  EXPECT_TRUE(instance.runTask(0));
  EXPECT_FALSE(instance.runTask("NONE"));
  EXPECT_FALSE(instance.runTask(9));
  EXPECT_EQ(byte(instance, 0), 2u);
  EXPECT_EQ(instance.nowUs(), 0);
}

class Model : public ScheduleHooks {
public:
  void onHook(Instance& instance, uint32_t work) override {
    lastWork = work;
    instance.runTask("ASK");
  }
  void onFault(Instance& instance) override {
    faultSeen = instance.faultText();
    EXPECT_TRUE(instance.runTask("ASK"));
  }
  bool respond(Instance&, const ServiceRequest& request, ServiceReply& reply) override {
    if (!answers) return false;
    reply.resultCount = 1;
    reply.results[0] = request.args[0] + 1;
    return true;
  }
  uint32_t lastWork = 0;
  std::string faultSeen;
  bool answers = false;
};

TEST_F(InstanceTest, HooksTakePartInTheSchedule) {
  Model model;
  Instance instance(test.program, &model);
  instance.scan();
  EXPECT_EQ(model.lastWork, 3u);
  EXPECT_EQ(byte(instance, 9), static_cast<uint64_t>(RUNG_SERVICE_PENDING));
  instance.runFor(10'000'000);
  EXPECT_EQ(model.faultSeen, "division by zero (rung 1, main.pmc:12)");
}

TEST_F(InstanceTest, RepliesAreSeenInTheNextScan) {
  Model model;
  Instance instance(test.program, &model);
  instance.scan();
  ServiceRequest request;
  ASSERT_TRUE(instance.services().take(request));
  EXPECT_EQ(serviceName(test.program, request.service), "WINDW");
  ServiceReply reply;
  reply.ticket = request.ticket;
  reply.resultCount = 1;
  reply.results[0] = 99;
  instance.services().complete(reply);
  EXPECT_EQ(byte(instance, 10), 0u);
  instance.scan();
  EXPECT_EQ(byte(instance, 9), static_cast<uint64_t>(RUNG_SERVICE_DONE));
  EXPECT_EQ(byte(instance, 10), 99u);
}

TEST_F(InstanceTest, ResponderAnswersWithinTheScan) {
  Model model;
  model.answers = true;
  Instance instance(test.program, &model);
  instance.scan();
  EXPECT_EQ(byte(instance, 10), 6u);
  EXPECT_EQ(instance.services().waiting(), 0u);
}

TEST_F(InstanceTest, InstancesOfOneProgramDoNotMeet) {
  Instance a(test.program);
  Instance b(test.program);
  a.scan();
  EXPECT_EQ(byte(a, 0), 1u);
  EXPECT_EQ(byte(b, 0), 0u);
}

TEST_F(InstanceTest, AWatchSeesEveryRunOfATask) {
  struct Watch final : TaskWatch {
    void begins(const Instance&, uint32_t task) override { seen += fmt(task, '+'); }
    void ended(const Instance&, uint32_t task) override { seen += fmt(task, '-'); }
    static std::string fmt(uint32_t task, char what) { return what + std::to_string(task); }
    std::string seen;
  } watch;
  Instance instance(test.program);
  instance.scan(); // nobody looks
  instance.setTaskWatch(&watch);
  instance.scan();
  const std::string once = watch.seen;
  EXPECT_EQ(once.substr(0, 4), "+0-0");
  instance.runTask(0);
  EXPECT_EQ(watch.seen, once + "+0-0");
  instance.setTaskWatch(nullptr);
  instance.scan();
  EXPECT_EQ(watch.seen, once + "+0-0");
}

TEST_F(InstanceTest, MemoryIsAlignedAndCountersExistWhenInstrumented) {
  test.program.memory_align = 256;
  test.program.instrumented = 1;
  Instance instance(test.program);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(instance.block().data()) % 256, 0u);
  ASSERT_EQ(instance.profile().size(), 2u);
  EXPECT_EQ(instance.context().prof, instance.profile().data());
  instance.context().prof[1].count = 4;
  instance.coldStart(); // a profile spans restarts
  EXPECT_EQ(instance.profile()[1].count, 4u);
  instance.clearProfile();
  EXPECT_EQ(instance.profile()[1].count, 0u);
  test.program.instrumented = 0;
  EXPECT_EQ(Instance(test.program).context().prof, nullptr);
}

} // namespace
