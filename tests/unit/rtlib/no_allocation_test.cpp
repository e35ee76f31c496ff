// Starting, scanning and running tasks allocate nothing.
#include <gtest/gtest.h>

#include <unistd.h>

#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>

#include "rtlib/retain/retained_memory.h"
#include "rtlib/run/instance.h"
#include "tests/support/count_allocations.h"
#include "tests/support/count_system_calls.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using namespace rung::core;
using rung::test::allocationsOf;
using rung::test::TestProgram;

class Model : public ScheduleHooks {
  void onHook(Instance& instance, uint32_t) override { instance.runTask(1); }
  bool respond(Instance&, const ServiceRequest& request, ServiceReply&) override { return request.service == 0; }
};

// A program that uses all there is: copies, parts, messages, services of both kinds, and in the end a fault.
void build(TestProgram& test) {
  test.addPacked("R", 1, 64, 0);
  test.addChunk([](uint8_t* mem, rung_ctx* ctx, uint32_t) {
    rung_message message{};
    ctx->host->message(ctx, &message);
    int64_t arg = 0;
    ctx->host->service_poll(ctx, ctx->host->service_request(ctx, mem[0] & 1u, &arg, 1));
    return ++mem[0] == 200 ? RUNG_PC_FAULT : 1u;
  });
  test.addChunk([](uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; });
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
            2);
  EXPECT_EQ(allocationsOf([&] {
              kept = ::operator new(10);
              ::operator delete(kept);
            }),
            2);
}

TEST(NoAllocation, NorAReplacement) {
  TestProgram one, two;
  build(one);
  build(two);
  Instance instance(one.program);
  Replacement replacement(one.program, {two.program});
  bool replaced = true;
  EXPECT_EQ(allocationsOf([&] {
              for (int i = 0; i < 10; ++i) {
                instance.scan();
                replaced = replaced && instance.replace(replacement) == ReplaceResult::Replaced;
              }
            }),
            0);
  EXPECT_TRUE(replaced);
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

// A place in the saver's work where it stops until it is let go.
class Gate {
public:
  void pass() {
    std::unique_lock lock(mutex_);
    reached_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void waitUntilReached() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return reached_; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool reached_ = false;
  bool open_ = false;
};

struct Disk {
  Gate* gate = nullptr;
  std::vector<uint8_t> last;
};

class SlowTarget final : public RetainTarget {
public:
  explicit SlowTarget(Disk& disk) : disk_(&disk) {}
  bool save(std::span<const uint8_t> bytes, const RetainLayout&, std::string&) override {
    if (disk_->gate != nullptr) disk_->gate->pass();
    disk_->last.assign(bytes.begin(), bytes.end());
    return true;
  }

private:
  Disk* disk_;
};

TEST(NoAllocation, SystemCallsAreCounted) {
  const std::optional<int> calls = systemCallsOf([] { static_cast<void>(getppid()); });
  if (!calls) GTEST_SKIP() << "this kernel does not dispatch system calls to the process";
  EXPECT_EQ(*calls, 1);
  EXPECT_EQ(systemCallsOf([] {}), 0);
}

// Wherever the saver stops, in the middle of packing or of writing: offering copies, and neither allocates nor enters
// the kernel, which it would have to where it waited.
TEST(NoAllocation, NorOfferingRetainedMemory) {
  constexpr uint64_t kOffers = 20'000;
  for (const bool whileWriting : {false, true}) {
    SCOPED_TRACE(whileWriting);
    Gate gate;
    Disk disk{whileWriting ? &gate : nullptr, {}};
    const auto pack = [&](std::span<const uint8_t> raw, std::span<uint8_t> image) {
      if (!whileWriting) gate.pass();
      std::copy(raw.begin(), raw.end(), image.begin());
    };
    RetainSaver saver(std::make_unique<SlowTarget>(disk), std::make_unique<RetainChannel>(1, 8, 8, pack),
                      std::chrono::milliseconds(1));
    uint64_t taken = 0;
    const auto offer = [&](uint64_t value) {
      taken = saver.offerFrom([&](std::span<uint8_t> to) { std::memcpy(to.data(), &value, sizeof value); });
    };
    offer(0);
    gate.waitUntilReached();
    std::optional<int> calls;
    const int count = allocationsOf([&] {
      calls = systemCallsOf([&] {
        for (uint64_t i = 1; i <= kOffers; ++i) offer(i);
      });
    });
    EXPECT_EQ(count, 0);
    EXPECT_EQ(calls.value_or(0), 0);
    EXPECT_EQ(taken, kOffers + 1); // all of them
    EXPECT_EQ(saver.stored(), 0u); // and the saver still stops
    gate.open();
    EXPECT_TRUE(saver.flush());
    EXPECT_EQ(saver.stored(), kOffers + 1);
    EXPECT_EQ(saver.saved(), 2u); // the first and the newest
    uint64_t last = 0;
    ASSERT_EQ(disk.last.size(), sizeof last);
    std::memcpy(&last, disk.last.data(), sizeof last);
    EXPECT_EQ(last, kOffers);
  }
}

// The same of all that a host calls after a scan.
TEST(NoAllocation, NorTheEndOfAScan) {
  namespace fs = std::filesystem;
  TestProgram test;
  build(test);
  std::string pattern = (fs::temp_directory_path() / "rung_offer_XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  for (const RetainWhen when : {RetainWhen::Always, RetainWhen::OnRequest}) {
    Instance instance(test.program);
    RetainedMemory retained(test.program, pattern + "/plc", when, &takeRetainedOf, std::chrono::milliseconds(1));
    std::string report;
    std::string error;
    retained.load(instance, report, error);
    ASSERT_EQ(error, "");
    std::optional<int> calls;
    const int count = allocationsOf([&] {
      calls = systemCallsOf([&] {
        for (int i = 0; i < 20'000; ++i) {
          instance.memory().writeByte(0, 4, static_cast<uint8_t>(i));
          retained.offer(instance, i % 3 != 0);
          char problem[100];
          retained.problem(problem);
        }
      });
    });
    EXPECT_EQ(count, 0);
    EXPECT_EQ(calls.value_or(0), 0);
    EXPECT_FALSE(retained.failing());
    instance.memory().writeByte(0, 4, 123);
    EXPECT_EQ(retained.finish(instance), "");
    EXPECT_EQ(RetainStore(pattern + "/plc", RetainMap(test.program).layout().hash, 4).load().bytes[0], 123);
  }
  fs::remove_all(pattern);
}

} // namespace
