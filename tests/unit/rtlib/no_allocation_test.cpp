// Starting, scanning and running tasks allocate nothing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "rtlib/host/instance.h"
#include "rtlib/host/retained_memory.h"
#include "rtlib/profile/collector.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::host;
using namespace rung::rt;
using rung::test::TestProgram;

class Model : public ScheduleHooks {
  void onHook(Instance& instance, uint32_t) override { instance.runTask(1); }
  bool respond(Instance&, const ServiceRequest& request, ServiceReply&) override { return request.service == 0; }
};

// A program that uses all there is: copies, parts, messages, services of both kinds, and in the end a fault.
void build(TestProgram& test) {
  test.addPacked("R", 1, 64, 0);
  test.addChunk([](uint8_t* mem, rung_ctx* ctx) {
    rung_message message{};
    ctx->host->message(ctx, &message);
    int64_t arg = 0;
    ctx->host->service_poll(ctx, ctx->host->service_request(ctx, mem[0] & 1u, &arg, 1));
    return ++mem[0] == 200 ? RUNG_PC_FAULT : 1u;
  });
  test.addChunk([](uint8_t*, rung_ctx*) { return RUNG_PC_DONE; });
  const uint32_t main = test.addTask("MAIN", 0, 1000, {1, RUNG_PC_DONE});
  test.addTask("EXTRA", 1);
  test.addBeginCopy(main, {RUNG_COPY_ALL, 8, 16, 0, 4});
  test.addEndCopy(main, {RUNG_COPY_MASKED, 8, 16, 24, 4});
  test.retains = {{4, 4}};
  test.safeSpans = {{0, 2}};
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000},
               {RUNG_STEP_HOOK, RUNG_NONE, 1},
               {RUNG_STEP_PART, main, 0},
               {RUNG_STEP_SLOT, RUNG_NONE, 0},
               {RUNG_STEP_PART, main, 0}};
  test.fast = {{RUNG_STEP_RUN, 1, 2}};
  test.link();
}

TEST(NoAllocation, CounterCounts) {
  void* volatile kept = nullptr; // else the compiler leaves allocation and release out
  EXPECT_EQ(allocationsOf([&] {
              kept = std::malloc(10);
              std::free(kept);
            }),
            1);
  EXPECT_EQ(allocationsOf([&] {
              kept = ::operator new(10);
              ::operator delete(kept);
            }),
            1);
}

TEST(NoAllocation, NeitherStartNorScan) {
  TestProgram test;
  build(test);
  Model model;
  Instance instance(test.program, &model);
  const int count = allocationsOf([&] {
    for (int i = 0; i < 150; ++i) {
      instance.scan();
      instance.slot();
      instance.fast();
      instance.slice();
      ServiceRequest request;
      ServiceReply reply;
      if (instance.services().take(request)) {
        reply.ticket = request.ticket;
        instance.services().complete(reply);
      }
    }
    instance.warmStart();
    instance.coldStart();
    instance.runFor(100'000'000); // ends in the fault
  });
  EXPECT_EQ(count, 0);
  EXPECT_TRUE(instance.faulted());
  EXPECT_GT(instance.messages().lost() + instance.services().refused(), 0u); // overflow allocates nothing either
}

TEST(NoAllocation, NorReadingCounters) {
  std::vector<rung_prof> counters(3);
  rung::profile::Collector collector(3, 20);
  const int count = allocationsOf([&] {
    collector.started(counters);
    for (uint64_t i = 0; i < 1000; ++i) {
      counters[i % 3] = {i, i * i * i, 0, 0};
      collector.scanned(counters);
    }
  });
  EXPECT_EQ(count, 0);
}

// Offering the retained memory copies or does nothing: while the saver's thread is busy or asleep too.
TEST(NoAllocation, NorOfferingRetainedMemory) {
  namespace fs = std::filesystem;
  TestProgram test;
  build(test);
  std::string pattern = (fs::temp_directory_path() / "rung_offer_XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  Instance instance(test.program);
  for (const int periodMs : {1, 3600'000}) {
    RetainedMemory retained(test.program, pattern + "/plc", std::chrono::milliseconds(periodMs));
    std::string report;
    std::string error;
    retained.load(instance, report, error);
    ASSERT_EQ(error, "");
    std::chrono::steady_clock::duration longest{};
    const int count = allocationsOf([&] {
      for (int i = 0; i < 20'000; ++i) {
        const auto start = std::chrono::steady_clock::now();
        instance.memory().writeByte(0, 4, static_cast<uint8_t>(i));
        retained.offer(instance);
        longest = std::max(longest, std::chrono::steady_clock::now() - start);
      }
    });
    EXPECT_EQ(count, 0);
    // Far below what waiting for the saver's thread would take in the second round.
    EXPECT_LT(longest, std::chrono::seconds(10));
    instance.memory().writeByte(0, 4, 123);
    EXPECT_EQ(retained.finish(instance), "");
    Instance next(test.program);
    EXPECT_TRUE(RetainedMemory(test.program, pattern + "/plc").load(next, report, error));
    EXPECT_EQ(next.memory().readByte(0, 4), 123);
  }
  fs::remove_all(pattern);
}

} // namespace
