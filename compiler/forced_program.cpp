// See forced_program.h.
#include "compiler/forced_program.h"

#include <algorithm>

#include "ir/shape/cut.h"
#include "ir/transforms/force.h"
#include "ir/transforms/pipeline.h"

namespace rung::compiler {
namespace {

bool sameCode(const ir::Rung& a, const ir::Rung& b) {
  return a.ops == b.ops && a.args == b.args && a.transfer == b.transfer;
}

ir::Module changed(const Compiled& source, std::span<const rung_forced_byte> forced) {
  ir::Module module = *source.built;
  ir::forceBits(module, forced);
  ir::runPasses(module, source.passes);
  return module;
}

} // namespace

ForcedProgram::ForcedProgram(const Compiled& source, std::span<const rung_forced_byte> forced)
    : module(changed(source, forced)), layout(source.layout->over(module)) {}

std::vector<uint32_t> ForcedProgram::chunksUnlike(const ir::Module& other) const {
  std::vector<uint32_t> unlike;
  for (uint32_t i = 0; i < layout.cut().chunks().size(); ++i) {
    const ir::Chunk& chunk = layout.cut().chunks()[i];
    const auto here = module.at(chunk.routine).rungs.begin() + chunk.firstRung;
    const auto there = other.at(chunk.routine).rungs.begin() + chunk.firstRung;
    if (!std::equal(here, here + chunk.rungCount, there, sameCode)) unlike.push_back(i);
  }
  return unlike;
}

} // namespace rung::compiler
