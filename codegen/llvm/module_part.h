// The contents of one LLVM module: a whole program, or a code unit for the JIT. Does not include LLVM.
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
  // The module exports a table of its chunks' functions as kCodeUnitTable, and a CodeUnitIdentity. Otherwise it is the
  // whole program and exports rung_program_table.
  bool isUnit = false;
  CacheKey key{}; // of a unit
  // For debug information; the same for all units. Null: computed for the module.
  std::shared_ptr<const std::vector<ir::MemoryMember>> members{};
};

inline constexpr char kCodeUnitTable[] = "rung_chunks";
inline constexpr char kCodeUnitIdentity[] = "rung_chunks_identity";

// The identity of a code unit in its object file.
struct CodeUnitIdentity {
  CacheKey key;
  uint32_t chunkCount;
  bool operator==(const CodeUnitIdentity&) const = default;
};
static_assert(sizeof(CodeUnitIdentity) == 36);

} // namespace rung::codegen
