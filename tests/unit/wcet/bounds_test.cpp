// Bounds against what runs really take: the interpreter adds up steps, and the processor, one instruction at a time,
// the instructions of compiled code.
#include "tools/wcet/bounds.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <ucontext.h>
#include <utility>

#include "codegen/jit/code_paths.h"
#include "ir/core/builder.h"
#include "ir/random/random.h"
#include "ir/random/random_source.h"
#include "rtlib/host/instance.h"
#include "tests/support/differential.h"
#include "tools/compiler/engines.h"

namespace rung {
namespace {

using compiler::EngineKind;
using wcet::Bounds;
using wcet::Stretch;

std::unique_ptr<host::Engine> engineOf(EngineKind kind, const compiler::Compiled& compiled,
                                       const compiler::EngineOptions& options = {}) {
  Result<std::unique_ptr<host::Engine>> engine = compiler::makeEngine(kind, compiled, options);
  if (engine.ok()) return std::move(engine).value();
  ADD_FAILURE() << engine.error();
  return nullptr;
}

Bounds boundsOf(const compiler::Compiled& compiled) {
  const std::unique_ptr<host::Engine> engine = engineOf(EngineKind::Jit, compiled);
  Result<Bounds> bounds = wcet::boundsOf(compiled, *engine);
  if (bounds.ok()) return std::move(bounds).value();
  ADD_FAILURE() << bounds.error();
  return {};
}

// Any contents of the spaces that the representation allows.
void scatter(host::Instance& instance, ir::RandomSource& random) {
  const rung_program& program = instance.program();
  for (const rung_space& space : std::span(program.spaces, program.space_count))
    for (const rung_range& range : std::span(space.ranges, space.range_count)) {
      const bool bits = range.repr == RUNG_REPR_BYTE_PER_BIT;
      for (uint32_t i = 0; i < range.byte_count * (bits ? 8 : 1); ++i)
        instance.block()[range.offset + i] = static_cast<uint8_t>(bits ? random.below(2) : random.below(256));
    }
}

// Per task, of whole runs and of parts.
class MostOfRuns : public host::TaskWatch {
public:
  explicit MostOfRuns(size_t tasks) : most_(tasks, 0) {}
  void begins(const host::Instance&, uint32_t) override { count_ = 0; }
  void ended(const host::Instance&, uint32_t task) override { most_[task] = std::max(most_[task], count_); }
  uint64_t& count() { return count_; }
  const std::vector<uint64_t>& most() const { return most_; }

private:
  uint64_t count_ = 0;
  std::vector<uint64_t> most_;
};

// ---- steps ---------------------------------------------------------------------------------------------------------

class AddSteps final : public ir::RungObserver {
public:
  AddSteps(const ir::Layout& layout, uint64_t& steps) : weights_(ir::rungWeights(layout)), steps_(steps) {}
  void rungRan(uint32_t number, std::span<const uint64_t>) override { steps_ += weights_[number]; }

private:
  std::vector<uint64_t> weights_;
  uint64_t& steps_;
};

std::vector<uint64_t> mostSteps(const compiler::Compiled& compiled, int scans) {
  MostOfRuns most(compiled.module->tasks.size());
  compiler::EngineOptions options;
  options.observer = [&](const compiler::Compiled& of) { return std::make_unique<AddSteps>(*of.layout, most.count()); };
  const std::unique_ptr<host::Engine> engine = engineOf(EngineKind::Interp, compiled, options);
  host::Instance instance(*engine);
  instance.setTaskWatch(&most);
  ir::RandomSource random(7);
  for (int i = 0; i < scans; ++i) {
    if (instance.faulted()) instance.coldStart();
    scatter(instance, random);
    instance.scan();
  }
  return most.most();
}

ir::Module weighted(uint64_t seed, const ir::RandomOptions& options) {
  ir::Module module = ir::randomModule(seed, options);
  for (ir::Routine& routine : module.routines)
    for (size_t i = 0; i < routine.rungs.size(); ++i) routine.rungs[i].weight = 1 + static_cast<uint32_t>(i * 5 % 4);
  return module;
}

TEST(Steps, AreNeverMoreThanTheBound) {
  uint32_t reached = 0;
  uint32_t bounded = 0;
  for (uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    const compiler::Compiled compiled = testing::compiledFrom(weighted(seed, {.ops = 6}), {.maxChunkRungs = 4});
    const std::vector<uint64_t> most = mostSteps(compiled, 12);
    const std::vector<uint64_t> weights = ir::rungWeights(*compiled.layout);
    for (uint32_t t = 0; t < most.size(); ++t) {
      const ir::HeaviestWay way = ir::heaviestWay(*compiled.layout, ir::TaskId{t}, weights);
      if (!way.circles.empty()) continue;
      EXPECT_LE(most[t], way.cost);
      ++bounded;
      reached += most[t] == way.cost ? 1 : 0;
    }
  }
  EXPECT_GT(bounded, 50u);
  EXPECT_GT(reached, bounded / 4); // the bound is not only large
}

// ---- instructions --------------------------------------------------------------------------------------------------

#if defined(__x86_64__)

constexpr uint64_t kTrapFlag = 0x100;

// What the handler of a signal may touch.
struct Stepping {
  uint64_t last = 0; // address of the instruction that is next
  uint64_t code[64][2] = {};
  uint32_t codeCount = 0;
  uint64_t* count = nullptr;
};
Stepping gStepping;

// After each instruction.
void stepped(int, siginfo_t*, void* context) {
  for (uint32_t i = 0; i < gStepping.codeCount; ++i)
    if (gStepping.last >= gStepping.code[i][0] && gStepping.last < gStepping.code[i][1]) ++*gStepping.count;
  gStepping.last = static_cast<uint64_t>(static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
}

// The JIT's code lies in memory that belongs to no file.
void findCode() {
  gStepping.codeCount = 0;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream fields(line);
    std::string range, rights, offset, device, inode, path;
    fields >> range >> rights >> offset >> device >> inode >> path;
    if (rights.find('x') == std::string::npos || !path.empty() || gStepping.codeCount == 64) continue;
    uint64_t(&piece)[2] = gStepping.code[gStepping.codeCount++];
    piece[0] = std::stoull(range, nullptr, 16);
    piece[1] = std::stoull(range.substr(range.find('-') + 1), nullptr, 16);
  }
}

// Of the compiled code alone.
std::vector<uint64_t> mostInstructions(const compiler::Compiled& compiled, int scans) {
  const std::unique_ptr<host::Engine> engine = engineOf(EngineKind::Jit, compiled);
  MostOfRuns most(compiled.module->tasks.size());
  host::Instance instance(*engine);
  instance.setTaskWatch(&most);
  findCode();
  gStepping.count = &most.count();
  struct sigaction action{};
  struct sigaction before{};
  action.sa_sigaction = &stepped;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGTRAP, &action, &before);
  ir::RandomSource random(3);
  for (int i = 0; i < scans; ++i) {
    if (instance.faulted()) instance.coldStart();
    if (i > 0) scatter(instance, random);
    __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() | kTrapFlag);
    instance.scan();
    __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() & ~kTrapFlag);
  }
  sigaction(SIGTRAP, &before, nullptr);
  return most.most();
}

TEST(Instructions, AreNeverMoreThanTheBound) {
  uint32_t known = 0;
  uint32_t ran = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const compiler::Compiled compiled = testing::compiledFrom(weighted(seed, {.ops = 16}), {.maxChunkRungs = 4});
    const Bounds bounds = boundsOf(compiled);
    const std::vector<uint64_t> most = mostInstructions(compiled, 3);
    for (uint32_t t = 0; t < most.size(); ++t) {
      ran += most[t] > 0 ? 1 : 0;
      if (!bounds.tasks[t].instructions) continue;
      ++known;
      EXPECT_LE(most[t], *bounds.tasks[t].instructions) << bounds.tasks[t].name;
    }
  }
  EXPECT_GT(ran, 50u);
  EXPECT_GT(known, 50u);
}

TEST(Instructions, OfEachOperation) {
  for (const ir::OpInfo& info : ir::allOps()) {
    SCOPED_TRACE(info.name);
    const compiler::Compiled compiled = testing::compiledFrom(ir::moduleForOp(info.code));
    const Bounds bounds = boundsOf(compiled);
    const std::vector<uint64_t> most = mostInstructions(compiled, 2);
    for (uint32_t t = 0; t < most.size(); ++t) {
      EXPECT_EQ(bounds.tasks[t].noInstructions, "");
      ASSERT_TRUE(bounds.tasks[t].instructions);
      EXPECT_LE(most[t], *bounds.tasks[t].instructions);
    }
  }
}

// 40 rungs that copy a bit each, in chunks of 8.
ir::Module copies() {
  ir::Module module = ir::randomModule(1, {.rungs = 4, .jumps = false});
  std::vector<ir::Rung>& rungs = module.routines[module.tasks[0].entry.index].rungs;
  rungs.assign(40, {});
  module.tasks.resize(1);
  module.tasks[0].parts = 1;
  module.tasks[0].borders.clear();
  module.scan = {{.op = RUNG_STEP_RUN, .task = ir::TaskId{0}, .arg = 1}};
  module.fast.clear();
  module.slices.clear();
  module.mainTask = ir::TaskId{0};
  module.fastTask = {};
  for (uint32_t i = 0; i < rungs.size(); ++i) {
    ir::RungBuilder b(module, rungs[i]);
    b.store({ir::SpaceId{0}, 3, i % 8}, b.not_(b.load(ir::Type::Bit, {ir::SpaceId{0}, 1, i % 8})));
  }
  return module;
}

TEST(Instructions, AreThoseOfTheCodeWhereItHasOneWay) {
  const compiler::Compiled compiled = testing::compiledFrom(copies(), {.maxChunkRungs = 8});
  const Bounds bounds = boundsOf(compiled);
  ASSERT_TRUE(bounds.tasks[0].instructions);
  EXPECT_EQ(mostInstructions(compiled, 2)[0], *bounds.tasks[0].instructions);
  EXPECT_EQ(bounds.tasks[0].steps, 40u);
}

#endif

// ---- the graph of machine code
// ---------------------------------------------------------------------------------------

using codegen::CodeLength;
using codegen::FunctionCode;

CodeLength lengthOf(FunctionCode code) { return codegen::CodeLengths({{"F", std::move(code)}}).of("F"); }

TEST(CodePaths, TakeTheLongerBranch) {
  EXPECT_EQ(lengthOf({.blocks = {{.instructions = 2, .next = {1, 2}},
                                 {.instructions = 10, .next = {3}},
                                 {.instructions = 3, .next = {3}},
                                 {.instructions = 1}}})
                .instructions,
            13u);
}

TEST(CodePaths, RepeatLoopsAndTheirInnerLoops) {
  // 0 -> 1 (header, 5 rounds) -> 2 (inner loop by itself, 3 rounds) -> 1 or 3
  const FunctionCode code{.blocks = {{.instructions = 1, .next = {1}},
                                     {.instructions = 2, .next = {2}, .loop = 0},
                                     {.instructions = 4, .next = {2, 1, 3}, .loop = 1},
                                     {.instructions = 7}},
                          .loops = {{.header = 1, .rounds = 5}, {.header = 2, .parent = 0, .rounds = 3}}};
  EXPECT_EQ(lengthOf(code).instructions, 1u + 5 * (2 + 3 * 4) + 7);
}

TEST(CodePaths, SayWhyThereIsNoBound) {
  FunctionCode endless{.blocks = {{.instructions = 1, .next = {0}, .loop = 0}}, .loops = {{.header = 0}}};
  EXPECT_EQ(lengthOf(endless).unknown, "the rounds of a loop are not known");
  const FunctionCode irregular{.blocks = {{.instructions = 1, .next = {1, 2}},
                                          {.instructions = 1, .next = {2}},
                                          {.instructions = 1, .next = {1}}}};
  EXPECT_EQ(lengthOf(irregular).unknown, "control enters a loop of the machine code in two places");
  EXPECT_EQ(lengthOf({.blocks = {{.instructions = 1, .calls = {"memset"}}}}).unknown, "it calls 'memset'");
  EXPECT_EQ(lengthOf({.blocks = {{.instructions = 1, .calls = {"F"}}}}).unknown, "'F' calls itself");
}

TEST(CodePaths, AddWhatIsCalled) {
  codegen::CodeLengths lengths({{"F", {.blocks = {{.instructions = 2, .calls = {"G", "G"}}}}},
                                {"G", {.blocks = {{.instructions = 5}}, .callsHost = true}}});
  EXPECT_EQ(lengths.of("F").instructions, 12u);
  EXPECT_TRUE(lengths.of("F").callsHost);
}

TEST(Stretches, JoinNumbersThatFollowOneAnother) {
  EXPECT_EQ(wcet::stretches({3, 4, 5, 5, 9, 10, 7}), (std::vector<Stretch>{{3, 5}, {9, 10}, {7, 7}}));
  EXPECT_TRUE(wcet::stretches({}).empty());
}

} // namespace
} // namespace rung
