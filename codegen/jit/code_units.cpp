// From chunks to code units, and from a unit to an object file (see code_units.h).
#include "codegen/jit/code_units.h"

#include "ir/shape/partition.h"

namespace rung::codegen {

using namespace ir;

namespace {

// Small enough that threads get equal amounts of work even from a program of some hundred rungs, that memory use stays
// low and that the first unit is ready soon; large enough that the fixed cost of a unit is small.
constexpr uint32_t kOpsPerUnit = 2048;

// Whether a unit that is half full may end before the next chunk: decided by the key of the chunk's first rung, so that
// after an insertion above, units soon end at the same places again.
bool maybeEnds(const Module& module, const Chunk& next) {
  return module.at(next.routine).rungs[next.firstRung].key % 2 == 0;
}

uint32_t operationsOf(const Module& module, const Chunk& chunk) {
  const std::vector<Rung>& rungs = module.at(chunk.routine).rungs;
  uint32_t ops = 0;
  for (uint32_t i = 0; i < chunk.rungCount; ++i) ops += static_cast<uint32_t>(rungs[chunk.firstRung + i].ops.size());
  return ops;
}

} // namespace

std::vector<ModulePart> partitionIntoUnits(const Partition& partition, std::span<const uint32_t> chunks) {
  std::vector<ModulePart> units;
  uint32_t ops = 0;
  for (const uint32_t chunk : chunks) {
    const bool follows = !units.empty() && units.back().firstChunk + units.back().chunkCount == chunk;
    const bool ends = ops >= kOpsPerUnit / 2 && maybeEnds(partition.module(), partition.chunks()[chunk]);
    if (ops >= kOpsPerUnit || ends || !follows) {
      units.push_back({.firstChunk = chunk, .isUnit = true});
      ops = 0;
    }
    ++units.back().chunkCount;
    ops += operationsOf(partition.module(), partition.chunks()[chunk]);
  }
  return units;
}

Result<std::string> compileUnit(const Layout& layout, uint64_t codeHash, const LlvmOptions& options,
                                const ModulePart& unit, std::unique_ptr<llvm::FunctionPass> reader) {
  Result<std::unique_ptr<llvm::TargetMachine>> machine = makeTargetMachine(options, MachineUse::Jit);
  if (!machine.ok()) return machine.failure();
  llvm::LLVMContext context;
  context.setDiscardValueNames(true);
  Result<std::unique_ptr<llvm::Module>> module =
      buildModule(context, *machine.value(), layout, codeHash, options, unit);
  if (!module.ok()) return module.failure();
  runPasses(*module.value(), *machine.value(), options.level);
  return generateCode(*module.value(), *machine.value(), llvm::CodeGenFileType::ObjectFile, std::move(reader));
}

} // namespace rung::codegen
