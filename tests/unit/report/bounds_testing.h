// What the tests of bounds have in common.
#pragma once
#include <gtest/gtest.h>

#include "compiler/engines.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"
#include "tests/random/random_source.h"
#include "tests/support/differential.h"
#include "tools/report/wcet_bounds.h"

namespace rung::report {

inline std::unique_ptr<runtime::Engine> engineOf(compiler::EngineKind kind, const compiler::Compiled& compiled,
                                                 const compiler::EngineOptions& options = {}) {
  Result<std::unique_ptr<runtime::Engine>> engine = compiler::makeEngine(kind, compiled, options);
  if (engine.ok()) return std::move(engine).value();
  ADD_FAILURE() << engine.error();
  return nullptr;
}

// Any contents of the spaces that the representation allows.
inline void scatter(runtime::Instance& instance, ir::RandomSource& random) {
  const rung_program& program = instance.program();
  for (const rung_space& space : std::span(program.spaces, program.space_count))
    for (const rung_range& range : std::span(space.ranges, space.range_count)) {
      const bool bits = range.repr == RUNG_REPR_BYTE_PER_BIT;
      for (uint32_t i = 0; i < range.byte_count * (bits ? 8 : 1); ++i)
        instance.block()[range.offset + i] = static_cast<uint8_t>(bits ? random.below(2) : random.below(256));
    }
}

inline compiler::Compiled randomProgram(uint64_t seed, const ir::RandomOptions& options) {
  ir::Module module = ir::randomModule(seed, options);
  for (ir::Routine& routine : module.routines)
    for (size_t i = 0; i < routine.rungs.size(); ++i) routine.rungs[i].weight = 1 + static_cast<uint32_t>(i * 5 % 4);
  return testing::compiledFrom(std::move(module), {.partition = {.maxChunkRungs = 4}});
}

} // namespace rung::report
