// How operations access the memory that operands name: cells and bits, possibly with the index register BX.
#pragma once
#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/lower/emitter.h"

namespace rung::frontend::technol {

// A place in memory as an operation accesses it: fixed, or by a checked index.
struct MemoryAccess {
  ir::Place place;
  bool indexed = false;
  ir::Window window;
  ir::ValueId index;
};

// The program's memory, for operations in the emitter's open rung.
class Memory {
public:
  Memory(const Declarations& declarations, Emitter& emitter) : declarations_(declarations), emitter_(emitter) {}

  Emitter& emitter() { return emitter_; }
  uint32_t bytesOf(ir::SpaceId space) const { return declarations_.bytesOf(space); }

  // The place of a cell or bit; an index outside of its space stops the program (if there is a `guard`, only if that is
  // 1).
  MemoryAccess reach(const Operand& operand, ir::ValueId guard = {});
  ir::ValueId load(const MemoryAccess& access, ir::Type type);
  void store(const MemoryAccess& access, ir::ValueId value);
  // A bit, negated if it has a sign.
  ir::ValueId bit(const Operand& operand);
  // The size of a space in bytes.
  ir::ValueId sizeOf(ir::SpaceId space) { return emitter_.given(ir::Type::I32, bytesOf(space)); }
  // A place in the space of the operand's variable, as a number.
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

// State of instructions: slots that the compiler makes, and cells in which they count.

// A memory cell in which an instruction counts: one that the program names, or one that the compiler makes.
struct CountCell {
  bool automatic = false;
  ir::SlotId slot;
  MemoryAccess access;
  ir::Type type = ir::Type::I16;
};

// The key of an instruction's state, by which it is found in a changed program: its text with its operands.
std::string instructionKey(const SourceProgram& program, const Statement& statement, std::string_view mnemonic);

class State {
public:
  State(const SourceProgram& program, Memory& memory)
      : program_(program), memory_(memory), emitter_(memory.emitter()) {}

  // State of one statement only, e.g. the former value of an edge; `what` names it.
  ir::SlotId newSlot(ir::Type type, const Statement& statement, std::string_view what);
  // Names cells of an allocated space, so that they are found again in a changed program.
  void nameCells(std::string key, ir::Place place, ir::Type type, uint32_t count = 1) {
    frontend::nameCells(emitter_.module(), names_.numbered(std::move(key)), place, type, count);
  }
  CountCell countCell(const Operand& operand, const Statement& statement);
  ir::ValueId load(const CountCell& cell);
  void store(const CountCell& cell, ir::ValueId value);
  // A slot that counts time, which CLEAR GLOBAL sets to 0.
  void addTimer(ir::SlotId slot) { timers_.push_back(slot); }
  // A slot of EDGE, which is reset at every start.
  void forgetAtStart(ir::SlotId slot) { forgotten_.push_back(slot); }

  std::span<const ir::SlotId> automatic() const { return automatic_; }
  std::span<const ir::SlotId> timers() const { return timers_; }
  std::span<const ir::SlotId> forgotten() const { return forgotten_; }

private:
  const SourceProgram& program_;
  Memory& memory_;
  Emitter& emitter_;
  Numbering names_;
  std::vector<ir::SlotId> automatic_; // made for single instructions
  std::vector<ir::SlotId> timers_;
  std::vector<ir::SlotId> forgotten_;
};

} // namespace rung::frontend::technol
