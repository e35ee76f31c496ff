// Lowers the bodies of a module to routines: one rung of the source is one rung of the IR, followed by a helper rung
// for each further jump, call or return in it.
#pragma once
#include <unordered_map>

#include "frontend/dialects/nct/lower/memory.h"
#include "frontend/dialects/nct/program.h"
#include "ir/core/marks.h"
#include "ir/core/module.h"

namespace rung::frontend::nct {

// Shared by all modules of a program during lowering.
struct LoweringContext {
  ir::Module& module;
  const Config& config;
  const MemorySpaces& spaces;
  WrittenRange& written;
  const SourceManager& sources;
  ir::Marks* marks = nullptr;                          // null: not requested
  ir::GivenNumbers* given = nullptr;                   // null: not compared with another version
  std::unordered_map<uint32_t, ir::FileIndex> files{}; // by FileId
  std::unordered_map<uint64_t, uint32_t> sameText{};   // rungs with equal texts so far, for their keys
};

// Adds the routines of the module; the first one is the entry.
ir::RoutineId lowerModule(LoweringContext& context, const TypedModule& module);

} // namespace rung::frontend::nct
