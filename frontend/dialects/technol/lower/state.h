// State that instructions keep between their runs: slots that the compiler makes, and cells that they count in.
#pragma once

#include "frontend/dialects/technol/lower/memory.h"

namespace rung::frontend::technol {

// A memory cell that an instruction counts in: written by the program, or made by the compiler.
struct CountCell {
  bool automatic = false;
  ir::SlotId slot;
  MemoryAccess access;
  ir::Type type = ir::Type::I16;
};

// An instruction with its operands: what its state is known by in a changed program.
std::string instructionKey(const SourceProgram& program, const Statement& statement, std::string_view mnemonic);

class State {
public:
  State(const SourceProgram& program, Memory& memory)
      : program_(program), memory_(memory), emitter_(memory.emitter()) {}

  // State of a statement alone, e.g. the former value of an edge; `what` names it.
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
  // Of EDGE: forgotten at every start.
  void forgetAtStart(ir::SlotId slot) { forgotten_.push_back(slot); }

  std::span<const ir::SlotId> automatic() const { return automatic_; }
  std::span<const ir::SlotId> timers() const { return timers_; }
  std::span<const ir::SlotId> forgotten() const { return forgotten_; }

private:
  const SourceProgram& program_;
  Memory& memory_;
  Emitter& emitter_;
  Numbering names_;
  std::vector<ir::SlotId> automatic_; // that instructions made for themselves
  std::vector<ir::SlotId> timers_;
  std::vector<ir::SlotId> forgotten_;
};

} // namespace rung::frontend::technol
