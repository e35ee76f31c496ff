// See optimised_code.h.
#include "tests/differential/optimised_code.h"

#include <utility>

namespace rung::testing {

using compiler::EngineKind;
using namespace ir;

Module oneTask(std::string name) {
  Module m;
  m.name = std::move(name);
  m.dialect = "none";
  m.faults.emplace_back("watchdog");
  m.routines.push_back({.name = "MAIN", .rungs = {}});
  m.tasks.push_back(
      {.name = "MAIN", .entry = {0}, .periodUs = 1000, .budgetFault = {0}, .begin = {}, .end = {}, .borders = {}});
  m.mainTask = {0};
  m.scan.push_back({.op = RUNG_STEP_RUN, .task = {0}, .arg = 1});
  return m;
}

ValueId nextNumber(RungBuilder& b, Place state) {
  const ValueId next = b.add(b.mul(b.load(Type::I32, state), b.i32(1664525)), b.i32(1013904223));
  b.store(state, next);
  return next;
}

void expectLikeInterpreter(const compiler::Compiled& program, EngineKind kind, uint64_t seed, int scans) {
  auto reference = compiler::makeEngine(EngineKind::Interp, program, {});
  auto engine = compiler::makeEngine(kind, program, {.optimise = true});
  ASSERT_TRUE(reference.ok() && engine.ok());
  const auto difference = firstDisagreement(*reference.value(), *engine.value(), scans);
  EXPECT_FALSE(difference) << "seed " << seed << ": " << *difference;
}

std::string engineName(const ::testing::TestParamInfo<EngineKind>& test) {
  if (test.param == EngineKind::Jit) return "Jit";
  return test.param == EngineKind::Cpp ? "Cpp" : "LlvmSo";
}

} // namespace rung::testing
