// Instances of one program on threads of their own, and what works beside the scan of one: the saver, whoever answers
// services and takes messages. With ThreadSanitizer (target tsan_tests) every race fails; without it the results do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <random>
#include <thread>

#include "ir/support/temporary_folder.h"
#include "rtlib/retain/retained_memory.h"
#include "sim/machine.h"
#include "tests/threads/examples.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::test {
namespace {

using Bytes = std::vector<uint8_t>;

const Example kExamples[] = {
    {"fanuc-vmc", {"vmc.mne"}},
    {"gsk-mill", {"mill.pmc"}},
    {"nct-lathe", {"io.lad", "main.lad", "probe.lad"}},
    {"technol-mill", {"mill.plc", "changer.plc"}},
};

std::string nameOf(const testing::TestParamInfo<Example>& info) {
  std::string name = info.param.name;
  std::erase(name, '-');
  return name;
}

// A program beside its simulated control, with random inputs of the machine: the same for the same seed.
class Machine {
public:
  Machine(const rung_program& program, uint32_t seed)
      : machine_(program, nullptr, sim::makeSimulatedNc(program.dialect)), random_(seed) {
    machine_.powerOn(nc::PowerOn::Cold);
  }

  void scan() {
    for (uint32_t s = 0; s < instance().program().space_count; ++s)
      if ((instance().program().spaces[s].flags & RUNG_SPACE_INPUT) != 0) change(s);
    machine_.scan();
  }
  runtime::Instance& instance() { return machine_.inside(); }
  Bytes memory() const { return {machine_.inside().block().begin(), machine_.inside().block().end()}; }

private:
  void change(uint32_t space) {
    const uint32_t byte = random_() % instance().program().spaces[space].byte_count;
    instance().memory().writeByte(space, byte, static_cast<uint8_t>(random_()));
  }

  sim::Machine machine_;
  std::mt19937 random_;
};

class Threads : public testing::TestWithParam<Example> {};
INSTANTIATE_TEST_SUITE_P(Examples, Threads, testing::ValuesIn(kExamples), nameOf);

// Generated code has no state of its own: what others run beside an instance does not show in it.
TEST_P(Threads, InstancesOfOneProgramCoexist) {
  constexpr int kScans = 300;
  const auto engine = load(GetParam());
  ASSERT_NE(engine, nullptr);
  const auto run = [&](uint32_t seed) {
    Machine machine(engine->program(), seed);
    for (int i = 0; i < kScans; ++i) machine.scan();
    return machine.memory();
  };
  const std::array<Bytes, 2> alone = {run(1), run(2)};
  EXPECT_NE(alone[0], alone[1]) << "the inputs have effects";
  std::array<Bytes, 2> together;
  std::thread other([&] { together[1] = run(2); });
  together[0] = run(1);
  other.join();
  EXPECT_TRUE(together == alone);
}

// The saver packs and writes while the program is scanned; the last image is that of the last scan.
TEST_P(Threads, TheSaverWorksBesideTheScan) {
  const auto engine = load(GetParam());
  ASSERT_NE(engine, nullptr);
  const rung_program& program = engine->program();
  ASSERT_GT(program.retain_count, 0u);
  const TemporaryFolder folder;
  const std::string file = (folder / "plc").string();
  Machine machine(program, 1);
  std::string report;
  std::string error;
  runtime::RetainedMemory retained(program, file, runtime::RetainWhen::Always, &runtime::takeRetainedOf,
                                   std::chrono::milliseconds(1));
  retained.load(machine.instance(), report, error);
  ASSERT_EQ(error, "");
  std::atomic<bool> done = false;
  std::thread scans([&] {
    uint8_t& kept = machine.instance().block()[program.retains[0].offset];
    for (uint32_t i = 0; i < 300 || (retained.saved() < 3 && i < 1'000'000); ++i) {
      machine.scan();
      kept = i & 1; // whatever the inputs do, images differ
      retained.offer(machine.instance(), false);
    }
    done = true;
  });
  std::array<char, 100> problem{};
  while (!done) {
    EXPECT_FALSE(retained.failing());
    EXPECT_EQ(retained.problem(problem), 0u);
    std::this_thread::yield();
  }
  scans.join();
  EXPECT_GE(retained.saved(), 3u);
  EXPECT_EQ(retained.finish(machine.instance()), "");
  Bytes kept(machine.instance().retainedSize());
  machine.instance().copyRetained(kept);
  const runtime::RetainMap map(program);
  Bytes image(map.size());
  map.pack(kept, image);
  EXPECT_EQ(runtime::RetainStore(file, map.layout().hash, map.size()).load().bytes, image);
}

constexpr int64_t kLast = 2'000; // requests

// A program that asks for the double of a number, again and again, and shows a message for each answer that is right.
// Memory: 0 the ticket, 8 the number.
uint32_t askAgain(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  uint32_t ticket = 0;
  int64_t number = 0;
  std::memcpy(&ticket, mem, sizeof ticket);
  std::memcpy(&number, mem + 8, sizeof number);
  if (ticket != 0 && ctx->host->service_poll(ctx, ticket) == RUNG_SERVICE_DONE) {
    if (ctx->host->service_result(ctx, ticket, 0) != 2 * number) return RUNG_PC_FAULT;
    rung_message message{};
    message.number = static_cast<uint32_t>(number);
    ctx->host->message(ctx, &message);
    ticket = 0;
    ++number;
  }
  if (ticket == 0 && number < kLast) ticket = ctx->host->service_request(ctx, 0, &number, 1);
  std::memcpy(mem, &ticket, sizeof ticket);
  std::memcpy(mem + 8, &number, sizeof number);
  return RUNG_PC_DONE;
}

// Answers and takes messages until it is stopped.
class Host {
public:
  explicit Host(runtime::Instance& instance) : thread_([this, &instance] { work(instance); }) {}
  // What was shown, in its order.
  std::vector<uint32_t> stop() {
    stop_ = true;
    thread_.join();
    return shown_;
  }

private:
  void work(runtime::Instance& instance) {
    bool last = false;
    do {
      last = stop_; // then all is there
      core::ServiceRequest request;
      while (instance.services().take(request)) {
        core::ServiceReply reply;
        reply.ticket = request.ticket;
        reply.resultCount = 1;
        reply.results[0] = 2 * request.args[0];
        EXPECT_TRUE(instance.services().complete(reply));
      }
      for (rung_message message; instance.messages().pop(message);) shown_.push_back(message.number);
      std::this_thread::yield();
    } while (!last);
  }

  std::vector<uint32_t> shown_;
  std::atomic<bool> stop_ = false;
  std::thread thread_; // last: it uses the others
};

void build(TestProgram& test) {
  test.addPacked("D", 1, 64, 0);
  test.addTask("MAIN", test.addChunk(askAgain));
  test.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}, {RUNG_STEP_SLOT, RUNG_NONE, 0}};
  test.link();
}

int64_t numberOf(runtime::Instance& instance) {
  int64_t number = 0;
  std::memcpy(&number, instance.block().data() + 8, sizeof number);
  return number;
}

TEST(Services, AreAnsweredByAnotherThread) {
  TestProgram test;
  build(test);
  runtime::Instance instance(test.program);
  Host host(instance);
  while (!instance.faulted() && numberOf(instance) < kLast) {
    instance.scan();
    std::this_thread::yield();
  }
  const std::vector<uint32_t> shown = host.stop();
  EXPECT_FALSE(instance.faulted());
  EXPECT_EQ(instance.messages().lost(), 0u);
  ASSERT_EQ(shown.size(), size_t{kLast});
  for (uint32_t i = 0; i < shown.size(); ++i) EXPECT_EQ(shown[i], i);
}

// The other thread may be in the middle of an answer: it is never taken for one to a request of after the restart.
TEST(Services, AreAnsweredWhileTheProgramRestarts) {
  TestProgram test;
  build(test);
  runtime::Instance instance(test.program);
  Host host(instance);
  for (int restart = 0; restart < 300; ++restart) {
    instance.coldStart();
    for (int i = 0; i < 50; ++i) instance.scan();
    ASSERT_FALSE(instance.faulted()) << restart;
  }
  while (numberOf(instance) < 3) {
    instance.scan();
    std::this_thread::yield();
  }
  host.stop();
  EXPECT_FALSE(instance.faulted());
}

} // namespace
} // namespace rung::test
