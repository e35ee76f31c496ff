// Bounds in machine instructions and in calls of the host against what runs take: the processor runs compiled code one
// instruction at a time. Random programs, each operation, and the example machines while their scenarios run.
#if defined(__x86_64__)

#include <csignal>
#include <fstream>
#include <sstream>
#include <ucontext.h>

#include "ir/core/builder.h"
#include "ir/core/op_info.h"
#include "rtlib/core/queues.h"
#include "tests/support/long_run.h"
#include "tests/unit/report/bounds_testing.h"
#include "tools/scenario/runner.h"

namespace rung::report {
namespace {

using compiler::EngineKind;

constexpr uint64_t kTrapFlag = 0x100;
const ir::OpCode kFunctions[] = {ir::findOp("message")->code, ir::findOp("service_request")->code,
                                 ir::findOp("service_poll")->code, ir::findOp("service_result")->code};

struct Counts {
  uint64_t instructions = 0;
  uint64_t calls[4] = {}; // of kFunctions
};

// What the handler of a signal may touch.
struct Stepping {
  uint64_t next = 0; // address of the instruction that is next
  uint64_t code[64][2] = {};
  uint32_t codeCount = 0;
  uint64_t functions[4] = {}; // addresses of kFunctions
  Counts counts;
};
Stepping gStepping;

// After each instruction.
void stepped(int, siginfo_t*, void* context) {
  for (uint32_t i = 0; i < gStepping.codeCount; ++i)
    if (gStepping.next >= gStepping.code[i][0] && gStepping.next < gStepping.code[i][1])
      ++gStepping.counts.instructions;
  for (int i = 0; i < 4; ++i) gStepping.counts.calls[i] += gStepping.next == gStepping.functions[i] ? 1 : 0;
  gStepping.next = static_cast<uint64_t>(static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
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

// Steps through runs, of whole tasks and of parts, and keeps the most of each task. While it exists nobody else steps.
class StepRuns final : public runtime::TaskWatch {
public:
  // `every`: how many runs of a task there are to one that is stepped through.
  explicit StepRuns(const compiler::Compiled& compiled, uint32_t every = 1)
      : every_(every), most_(compiled.module->tasks.size()), runs_(compiled.module->tasks.size()) {
    const rung_host_api& host = core::hostApi();
    gStepping.functions[0] = reinterpret_cast<uint64_t>(host.message);
    gStepping.functions[1] = reinterpret_cast<uint64_t>(host.service_request);
    gStepping.functions[2] = reinterpret_cast<uint64_t>(host.service_poll);
    gStepping.functions[3] = reinterpret_cast<uint64_t>(host.service_result);
    struct sigaction action{};
    action.sa_sigaction = &stepped;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGTRAP, &action, &before_);
    findCode();
  }
  ~StepRuns() override { sigaction(SIGTRAP, &before_, nullptr); }

  void begins(const runtime::Instance&, uint32_t task) override {
    gStepping.counts = {};
    gStepping.next = 0;
    if (runs_[task]++ % every_ == 0) __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() | kTrapFlag);
  }
  void ended(const runtime::Instance&, uint32_t task) override {
    __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() & ~kTrapFlag);
    Counts& most = most_[task];
    most.instructions = std::max(most.instructions, gStepping.counts.instructions);
    for (int i = 0; i < 4; ++i) most.calls[i] = std::max(most.calls[i], gStepping.counts.calls[i]);
  }
  const Counts& of(uint32_t task) const { return most_[task]; }

private:
  uint32_t every_;
  std::vector<Counts> most_;
  std::vector<uint32_t> runs_;
  struct sigaction before_{};
};

uint64_t callsOf(const TaskBound& bound, ir::OpCode function) {
  for (const HostCalls& calls : bound.calls)
    if (calls.function.operation == function) return calls.count;
  return 0;
}

Bounds boundsOf(const compiler::Compiled& compiled) {
  const Result<std::unique_ptr<codegen::JitEngine>> engine = compileWithLengths(compiled);
  if (engine.ok()) return report::boundsOf(compiled, *engine.value());
  ADD_FAILURE() << engine.error();
  return {};
}

void expectWithin(const Counts& most, const TaskBound& bound) {
  ASSERT_TRUE(bound.instructions) << bound.name << ": " << bound.noInstructions;
  EXPECT_LE(most.instructions, *bound.instructions) << bound.name;
  for (int i = 0; i < 4; ++i)
    EXPECT_LE(most.calls[i], callsOf(bound, kFunctions[i])) << bound.name << ' ' << ir::opInfo(kFunctions[i]).name;
}

// Of a program that runs with any contents of its memory.
struct Measured {
  Bounds bounds;
  std::vector<Counts> most; // by task
};

Measured measured(const compiler::Compiled& compiled, int scans) {
  const std::unique_ptr<runtime::Engine> engine = engineOf(EngineKind::Jit, compiled);
  Measured out{.bounds = boundsOf(compiled), .most = {}};
  StepRuns runs(compiled);
  runtime::Instance instance(*engine);
  instance.setTaskWatch(&runs);
  ir::RandomSource random(3);
  for (int i = 0; i < scans; ++i) {
    if (instance.faulted()) instance.coldStart();
    if (i > 0) scatter(instance, random);
    instance.scan();
  }
  for (uint32_t t = 0; t < compiled.module->tasks.size(); ++t) out.most.push_back(runs.of(t));
  return out;
}

TEST(Instructions, AreNeverMoreThanTheBound) {
  uint32_t ran = 0;
  uint32_t called = 0;
  for (uint64_t seed = 1; seed <= testing::howMany(8, 25); ++seed) {
    SCOPED_TRACE(seed);
    const Measured of = measured(randomProgram(seed, {.ops = 12}), 2);
    for (uint32_t t = 0; t < of.most.size(); ++t) {
      ran += of.most[t].instructions > 0 ? 1 : 0;
      for (const uint64_t calls : of.most[t].calls) called += calls > 0 ? 1 : 0;
      expectWithin(of.most[t], of.bounds.tasks[t]);
    }
  }
  EXPECT_GT(ran, testing::howMany(8, 20));
  EXPECT_GT(called, testing::howMany(3, 10));
}

TEST(Instructions, OfEachOperation) {
  for (const ir::OpInfo& info : ir::allOps()) {
    SCOPED_TRACE(info.name);
    const Measured of = measured(testing::compiledFrom(ir::moduleForOp(info.code)), 1);
    for (uint32_t t = 0; t < of.most.size(); ++t) expectWithin(of.most[t], of.bounds.tasks[t]);
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
  const Measured of = measured(testing::compiledFrom(copies(), {.partition = {.maxChunkRungs = 8}}), 2);
  EXPECT_EQ(of.most[0].instructions, of.bounds.tasks[0].instructions);
  EXPECT_EQ(of.bounds.tasks[0].steps, 40u);
}

// ---- example machines ----------------------------------------------------------------------------------------------

class StepMachine final : public scenario::Observer {
public:
  void begin(const compiler::Compiled& compiled) {
    bounds_ = boundsOf(compiled);
    runs_ = std::make_unique<StepRuns>(compiled, 23);
  }
  void started(scenario::Session& session) override { session.instance().setTaskWatch(runs_.get()); }
  void scanned(const scenario::Session&) override {}
  const Bounds& bounds() const { return bounds_; }
  const StepRuns& runs() const { return *runs_; }

private:
  Bounds bounds_;
  std::unique_ptr<StepRuns> runs_;
};

class Machine : public ::testing::TestWithParam<const char*> {};

TEST_P(Machine, TakesNoMoreThanTheBound) {
  Result<scenario::Scenario> scenario = scenario::readScenario(GetParam());
  ASSERT_TRUE(scenario.ok()) << scenario.error();
  StepMachine machine;
  std::unique_ptr<runtime::Engine> engine;
  scenario::RunOptions options{.engines = {EngineKind::Jit}, .engine = {}, .programs = {}, .started = {}};
  options.started = [&](scenario::Session& session, const compiler::Compiled& compiled) {
    engine = engineOf(EngineKind::Jit, compiled);
    machine.begin(compiled);
    session.addObserver(machine);
    return std::string();
  };
  const scenario::RunResult result = scenario::run(scenario.value(), options);
  ASSERT_TRUE(result.passed);
  uint32_t ran = 0;
  for (uint32_t t = 0; t < machine.bounds().tasks.size(); ++t) {
    const Counts& most = machine.runs().of(t);
    const TaskBound& bound = machine.bounds().tasks[t];
    expectWithin(most, bound);
    ran += most.instructions > 0 ? 1 : 0;
    if (most.instructions > 0)
      RecordProperty(bound.name, std::to_string(most.instructions) + " of " + std::to_string(*bound.instructions));
  }
  EXPECT_GT(ran, 0u);
}

INSTANTIATE_TEST_SUITE_P(Examples, Machine,
                         ::testing::Values("examples/fanuc-vmc/tool-change.scn", "examples/gsk-mill/tool-change.scn",
                                           "examples/nct-turning-centre/turret.scn",
                                           "examples/technol-machining-centre/tool-change.scn"));

} // namespace
} // namespace rung::report

#endif
