// The cut into pieces (see pieces.h).
#include "codegen/jit/pieces.h"

#include <fmt/format.h>

namespace rung::codegen {
namespace {

// Small enough that threads share the work, that memory stays flat and that the first piece is soon there; large enough
// that a piece's own cost vanishes.
constexpr uint32_t kOpsPerPiece = 8192;

uint32_t operationsOf(const ir::Layout& layout, const ir::Chunk& chunk) {
  const std::vector<ir::Rung>& rungs = layout.module().at(chunk.routine).rungs;
  uint32_t ops = 0;
  for (uint32_t i = 0; i < chunk.rungCount; ++i) ops += static_cast<uint32_t>(rungs[chunk.firstRung + i].ops.size());
  return ops;
}

} // namespace

std::vector<ModulePart> cutPieces(const ir::Layout& layout, std::span<const uint32_t> chunks) {
  std::vector<ModulePart> pieces;
  uint32_t ops = 0;
  for (const uint32_t chunk : chunks) {
    const bool follows = !pieces.empty() && pieces.back().firstChunk + pieces.back().chunkCount == chunk;
    if (ops >= kOpsPerPiece || !follows) {
      pieces.push_back({.firstChunk = chunk, .tableName = fmt::format("rung_chunks_{}", chunk)});
      ops = 0;
    }
    ++pieces.back().chunkCount;
    ops += operationsOf(layout, layout.chunks()[chunk]);
  }
  return pieces;
}

} // namespace rung::codegen
