// What goes into one LLVM module: a whole program, or a piece of one for the JIT. Free of LLVM.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ir/layout/memory_members.h"

namespace rung::codegen {

using CacheKey = std::array<uint8_t, 32>; // SHA-256

struct ModulePart {
  uint32_t firstChunk = 0;
  uint32_t chunkCount = 0;
  // Not empty: the module exports a table of its chunks' functions under this name, and beside it, under identityName,
  // a PieceIdentity. Empty: it is the whole program and exports rung_program_v1.
  std::string tableName{};
  CacheKey key{}; // of a piece
  // For debug information: all pieces need the same ones. Null: they are found for the module.
  std::shared_ptr<const std::vector<ir::MemoryMember>> members{};

  std::string identityName() const { return tableName + "_identity"; }
};

// What an object file says of itself. The chunks of the program that `key` names begin at `firstChunk`.
struct PieceIdentity {
  CacheKey key;
  uint32_t firstChunk;
  uint32_t chunkCount;
  bool operator==(const PieceIdentity&) const = default;
};
static_assert(sizeof(PieceIdentity) == 40);

} // namespace rung::codegen
