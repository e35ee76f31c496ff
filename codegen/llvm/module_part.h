// What goes into one LLVM module: a whole program, or a piece of one for the JIT. Free of LLVM.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "ir/shape/memory_members.h"

namespace rung::codegen {

using CacheKey = std::array<uint8_t, 32>; // SHA-256

struct ModulePart {
  uint32_t firstChunk = 0;
  uint32_t chunkCount = 0;
  // The module exports a table of its chunks' functions as kPieceTable, and beside it a PieceIdentity. Else it is the
  // whole program and exports rung_program_table.
  bool isPiece = false;
  CacheKey key{}; // of a piece
  // For debug information: all pieces need the same ones. Null: they are found for the module.
  std::shared_ptr<const std::vector<ir::MemoryMember>> members{};
};

inline constexpr char kPieceTable[] = "rung_chunks";
inline constexpr char kPieceIdentity[] = "rung_chunks_identity";

// What an object file says of itself.
struct PieceIdentity {
  CacheKey key;
  uint32_t chunkCount;
  bool operator==(const PieceIdentity&) const = default;
};
static_assert(sizeof(PieceIdentity) == 36);

} // namespace rung::codegen
