// The walk over the modules of a program: from typed statements to rungs.
#pragma once

#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

struct LoweredModule {
  ModuleKind kind{};
  ir::RoutineId routine;
  uint64_t weight = 0;
};

// The routines that tasks run.
struct LoweredProgram {
  std::vector<LoweredModule> modules;
  std::vector<Event> events;
  // Sends the messages of EDEF, at the end of each scan; invalid if there are none.
  ir::RoutineId bitMessages;
  uint64_t bitMessagesWeight = 0;
};

class Walk {
public:
  // The spaces of `module` must exist; `periodUs` is the main task's period; `marks` and `given` may be null. The
  // program must have no errors.
  Walk(const TypedProgram& program, ir::Module& module, uint32_t periodUs, ir::Marks* marks, ir::GivenNumbers* given);

  LoweredProgram run();
  Emitter& emitter() { return l_.emitter; }
  // Valid once, after run().
  Trace takeTrace();

private:
  void module(ModuleKind kind);
  void prologue(ModuleKind kind);
  void part(const ModulePart& part);
  void enterPart(const ModulePart& part);
  void endPart(const ModulePart& part);
  void statement(uint32_t index);
  void execute(const Statement& statement, const Typed& typed);
  void trace();
  void bindLabels(uint32_t index);
  void code(const Typed& typed);
  void beginRungFor(const Typed& typed);
  void beginAt(const Statement& statement);
  void beginMechanism(const Statement& statement);
  void beginProcedure(const Statement& statement);
  void beginTimed(const Statement& statement, const Typed& typed);

  const TypedProgram& program_;
  const SourceProgram& source_;
  Lowering l_;
  ir::RoutineId start_;
  Clocks clocks_;
  ModuleKind kind_ = ModuleKind::Main;
  LoweredProgram made_;
  Trace trace_;
  uint32_t index_ = kNone; // of the statement that is being lowered
};

} // namespace rung::frontend::technol
