// The engines against the interpreter, which is the definition: every operation with boundary values, random modules,
// and proof that the comparison would notice: an emitter that is wrong for one operation is caught, operation by
// operation.
#include <gtest/gtest.h>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/transforms/pipeline.h"
#include "tests/random/random.h"
#include "tests/support/differential.h"
#include "tests/support/long_run.h"
#include "tests/support/saboteur.h"

namespace rung {
namespace {

using compiler::EngineKind;
using compiler::EngineOptions;
using ir::OpCode;

constexpr int kScans = 4;

struct Variant {
  EngineKind kind;
  bool optimise;
  const char* compiler;
  const char* name;
};
constexpr Variant kVariants[] = {
    {EngineKind::Cpp, false, "clang++-19 -fsanitize=undefined -fno-sanitize=alignment -fsanitize-trap=all",
     "CppO0Ubsan"},
    {EngineKind::Cpp, true, "g++", "CppGcc"},
    {EngineKind::Jit, false, "", "JitFast"},
    {EngineKind::Jit, true, "", "JitOpt"},
    {EngineKind::Llvm, true, "", "LlvmSo"},
};

// Between the interpreter with one program and an engine with another.
std::optional<std::string> disagreement(const compiler::Compiled& forInterpreter, const compiler::Compiled& forEngine,
                                        const Variant& variant, bool debugger = false) {
  EngineOptions options;
  options.debugger = debugger;
  options.optimise = variant.optimise;
  options.cppCompiler = variant.compiler;
  auto reference = compiler::makeEngine(EngineKind::Interp, forInterpreter, {});
  auto engine = compiler::makeEngine(variant.kind, forEngine, options);
  if (!reference.ok() || !engine.ok()) {
    ADD_FAILURE() << (reference.ok() ? engine.error() : reference.error());
    return std::nullopt;
  }
  return testing::firstDisagreement(*reference.value(), *engine.value(), kScans);
}

std::optional<std::string> disagreement(const compiler::Compiled& compiled, const Variant& variant,
                                        bool debugger = false) {
  return disagreement(compiled, compiled, variant, debugger);
}

// What an emitter that is wrong for one operation would make of the program, as a program.
compiler::Compiled sabotaged(const compiler::Compiled& right, OpCode code) {
  compiler::Compiled out;
  out.module = std::make_unique<ir::Module>(*right.module);
  ir::sabotage(*out.module, code);
  out.layout = std::make_unique<ir::Layout>(right.layout->over(*out.module));
  out.codeHash = right.codeHash;
  return out;
}

class EveryOp : public ::testing::TestWithParam<Variant> {};

TEST_P(EveryOp, AgreesWithTheInterpreter) {
  for (const ir::OpInfo& info : ir::allOps()) {
    const auto difference = disagreement(testing::compiledFrom(ir::moduleForOp(info.code)), GetParam());
    EXPECT_FALSE(difference) << info.name << ": " << *difference;
  }
}

// What the tests above are worth: a wrong emitter does not pass them.
TEST_P(EveryOp, AWrongEmitterIsCaught) {
  for (const ir::OpInfo& info : ir::allOps()) {
    if (info.code == OpCode::Note) continue; // a remark for readers does nothing that could be wrong
    // A program of a compiler for each: some are enough to see that this engine is compared at all.
    if (GetParam().kind == EngineKind::Cpp && !testing::longRun() && static_cast<int>(info.code) % 8 != 0) continue;
    const compiler::Compiled right = testing::compiledFrom(ir::moduleForOp(info.code));
    const auto difference = disagreement(right, sabotaged(right, info.code), GetParam());
    EXPECT_TRUE(difference) << info.name << " is emitted wrongly, and nothing was noticed";
  }
}

class RandomModules : public ::testing::TestWithParam<Variant> {};

TEST_P(RandomModules, AgreeWithTheInterpreter) {
  const uint64_t seeds = GetParam().kind == EngineKind::Jit ? testing::howMany(40, 150) : testing::howMany(4, 12);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    ir::Module module = ir::randomModule(seed);
    if (seed % 2 == 0) ir::runPasses(module, {});
    ir::LayoutOptions layout;
    layout.expandBits = seed % 3 != 0;
    layout.partition.maxChunkRungs = seed % 5 == 0 ? 1 : 32;
    if (seed % 4 == 0) // a watchdog that strikes: every engine counts alike
      for (ir::Task& task : module.tasks) task.budget = 20 + static_cast<uint32_t>(seed % 50);
    const bool debugger = seed % 3 == 1;
    const auto difference = disagreement(testing::compiledFrom(std::move(module), layout), GetParam(), debugger);
    EXPECT_FALSE(difference) << "seed " << seed << ": " << *difference;
  }
}

// g++ takes longer for an operation than all others together.
std::vector<Variant> variantsOfOperations() {
  std::vector<Variant> variants(std::begin(kVariants), std::end(kVariants));
  if (!testing::longRun())
    std::erase_if(variants, [](const Variant& variant) { return variant.name == std::string_view("CppGcc"); });
  return variants;
}

const auto kVariantName = [](const ::testing::TestParamInfo<Variant>& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Engines, EveryOp, ::testing::ValuesIn(variantsOfOperations()), kVariantName);
INSTANTIATE_TEST_SUITE_P(Engines, RandomModules, ::testing::ValuesIn(kVariants), kVariantName);

} // namespace
} // namespace rung
