// Programs whose code is exchanged while they run: they do what the interpreter does, whatever code they have.
#include "compiler/tiered.h"
#include "tests/support/long_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <unistd.h>

#include "compiler/recompiler.h"
#include "rtlib/change/forcing.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"
#include "tests/support/differential.h"

namespace rung::compiler {
namespace {

using Random = std::mt19937_64;

// The program as the interpreter runs it, and the same in tiers.
struct Both {
  explicit Both(const ir::Module& module, const codegen::JitOptions& options = {}, Pace pace = Pace::Period)
      : compiled(testing::compiledFromBuilt(module, {.partition = {.maxChunkRungs = 4}})),
        reference(*compiled.layout, 0), expected(reference),
        engine(TieredEngine::make(compiled, options, ir::Counting::Ticks, pace).value()), tested(*engine) {}

  void scan(uint64_t seed, uint64_t scan) {
    for (runtime::Instance* instance : {&expected, &tested}) {
      for (uint32_t byte = 0; byte < std::min(8u, instance->program().spaces[0].byte_count); ++byte)
        EXPECT_EQ(instance->write(runtime::intRef(0, byte, 8), seed * 31 + uint64_t{byte} * 7 + scan * 13),
                  std::nullopt);
      instance->scan();
    }
    const auto found = runtime::firstDifference(expected, tested, nc::describe);
    ASSERT_FALSE(found) << "scan " << scan << ": " << *found;
  }

  Compiled compiled;
  ir::InterpEngine reference;
  runtime::Instance expected;
  std::unique_ptr<TieredEngine> engine;
  runtime::Instance tested;
};

TEST(Tiered, RandomProgramsWhileTheirCodeArrives) {
  uint32_t interpretedFirst = 0;
  uint32_t mixed = 0;
  for (uint64_t seed = 0; seed < testing::howMany(12, 40); ++seed) {
    SCOPED_TRACE(seed);
    Both both(ir::randomModule(seed, {.traps = seed % 4 == 0}));
    interpretedFirst += both.engine->finishedChunks() == 0 ? 1 : 0;
    const uint32_t all = both.tested.program().chunk_count;
    uint64_t scan = 0;
    for (; both.engine->finishedChunks() < all && scan < 20'000; ++scan) {
      both.scan(seed, scan);
      if (HasFatalFailure()) return;
    }
    mixed += scan > 1 ? 1 : 0;
    EXPECT_EQ(both.engine->finish(), "");
    EXPECT_EQ(both.engine->finishedChunks(), all);
    for (uint64_t last = scan + 4; scan < last; ++scan) both.scan(seed, scan);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(interpretedFirst, testing::howMany(3, 10));
  EXPECT_GT(mixed, testing::howMany(3, 10));
}

// Any chunk may have either code at any time.
TEST(Tiered, AnyMixtureDoesTheSame) {
  for (uint64_t seed = 100; seed < 100 + testing::howMany(10, 30); ++seed) {
    SCOPED_TRACE(seed);
    Both both(ir::randomModule(seed, {}));
    EXPECT_EQ(both.engine->finish(), "");
    const uint32_t count = both.tested.program().chunk_count;
    const std::vector<rung_chunk_fn> native(both.engine->tables()->functions(),
                                            both.engine->tables()->functions() + count);
    Random random(seed);
    for (uint64_t scan = 0; scan < 8; ++scan) {
      for (uint32_t chunk = 0; chunk < count; ++chunk)
        both.engine->tables()->set(chunk, random() % 2 == 0 ? &TieredEngine::interpret : native[chunk]);
      both.scan(seed, scan);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Tiered, ForcesStayWhileCodeArrives) {
  uint32_t forced = 0;
  uint32_t arrived = 0; // chunks whose code came into the table of the force
  for (uint64_t seed = 200; seed < 200 + testing::howMany(10, 30); ++seed) {
    SCOPED_TRACE(seed);
    Both both(ir::randomModule(seed, {}));
    const runtime::ForcedCell cell{.ref = runtime::intRef(1 + static_cast<uint32_t>(seed) % 2, 0, 8), .bits = 0x5A};
    runtime::Forcing forcing(both.tested.program(), both.engine->context(), {&cell, 1});
    if (!forcing.problem().empty() || !forcing.needsCode()) continue;
    const auto code = makeForcedCode(both.compiled, EngineKind::Tiered, {}, both.tested.program(),
                                     both.engine->context(), forcing.bytes());
    ASSERT_TRUE(code.ok()) << code.error();
    forcing.setCode(code.value()->code());
    runtime::Forcing reference(both.expected.program(), both.reference.context(), {&cell, 1});
    const auto other = makeForcedCode(both.compiled, EngineKind::Interp, {}, both.expected.program(),
                                      both.reference.context(), reference.bytes());
    ASSERT_TRUE(other.ok());
    reference.setCode(other.value()->code());
    ASSERT_TRUE(both.tested.force(forcing));
    ASSERT_TRUE(both.expected.force(reference));
    ++forced;
    for (uint64_t scan = 0; scan < 4; ++scan) both.scan(seed, scan);
    EXPECT_EQ(both.engine->finish(), "");
    for (uint64_t scan = 4; scan < 8; ++scan) both.scan(seed, scan);
    if (HasFatalFailure()) return;
    uint32_t same = 0;
    for (uint32_t chunk = 0; chunk < both.tested.program().chunk_count; ++chunk)
      same += forcing.code().functions[chunk] == both.engine->program().chunk_fns[chunk] ? 1 : 0;
    EXPECT_LT(same, both.tested.program().chunk_count);
    arrived += same;
    both.tested.endForces();
    both.expected.endForces();
    for (uint64_t scan = 8; scan < 12; ++scan) both.scan(seed, scan);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(forced, testing::howMany(2, 5));
  EXPECT_GT(arrived, forced);
}

TEST(TierTables, FollowersKeepTheirOwn) {
  const auto function = [](uintptr_t number) { return reinterpret_cast<rung_chunk_fn>(number); };
  TierTables tables(3, function(1));
  std::vector<rung_chunk_fn> table{nullptr, function(9), nullptr};
  const std::vector<bool> own{false, true, false};
  tables.follow(table, own);
  EXPECT_THAT(table, ::testing::ElementsAre(function(1), function(9), function(1)));
  tables.set(0, function(2));
  tables.set(1, function(2));
  EXPECT_THAT(table, ::testing::ElementsAre(function(2), function(9), function(1)));
  tables.unfollow(table);
  tables.set(2, function(2));
  EXPECT_THAT(table, ::testing::ElementsAre(function(2), function(9), function(1)));
  EXPECT_EQ(tables.functions()[1], function(2));
}

// ---- the beginning -------------------------------------------------------------------------------------------------

ir::Module withPeriod(uint32_t us) {
  ir::Module module = ir::randomModule(7, {.rungs = 300, .jumps = false});
  for (std::vector<ir::Step>* list : {&module.scan, &module.slices})
    for (ir::Step& step : *list)
      if (step.op == RUNG_STEP_ADVANCE) step.arg = us;
  return module;
}

TEST(Tiered, InterpretsWhereTheInterpreterIsFastEnough) {
  const Both both(withPeriod(1'000'000'000));
  EXPECT_TRUE(both.engine->beganInterpreted());
  EXPECT_TRUE(both.engine->bound().fits());
  EXPECT_EQ(both.engine->bound().periodNs, 1'000'000'000'000);
  EXPECT_GT(both.engine->bound().ns, 0);
}

TEST(Tiered, WaitsForMachineCodeWhereAProgramMayLoop) {
  uint32_t circling = 0;
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const Both both(ir::randomModule(seed, {.rungs = 6}));
    const std::span<const rung_task> tasks(both.tested.program().tasks, both.tested.program().task_count);
    const bool loops = std::ranges::any_of(tasks, [](const rung_task& task) { return task.loops != 0; });
    EXPECT_EQ(both.engine->beganInterpreted(), !loops) << seed;
    circling += loops ? 1 : 0;
  }
  EXPECT_GT(circling, 0u);
}

TEST(Tiered, WaitsForMachineCodeWhereTheInterpreterMayBeLate) {
  for (const codegen::LlvmLevel level : {codegen::LlvmLevel::Fast, codegen::LlvmLevel::Opt}) {
    Both both(withPeriod(1), {.code = {.level = level, .target = {}}});
    EXPECT_FALSE(both.engine->beganInterpreted());
    EXPECT_FALSE(both.engine->bound().fits());
    if (level == codegen::LlvmLevel::Fast) EXPECT_EQ(both.engine->finishedChunks(), both.tested.program().chunk_count);
    for (uint64_t scan = 0; scan < 4; ++scan) both.scan(7, scan);
    EXPECT_EQ(both.engine->finish(), "");
    EXPECT_EQ(both.engine->finishedChunks(), both.tested.program().chunk_count);
    for (uint64_t scan = 4; scan < 8; ++scan) both.scan(7, scan);
  }
}

TEST(Tiered, InterpretsAtAnyPaceOnAVirtualClock) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Both both(ir::randomModule(seed, {.rungs = 6}), {}, Pace::Any);
    EXPECT_TRUE(both.engine->beganInterpreted());
    for (uint64_t scan = 0; scan < 4; ++scan) both.scan(seed, scan);
    EXPECT_EQ(both.engine->finish(), "");
    EXPECT_EQ(both.engine->finishedChunks(), both.tested.program().chunk_count);
    for (uint64_t scan = 4; scan < 8; ++scan) both.scan(seed, scan);
    if (HasFatalFailure()) return;
  }
}

TEST(Tiered, KeepsItsCodeInACacheAndTakesItFromThere) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("rung-tiers-" + std::to_string(getpid()));
  const ir::Module module = withPeriod(1000);
  {
    const Both both(module, {.code = {}, .cacheFolder = folder.string()});
  } // the code is kept although nobody has waited for it
  EXPECT_FALSE(std::filesystem::is_empty(folder));
  const Both both(module, {.code = {}, .cacheFolder = folder.string()});
  EXPECT_EQ(both.engine->problem(), "");
  EXPECT_EQ(both.engine->finishedChunks(), both.tested.program().chunk_count);
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace rung::compiler
