// Code with forced cells, of random programs: every engine does what the interpreter does without the optimiser, and
// the forced bits are as they should be after every rung.
#include "compiler/recompiler.h"
#include "tests/support/long_run.h"

#include <gtest/gtest.h>

#include <random>

#include "rtlib/change/forcing.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "tests/random/random.h"
#include "tests/support/differential.h"

namespace rung::compiler {
namespace {

constexpr int kScans = 4;

using Random = std::mt19937_64;

uint32_t below(Random& random, size_t limit) { return static_cast<uint32_t>(random() % limit); }

// Bits and words anywhere in the spaces.
std::vector<runtime::ForcedCell> randomCells(Random& random, const rung_program& program) {
  std::vector<runtime::ForcedCell> cells;
  for (uint32_t i = 0; i < 6; ++i) {
    const uint32_t space = below(random, program.space_count);
    const uint32_t bytes = program.spaces[space].byte_count;
    if (bytes < 8) continue;
    const uint32_t byte = below(random, bytes - 7);
    constexpr uint32_t kWidths[] = {8, 16, 32, 64};
    const runtime::Ref ref = random() % 3 != 0 ? runtime::bitRef(space, byte, below(random, 8))
                                               : runtime::intRef(space, byte, kWidths[random() % 4]);
    cells.push_back({.ref = ref, .bits = random()});
  }
  return cells;
}

void expectHeld(const runtime::Instance& instance, const runtime::Forcing& forcing) {
  for (const rung_forced_byte& byte : forcing.bytes())
    ASSERT_EQ(instance.memory().readByte(byte.space, byte.byte) & byte.mask, byte.value)
        << "byte " << byte.byte << " of space " << byte.space;
}

// A program that runs with forced cells.
struct Running {
  Running(const ir::Module& module, EngineKind kind, bool optimise, const ir::LayoutOptions& layout = {})
      : compiled(testing::compiledFromBuilt(module, layout, optimise)), engine(makeEngine(kind, compiled, {}).value()),
        kind(kind), instance(*engine) {}

  void force(std::span<const runtime::ForcedCell> cells) {
    forcing.emplace(instance.program(), engine->context(), cells);
    Result<std::unique_ptr<ForcedCode>> made =
        makeForcedCode(compiled, kind, {}, instance.program(), engine->context(), forcing->bytes());
    ASSERT_TRUE(made.ok()) << made.error();
    code = std::move(made).value();
    forcing->setCode(code->code());
    ASSERT_EQ(instance.force(*forcing), !instance.faulted());
  }

  Compiled compiled;
  std::unique_ptr<runtime::Engine> engine;
  EngineKind kind;
  runtime::Instance instance;
  std::optional<runtime::Forcing> forcing;
  std::unique_ptr<ForcedCode> code;
};

// Changes the inputs, the first space, with values that depend on the scan alone.
void changeInputs(runtime::Instance& instance, uint64_t seed, int scan) {
  for (uint32_t byte = 0; byte < std::min(8u, instance.program().spaces[0].byte_count); ++byte)
    EXPECT_EQ(
        instance.write(runtime::intRef(0, byte, 8), seed * 31 + uint64_t{byte} * 7 + static_cast<uint64_t>(scan) * 13),
        std::nullopt);
}

class ForcedCodeOf : public ::testing::TestWithParam<EngineKind> {};

// A program with forced cells from the second scan on, beside the interpreter's without the optimiser.
void compareForced(const ir::Module& module, EngineKind kind, std::span<const runtime::ForcedCell> cells, uint64_t seed,
                   const ir::LayoutOptions& layout, uint32_t& forcedAtEnd) {
  ir::Module other = module; // so that the layouts differ, and spaces are compared instead of bytes of memory
  other.slots.push_back({.type = ir::Type::I64, .key = "of the reference alone"});
  Running reference(other, EngineKind::Interp, false);
  Running tested(module, kind, true, layout);
  for (int scan = 0; scan < kScans; ++scan) {
    if (scan == 1) {
      reference.force(cells);
      tested.force(cells);
    }
    for (Running* running : {&reference, &tested}) {
      changeInputs(running->instance, seed, scan);
      running->instance.scan();
      if (running->instance.forced()) expectHeld(running->instance, *running->forcing);
      EXPECT_EQ(running->instance.forced(), scan >= 1 && !running->instance.faulted());
    }
    const auto found = runtime::firstDifference(reference.instance, tested.instance, nc::describe);
    ASSERT_FALSE(found) << "scan " << scan << ": " << *found;
    if (::testing::Test::HasFatalFailure()) return;
  }
  forcedAtEnd += tested.instance.forced() ? 1 : 0;
}

// Of the cells, as they are asked for; its program is gone then.
bool canBeForced(const ir::Module& module, std::span<const runtime::ForcedCell> cells, uint32_t& withCode) {
  const Running reference(module, EngineKind::Interp, false);
  const runtime::Forcing asked(reference.instance.program(), nullptr, cells);
  withCode += asked.needsCode() ? 1 : 0;
  return asked.problem().empty() && !cells.empty();
}

TEST_P(ForcedCodeOf, RandomPrograms) {
  const uint64_t seeds = GetParam() == EngineKind::Interp ? 300 : testing::howMany(20, 60);
  uint32_t withCode = 0;
  uint32_t forcedAtEnd = 0;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    const ir::Module module = ir::randomModule(seed, {.traps = seed % 4 == 0});
    Random random(seed);
    const std::vector<runtime::ForcedCell> cells =
        randomCells(random, Running(module, EngineKind::Interp, false).instance.program());
    if (!canBeForced(module, cells, withCode)) continue;
    compareForced(module, GetParam(), cells, seed, {}, forcedAtEnd);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(withCode, seeds / 4);
  EXPECT_GT(forcedAtEnd, seeds / 4);
}

// What the optimiser knows of a cell is not so any more where the cell is forced: what it had left out comes back, with
// its paths out of the rung and its accesses. Several chunks, and of every second program those that rest.
TEST_P(ForcedCodeOf, KnownCells) {
  const uint64_t seeds = GetParam() == EngineKind::Interp ? 300 : testing::howMany(25, 300);
  uint32_t withCode = 0;
  uint32_t forcedAtEnd = 0;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    ir::Module module = ir::randomModule(seed, {.rungs = 12, .ops = 8, .traps = false, .known = true});
    Random random(seed);
    std::vector<runtime::ForcedCell> cells;
    for (uint32_t bit = 0; bit < ir::kKnownCells; ++bit)
      if (random() % 2 != 0)
        cells.push_back({.ref = runtime::bitRef(ir::kKnownSpace.index, 0, bit), .bits = random() % 4 != 0 ? 1u : 0u});
    if (!canBeForced(module, cells, withCode)) continue;
    compareForced(module, GetParam(), cells, seed, {.partition = {.maxChunkRungs = 3}}, forcedAtEnd);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(withCode, seeds / 2);
  EXPECT_GT(forcedAtEnd, seeds / 2);
}

INSTANTIATE_TEST_SUITE_P(Engines, ForcedCodeOf, ::testing::Values(EngineKind::Interp, EngineKind::Jit),
                         [](const auto& test) { return std::string(engineName(test.param)); });

// Looks at the forced bits after every rung.
class Looker final : public ir::RungObserver {
public:
  void rungRan(uint32_t, std::span<const uint64_t>) override {
    if (instance != nullptr && forcing != nullptr && instance->forced()) expectHeld(*instance, *forcing);
    ++rungs;
  }
  const runtime::Instance* instance = nullptr;
  const runtime::Forcing* forcing = nullptr;
  uint32_t rungs = 0;
};

TEST(ForcedCode, HoldsTheBitsAfterEveryRung) {
  uint32_t rungs = 0;
  for (uint64_t seed = 1000; seed < 1100; ++seed) {
    SCOPED_TRACE(seed);
    Running running(ir::randomModule(seed, {}), EngineKind::Interp, true);
    Random random(seed);
    const std::vector<runtime::ForcedCell> cells = randomCells(random, running.instance.program());
    if (!runtime::Forcing(running.instance.program(), nullptr, cells).problem().empty() || cells.empty()) continue;
    Looker* looker = nullptr;
    EngineOptions options;
    options.observer = [&](const Compiled&) {
      auto made = std::make_unique<Looker>();
      looker = made.get();
      return made;
    };
    running.forcing.emplace(running.instance.program(), running.engine->context(), cells);
    running.code = makeForcedCode(running.compiled, EngineKind::Interp, options, running.instance.program(),
                                  running.engine->context(), running.forcing->bytes())
                       .value();
    running.forcing->setCode(running.code->code());
    ASSERT_NE(looker, nullptr);
    looker->instance = &running.instance;
    looker->forcing = &*running.forcing;
    ASSERT_TRUE(running.instance.force(*running.forcing));
    for (int scan = 0; scan < kScans; ++scan) running.instance.scan();
    rungs += looker->rungs;
  }
  EXPECT_GT(rungs, 1000u);
}

} // namespace
} // namespace rung::compiler
