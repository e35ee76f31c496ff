// Notes, for coverage, which values of a rung are contacts and which is the power into a coil.
#pragma once

#include "frontend/dialects/technol/lower/emitter.h"
#include "ir/core/marks.h"

namespace rung::frontend::technol {

class Marking {
public:
  // `marks` may be null: not wanted.
  Marking(const SourceProgram& program, Emitter& emitter, ir::Marks* marks)
      : program_(program), emitter_(emitter), marks_(marks) {}

  // A bit that LDR, LA, LO or LX asks.
  void contact(const Statement& statement, ir::ValueId value) { note(ir::MarkKind::Contact, statement, value); }
  // What an instruction does by RLO is what the equation decides.
  void decision(const Statement& statement);
  // RLO of a comparison, an edge or a timer that ran in `rung`, as far as that continues: contacts mark themselves.
  void result(const Statement& statement, uint32_t rung);

private:
  void note(ir::MarkKind kind, const Statement& statement, ir::ValueId value);

  const SourceProgram& program_;
  Emitter& emitter_;
  ir::Marks* marks_;
};

} // namespace rung::frontend::technol
