// What tests of optimised code share: a program of one task, drawn inputs, and the comparison with the interpreter.
#pragma once
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "ir/core/builder.h"
#include "tests/support/differential.h"

namespace rung::testing {

// A scan runs the routine MAIN once, which has no rungs yet; there are no spaces.
ir::Module oneTask(std::string name);

// Another number in each scan, which the i32 at `state` keeps.
ir::ValueId nextNumber(ir::RungBuilder& b, ir::Place state);

// Of the engines that optimise: so many scans end as those of the interpreter do. `seed` is what the program was drawn
// from.
void expectLikeInterpreter(const compiler::Compiled& program, compiler::EngineKind kind, uint64_t seed, int scans);

// For INSTANTIATE_TEST_SUITE_P.
inline auto optimisingEngines() {
  using compiler::EngineKind;
  return ::testing::Values(EngineKind::Jit, EngineKind::Cpp, EngineKind::Llvm);
}
std::string engineName(const ::testing::TestParamInfo<compiler::EngineKind>& test);

} // namespace rung::testing
