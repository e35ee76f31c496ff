// The context of a row's lowering function: the current statement, the emitter, the program's memory, and the parts
// that statements share.
#pragma once
#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/lower/emitter.h"
#include "frontend/dialects/technol/lower/system_routines.h"
#include "ir/core/marks.h"

namespace rung::frontend::technol {

// Records, for coverage, which values of a rung are contacts and which is the power into a coil.

class Marking {
public:
  // `marks` may be null: marks are not requested.
  Marking(const SourceProgram& program, Emitter& emitter, ir::Marks* marks)
      : program_(program), emitter_(emitter), marks_(marks) {}

  // A bit that LDR, LA, LO or LX reads.
  void contact(const Statement& statement, ir::ValueId value) { note(ir::MarkKind::Contact, statement, value); }
  // An instruction that depends on RLO is decided by the equation.
  void decision(const Statement& statement);
  // RLO of a comparison, an edge or a timer that ran in `rung`, if that rung is still open: contacts are marked
  // separately.
  void result(const Statement& statement, uint32_t rung);

private:
  void note(ir::MarkKind kind, const Statement& statement, ir::ValueId value);

  const SourceProgram& program_;
  Emitter& emitter_;
  ir::Marks* marks_;
};

class Lowering {
public:
  Lowering(const TypedProgram& typed, ir::Module& module, ir::Marks* marks, ir::GivenNumbers* given)
      : program(typed), emitter(module, given), memory(program.declarations, emitter), state(program.source, memory),
        sequences(program.source, emitter, state), procedures(program.source, emitter),
        clears(program, memory, state, sequences), bitMessages(program.source, memory, state),
        marking(program.source, emitter, marks), labels_(program.source.labels.size(), kNone) {}

  // Begins the next statement.
  void enter(const Statement& statement, const Typed& typed);
  // Executes its effect on the stack; afterwards `popped` is the value that LA, LO, LX without operand took off it.
  void useStack();

  const Statement& statement() const { return *statement_; }
  std::string_view mnemonic() const { return statement_->row->info.mnemonic; }
  ir::ValueId popped() const { return popped_; }
  // The label in the routine for a label of the program, an index in SourceProgram::labels.
  uint32_t labelOf(uint32_t label);
  uint32_t jumpTarget(const Operand& label) { return labelOf(label.index); }
  // The condition of a statement with this `variant`: always (an invalid value), or by RLO.
  ir::ValueId guardOf(int condition);
  // The bit that LDR, LA, LO and LX read.
  ir::ValueId contact(const Operand& operand);
  // State of this statement only.
  ir::SlotId ownSlot(ir::Type type) { return state.newSlot(type, *statement_, mnemonic()); }
  CountCell countCell(const Operand& operand) { return state.countCell(operand, *statement_); }
  // The statement as a timer that counts its runs up to a value of the open rung, for displays. One whose cell is
  // computed is left out; of statements that share a cell it is not known which one runs.
  void addTimer(const CountCell& cell, ir::ValueId preset);
  void callProcedure(uint32_t procedure, ir::ValueId cond = {}) {
    procedures.call(procedure, typed_->stack.depth, cond);
  }

  // The open rung and its registers.
  ir::RungBuilder& b() { return emitter.b(); }
  Registers& r() { return emitter.r(); }

  const TypedProgram& program;
  Emitter emitter;
  Memory memory;
  State state;
  Sequences sequences;
  Procedures procedures;
  Clears clears;
  BitMessages bitMessages;
  Marking marking;

private:
  const Statement* statement_ = nullptr;
  const Typed* typed_ = nullptr;
  ir::ValueId popped_;
  std::vector<uint32_t> labels_; // by label of the program
};

} // namespace rung::frontend::technol
