// Machine code that is found in the cache for rungs that have moved: it goes to the right chunks, and tells the host
// the right rungs and lines.
#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

#include <fmt/format.h>

#include "codegen/jit/jit_engine.h"
#include "ir/core/builder.h"
#include "tests/random/random.h"
#include "tests/support/differential.h"

namespace rung {
namespace {

using namespace ir;
namespace fs = std::filesystem;

constexpr RandomOptions kOptions{.routines = 5, .rungs = 60, .ops = 40};

void setLines(Module& module) {
  if (module.files.empty()) module.files.emplace_back("moved.lad");
  for (uint32_t line = 1; Routine & routine : module.routines)
    for (Rung& rung : routine.rungs) rung.begin = {FileIndex{0}, line++, 1};
}

// Rungs at the head of the first routine that do nothing.
void insertAbove(Module& module, uint32_t count) {
  std::vector<Rung>& rungs = module.routines[0].rungs;
  for (Rung& rung : rungs) {
    if (rung.transfer.kind == TransferKind::Goto) rung.transfer.target += count;
    for (uint32_t& target : rung.transfer.targets) target += count;
  }
  rungs.insert(rungs.begin(), count, Rung{});
  for (Task& task : module.tasks)
    if (task.entry.index == 0)
      for (uint32_t& border : task.borders) border += count;
}

class MovedCode : public ::testing::Test {
protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  // Units that were in the cache, of how many.
  std::pair<uint32_t, uint32_t> compare(const Module& module, uint64_t seed) {
    const compiler::Compiled program = testing::compiledFrom(module, {.partition = {.maxChunkRungs = 12}});
    auto reference = compiler::makeEngine(compiler::EngineKind::Interp, program, {});
    auto engine = codegen::compileJit(*program.layout, 1,
                                      {.code = {.debugInfo = false, .target = {}}, .cacheFolder = folder_.string()});
    if (!reference.ok() || !engine.ok()) {
      ADD_FAILURE() << engine.error();
      return {};
    }
    const auto difference = testing::firstDisagreement(*reference.value(), *engine.value(), 12);
    EXPECT_FALSE(difference) << "seed " << seed << ": " << *difference;
    return {engine.value()->report().fromCache, engine.value()->report().modules};
  }

  fs::path folder_ = fs::path(::testing::TempDir()) / fmt::format("rung-moved-{}", getpid());
};

TEST_F(MovedCode, DoesWhatTheInterpreterDoes) {
  uint32_t found = 0;
  uint32_t units = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Module module = randomModule(seed, kOptions);
    setLines(module);
    EXPECT_EQ(compare(module, seed).first, 0U);
    insertAbove(module, 1 + static_cast<uint32_t>(seed % 3));
    setLines(module);
    const auto [taken, of] = compare(module, seed);
    found += taken;
    units += of;
  }
  EXPECT_GT(found, units / 2);
}

} // namespace
} // namespace rung
