// How operations reach the memory that operands name: cells and bits, also by the index register BX.
#pragma once

#include "frontend/dialects/technol/check/operand.h"
#include "frontend/dialects/technol/lower/emitter.h"

namespace rung::frontend::technol {

// A place in memory as an operation reaches it: fixed, or by a checked index.
struct MemoryAccess {
  ir::Place place;
  bool indexed = false;
  ir::Window window;
  ir::ValueId index;
};

// The program's memory, as operations of the emitter's open rung reach it.
class Memory {
public:
  Memory(const Declarations& declarations, Emitter& emitter) : declarations_(declarations), emitter_(emitter) {}

  Emitter& emitter() { return emitter_; }
  uint32_t bytesOf(ir::SpaceId space) const { return declarations_.bytesOf(space); }

  // Where a cell or bit lies; an index outside its space stops the program (where `guard` is 1, if there is one).
  MemoryAccess reach(const Operand& operand, ir::ValueId guard = {});
  ir::ValueId load(const MemoryAccess& access, ir::Type type);
  void store(const MemoryAccess& access, ir::ValueId value);
  // A bit with its sign.
  ir::ValueId bit(const Operand& operand);
  // The bytes of a space.
  ir::ValueId sizeOf(ir::SpaceId space) { return emitter_.given(ir::Type::I32, bytesOf(space)); }
  // A place of the space that the operand's variable lies in, as a number.
  ir::ValueId placeIn(const Operand& operand, int64_t byte) {
    const ir::Place begin{.space = operand.place.space, .byte = static_cast<uint32_t>(operand.begin)};
    return emitter_.address(ir::Type::I32, byte, begin, byte - operand.begin);
  }
  // A constant or a cell; `guard` as for reach.
  ir::ValueId value(const Operand& operand, ir::ValueId guard = {});

private:
  const Declarations& declarations_;
  Emitter& emitter_;
};

} // namespace rung::frontend::technol
