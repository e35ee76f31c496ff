// From chunks to pieces, and from a piece to an object file (see pieces.h).
#include "codegen/jit/pieces.h"

#include "ir/shape/cut.h"

namespace rung::codegen {

using namespace ir;

namespace {

// Small enough that threads have the same amount of work, also of a program of some hundred rungs, that memory stays
// flat and that the first piece is soon there; large enough that a piece's own cost is small beside it.
constexpr uint32_t kOpsPerPiece = 2048;

// Where a piece may end when it is half full: by what the next chunk begins with, so that where rungs are inserted
// above the pieces are soon cut at the same places again.
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

std::vector<ModulePart> cutPieces(const Cut& cut, std::span<const uint32_t> chunks) {
  std::vector<ModulePart> pieces;
  uint32_t ops = 0;
  for (const uint32_t chunk : chunks) {
    const bool follows = !pieces.empty() && pieces.back().firstChunk + pieces.back().chunkCount == chunk;
    const bool ends = ops >= kOpsPerPiece / 2 && maybeEnds(cut.module(), cut.chunks()[chunk]);
    if (ops >= kOpsPerPiece || ends || !follows) {
      pieces.push_back({.firstChunk = chunk, .isPiece = true});
      ops = 0;
    }
    ++pieces.back().chunkCount;
    ops += operationsOf(cut.module(), cut.chunks()[chunk]);
  }
  return pieces;
}

Result<std::string> compilePiece(const Layout& layout, uint64_t codeHash, const LlvmOptions& options,
                                 const ModulePart& piece, std::unique_ptr<llvm::FunctionPass> reader) {
  Result<std::unique_ptr<llvm::TargetMachine>> machine = makeTargetMachine(options, MachineUse::Jit);
  if (!machine.ok()) return machine.failure();
  llvm::LLVMContext context;
  context.setDiscardValueNames(true);
  Result<std::unique_ptr<llvm::Module>> module =
      buildModule(context, *machine.value(), layout, codeHash, options, piece);
  if (!module.ok()) return module.failure();
  runPasses(*module.value(), *machine.value(), options.level);
  return generateCode(*module.value(), *machine.value(), llvm::CodeGenFileType::ObjectFile, std::move(reader));
}

} // namespace rung::codegen
