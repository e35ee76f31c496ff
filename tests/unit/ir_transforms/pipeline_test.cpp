// The pipeline: what it does to whole modules, that programs go on behaving the same, and how long it takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <utility>

#include "ir/core/builder.h"
#include "ir/core/op_info.h"
#include "ir/interp/interp.h"
#include "ir/support/hash.h"
#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/pipeline.h"
#include "ir/verify/verify.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

constexpr const char* kSealIn = R"(%0:bit = load B[0.0]
%1:bit = load B[1.0]
%2:bit = or %0, %1
%3:bit = load B[0.1]
%4:bit = not %3
%5:bit = and %2, %4
store.bit B[1.0], %5
%6:bit = load B[1.0]
slot_store.bit $2, %6
%7:bit = slot_load $2
%8:bit = not %7
%9:bit = not %8)";

TEST(Pipeline, AllTogether) {
  Module module = moduleOf(kSealIn, "} goto 2 if %9");
  runPasses(module, {.optimise = true, .instrument = false, .verifyEach = true});
  EXPECT_EQ(bodyOf(module), R"(%0:bit = load B[0.0]
%1:bit = load B[1.0]
%2:bit = or %0, %1
%3:bit = load B[0.1]
%4:bit = not %3
%5:bit = and %2, %4
store.bit B[1.0], %5
} goto 2 if %5
)");
  const Module first = module;
  runPasses(module, {.optimise = true, .instrument = false, .verifyEach = true});
  EXPECT_EQ(print(module), print(first)) << "nothing is left to do";
}

TEST(Pipeline, NothingToDo) {
  Module module = moduleOf(kSealIn);
  const std::string before = print(module);
  runPasses(module, {.optimise = false, .instrument = false, .verifyEach = true});
  EXPECT_EQ(print(module), before);
}

TEST(Pipeline, Instrument) {
  Module module = moduleOf("%0:bit = load B[0.0]\nstore.bit B[0.1], %0", "} goto 2 if %0");
  const PassOptions options{.optimise = false, .instrument = true, .verifyEach = true};
  runPasses(module, options);
  EXPECT_TRUE(module.instrumented);
  EXPECT_EQ(bodyOf(module), "prof_enter\n%0:bit = load B[0.0]\nstore.bit B[0.1], %0\nprof_leave\n} goto 2 if %0\n");
  EXPECT_EQ(bodyOf(module, RoutineId{0}, 1), "prof_enter\nprof_leave\n");
  const std::string once = print(module);
  runPasses(module, {.optimise = true, .instrument = true, .verifyEach = true});
  EXPECT_EQ(print(module), once) << "measured once";
}

TEST(PipelineDeathTest, VerifiesEachPass) {
  Module module = moduleOf("%0:bit = load B[0.0]\nstore.bit B[0.1], %0");
  module.routines[0].rungs[0].ops[1].imm = int64_t{64} * 8;
  EXPECT_DEATH(runPasses(module, {.optimise = true, .instrument = false, .verifyEach = true}), "outside its space");
}

// ---- settled rungs

// Passes in any order that leave out what is settled, and the same ones that look at each rung.
TEST(Settled, IsWhatAPassWouldLeaveAsItIs) {
  struct Two {
    SettlingPass leavesOut;
    PassFunction overAll;
  };
  constexpr Two kPasses[] = {{foldConstants, foldConstants},
                             {reuseValues, reuseValues},
                             {removeDeadOps, removeDeadOps},
                             {removeTransientStores, removeTransientStores},
                             {versionRanges, versionRanges}};
  for (uint64_t seed = 0; seed < 600; ++seed) {
    RandomOptions options;
    options.ops = seed % 3 == 0 ? 60 : 16;
    Module module = randomModule(seed, options);
    Module whole = module;
    Settled settled(module);
    std::string order;
    uint64_t random = seed;
    for (int i = 0; i < 10; ++i) {
      random = hashNumber(random, kHashSeed);
      const size_t next = random % std::size(kPasses);
      order += static_cast<char>('0' + next);
      kPasses[next].leavesOut(module, settled);
      kPasses[next].overAll(whole);
      ASSERT_EQ(print(module), print(whole)) << "seed " << seed << ", passes " << order;
    }
  }
}

TEST(Settled, RungsAreLeftOut) {
  Module module = moduleOf(kSealIn);
  Settled settled(module);
  int rungs = 0;
  const auto count = [&](Rung&, uint32_t, uint8_t before) {
    ++rungs;
    return before;
  };
  settled.eachOpen(module, kDeadRemoved, count);
  EXPECT_GT(std::exchange(rungs, 0), 0);
  removeDeadOps(module, settled);
  settled.eachOpen(module, kDeadRemoved, count);
  EXPECT_EQ(rungs, 0);
}

// ---- the same behaviour
// ----------------------------------------------------------------------------------------------

constexpr int kScans = 5;

// Answers every second request at once.
class Answers final : public runtime::ScheduleHooks {
public:
  bool respond(runtime::Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    if (request.ticket % 2 == 0) return false;
    reply.ticket = request.ticket;
    reply.state = RUNG_SERVICE_DONE;
    reply.resultCount = 3;
    for (uint32_t i = 0; i < reply.resultCount; ++i)
      reply.results[i] = (int64_t{1000} * (i + 1)) ^ (request.argCount > 0 ? request.args[0] : 0);
    return true;
  }
};

// A module that runs in the interpreter.
struct Running {
  explicit Running(Module from)
      : module(std::move(from)), layout(module, {}), engine(layout, 0), instance(engine, &answers) {}
  Module module;
  Layout layout;
  Answers answers;
  InterpEngine engine;
  runtime::Instance instance;
};

// Every second scan the machine changes the inputs; they are the first space.
void changeInputs(runtime::Instance& instance, uint64_t seed, int scan) {
  const uint32_t bytes = std::min(8u, instance.program().spaces[0].byte_count);
  for (uint32_t byte = 0; byte < bytes; ++byte)
    EXPECT_EQ(instance.write(runtime::intRef(0, byte, 8),
                             (seed * 31 + uint64_t{byte} * 7 + static_cast<uint64_t>(scan / 2) * 13) & 255),
              std::nullopt);
}

std::string slotDifference(const Running& a, const Running& b) {
  for (uint32_t i = 0; i < a.module.slots.size(); ++i) {
    const Slot& slot = a.module.slots[i];
    const uint32_t bytes = std::max(1u, byteWidth(slot.type));
    if (!slot.transient && std::memcmp(a.instance.block().data() + a.layout.memory().slot(SlotId{i}),
                                       b.instance.block().data() + b.layout.memory().slot(SlotId{i}), bytes) != 0)
      return fmt::format("slot {}", slot.key);
  }
  return {};
}

// Empty when both modules do the same. The transient slots alone may differ.
std::string difference(Module before, Module after, uint64_t seed) {
  before.slots.push_back(
      {.type = Type::I64, .key = "makes the layouts differ, so that spaces are compared and not bytes of memory"});
  Running a(std::move(before));
  Running b(std::move(after));
  for (int scan = 1; scan <= kScans; ++scan) {
    for (Running* running : {&a, &b}) {
      changeInputs(running->instance, seed, scan);
      running->instance.scan();
    }
    if (const auto found = runtime::firstDifference(a.instance, b.instance, nc::describe))
      return fmt::format("scan {}: {}", scan, *found);
    b.module.slots.resize(a.module.slots.size() - 1);
    if (const std::string found = slotDifference(b, a); !found.empty()) return fmt::format("scan {}: {}", scan, found);
  }
  return {};
}

void everything(Module& module) { runPasses(module, {.optimise = true, .instrument = false, .verifyEach = false}); }

struct NamedPass {
  const char* name;
  PassFunction pass;
  bool keepsOps = false; // does not make fewer of them
};
class SameBehaviour : public testing::TestWithParam<NamedPass> {};

TEST_P(SameBehaviour, OfRandomModules) {
  size_t before = 0;
  size_t after = 0;
  uint32_t changed = 0;
  const auto count = [](const Module& module) {
    size_t ops = 0;
    for (const Routine& routine : module.routines)
      for (const Rung& rung : routine.rungs) ops += rung.ops.size();
    return ops;
  };
  for (uint64_t seed = 0; seed < 400; ++seed) {
    RandomOptions options;
    options.ops = seed % 3 == 0 ? 60 : 16;
    options.traps = seed % 2 == 0;
    Module module = randomModule(seed, options);
    const Module plain = module;
    before += count(module);
    GetParam().pass(module);
    after += count(module);
    changed += print(plain) != print(module) ? 1 : 0;
    const std::vector<VerifyError> errors = verify(module, Mode::Final);
    ASSERT_TRUE(errors.empty()) << "seed " << seed << "\n" << render(module, errors);
    ASSERT_EQ(difference(plain, module, seed), "") << "seed " << seed;
  }
  EXPECT_GT(changed, 0u) << "the pass has nothing to do in random modules, so nothing was tested";
  if (!GetParam().keepsOps) {
    EXPECT_LT(after, before);
  }
}

// Random modules write nearly everywhere: here what would write to the input or its latch writes to an output.
TEST(LatchesOfUnwrittenInputs, BehaveTheSameInRandomModules) {
  constexpr SpaceId kInput{0}, kOutput{1}, kLatch{6};
  uint32_t changed = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    Module module = randomModule(seed, {});
    for (Routine& routine : module.routines)
      for (Rung& rung : routine.rungs)
        for (Op& op : rung.ops)
          if (const std::optional<Use> use = useOf(module, op);
              use && use->writes && (use->place.space == kInput || use->place.space == kLatch))
            op.ref = kOutput.index;
    const Module plain = module;
    readSourcesOfLatches(module);
    changed += print(plain) != print(module) ? 1 : 0;
    const std::vector<VerifyError> errors = verify(module, Mode::Final);
    ASSERT_TRUE(errors.empty()) << "seed " << seed << "\n" << render(module, errors);
    module.tasks[0].begin = plain.tasks[0].begin; // for the contents of the latch itself
    ASSERT_EQ(difference(plain, module, seed), "") << "seed " << seed;
  }
  EXPECT_GT(changed, 50u);
}

TEST_P(SameBehaviour, OfEveryOperation) {
  for (const OpInfo& info : allOps()) {
    Module module = moduleForOp(info.code);
    if (module.instrumented) continue;
    const Module plain = module;
    GetParam().pass(module);
    const std::vector<VerifyError> errors = verify(module, Mode::Final);
    ASSERT_TRUE(errors.empty()) << info.name << "\n" << render(module, errors);
    ASSERT_EQ(difference(plain, module, 1), "") << info.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Passes, SameBehaviour,
                         testing::Values(NamedPass{"Order", [](Module& m) { orderOperations(m); }, true},
                                         NamedPass{"Inline", inlineRoutines, true}, NamedPass{"Fold", foldConstants},
                                         NamedPass{"Reuse", reuseValues}, NamedPass{"Dead", removeDeadOps},
                                         NamedPass{"Transient", removeTransientStores},
                                         NamedPass{"RangeVersioning", versionRanges, true},
                                         NamedPass{"All", everything}),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace rung::ir
