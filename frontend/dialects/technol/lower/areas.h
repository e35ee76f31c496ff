// Memory areas of instructions that move bytes (man. ch. 3.15, 3.18): loops with bounds known at compile time.
#pragma once

#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

// A rung has a limited number of iterations; longer work gets a separate rung.
inline constexpr uint32_t kManyPasses = 4096;
inline constexpr uint32_t kMostCleared = 1u << 20; // bytes in one rung
// Iterations that are skipped together if the work ends early.
inline constexpr uint32_t kBlock = 32;

// Bytes of a space from `at` on; if `fixed`, from the constant `first`.
struct Area {
  ir::SpaceId space;
  uint32_t bytes = 0; // of the whole space
  bool fixed = true;
  uint32_t first = 0;
  ir::ValueId at;
};

// A number of bytes: a constant, or a value of at most `most`.
struct Length {
  bool fixed = true;
  uint32_t most = 0;
  ir::ValueId value;
};

Area fixedArea(Emitter& emitter, ir::SpaceId space, uint32_t bytes, uint32_t first);
Area areaAt(Memory& memory, const MemoryAccess& access);
Area areaOf(Memory& memory, const Operand& operand);
// The area without its first `by` bytes.
Area shifted(ir::RungBuilder& b, Area area, ir::ValueId by);
Length fixedCount(ir::RungBuilder& b, uint32_t count);
Length countOf(Memory& memory, const Operand& operand);
Length smaller(ir::RungBuilder& b, const Length& x, const Length& y);

ir::ValueId loadByte(ir::RungBuilder& b, const Area& area, ir::ValueId i, ir::Type type = ir::Type::I8);
void storeByte(ir::RungBuilder& b, const Area& area, ir::ValueId i, ir::ValueId value);
// Copies as if the whole source were read first. The caller has checked both areas.
void copy(Emitter& emitter, const Area& to, const Area& from, const Length& count);
void clear(ir::RungBuilder& b, const Area& area, const Length& count);
// Clears from `first` up to `end`, in separate rungs.
void clearRange(Memory& memory, ir::SpaceId space, uint32_t first, uint32_t end);
// The part of `count` bytes that is within the space. If area or count are not constant, the program stops unless all
// are.
Length inside(Emitter& emitter, const Area& area, const Length& count);

} // namespace rung::frontend::technol
