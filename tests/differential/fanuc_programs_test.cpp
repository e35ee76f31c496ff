// Random programs of the FANUC dialect on the engines, against the interpreter.
#include <random>
#include <span>

#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "ir/support/diag_render.h"
#include "tests/support/differential.h"
#include "tests/support/long_run.h"
#include "tests/unit/fanuc/program_generator.h"

namespace rung {
namespace {

using compiler::EngineKind;

struct Variant {
  EngineKind kind;
  bool optimise;
  const char* name;
};

// Bytes at random in all memory that programs name.
void scatter(runtime::Instance& instance, uint64_t seed) {
  std::mt19937_64 random(seed);
  const rung_program& program = instance.program();
  for (const rung_space& space : std::span(program.spaces, program.space_count)) {
    if ((space.flags & RUNG_SPACE_HIDDEN) != 0) continue;
    for (const rung_range& range : std::span(space.ranges, space.range_count)) {
      const bool bits = range.repr == RUNG_REPR_BYTE_PER_BIT;
      for (uint32_t i = 0; i < range.byte_count * (bits ? 8 : 1); ++i)
        instance.block()[range.offset + i] = static_cast<uint8_t>(random() % (bits ? 2 : 256));
    }
  }
}

class FanucPrograms : public ::testing::TestWithParam<Variant> {};

TEST_P(FanucPrograms, AgreeWithTheInterpreter) {
  constexpr int kScans = 6;
  const uint64_t seeds = GetParam().kind == EngineKind::Jit ? testing::howMany(20, 200) : testing::howMany(2, 20);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    SourceManager sources;
    Diagnostics diagnostics;
    const FileId file = sources.addBuffer("drawn.mne", frontend::fanuc::test::ProgramGenerator(seed).list());
    const auto compiled = compiler::compile(sources, {&file, 1}, {}, diagnostics);
    ASSERT_TRUE(compiled) << renderText(diagnostics, sources) << sources.text(file);
    compiler::EngineOptions options;
    options.optimise = GetParam().optimise;
    const auto reference = compiler::makeEngine(EngineKind::Interp, *compiled, {});
    const auto engine = compiler::makeEngine(GetParam().kind, *compiled, options);
    ASSERT_TRUE(reference.ok() && engine.ok());
    const auto difference = testing::firstDisagreement(
        *reference.value(), *engine.value(), kScans, [&](runtime::Instance& instance, int scan) {
          if (scan % 2 == 1) scatter(instance, seed * kScans + static_cast<uint64_t>(scan));
        });
    EXPECT_FALSE(difference) << *difference << "\n" << sources.text(file);
  }
}

constexpr Variant kVariants[] = {{EngineKind::Jit, false, "JitFast"},
                                 {EngineKind::Jit, true, "JitOpt"},
                                 {EngineKind::Cpp, true, "Cpp"},
                                 {EngineKind::Llvm, true, "LlvmSo"}};
INSTANTIATE_TEST_SUITE_P(Engines, FanucPrograms, ::testing::ValuesIn(kVariants),
                         [](const auto& tested) { return std::string(tested.param.name); });

} // namespace
} // namespace rung
