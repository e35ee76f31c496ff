// Routines that the compiler makes: the start before MODULE_INIT, CLEAR of all data, procedures that the control calls.
#pragma once
#include "frontend/dialects/technol/lower/clocks.h"
#include "frontend/dialects/technol/lower/lower_message.h"
#include "frontend/dialects/technol/lower/procedures.h"
#include "frontend/dialects/technol/lower/sequences.h"
#include "ir/core/builder.h"

namespace rung::frontend::technol {

// Routines of CLEAR GLOBAL,ALL and CLEAR INTERNAL,ALL.
class Clears {
public:
  Clears(const TypedProgram& program, Memory& memory, State& state, Sequences& sequences)
      : program_(program), memory_(memory), emitter_(memory.emitter()), state_(state), sequences_(sequences) {}

  void call(bool global);
  // Makes those that are called.
  void make();

private:
  void clearData(bool local);
  void fillData();

  const TypedProgram& program_;
  Memory& memory_;
  Emitter& emitter_;
  State& state_;
  Sequences& sequences_;
  ir::RoutineId routines_[2]; // of GLOBAL, INTERNAL; invalid if not called
};

// Makes the code that runs before MODULE_INIT: edges are recorded again (man. l.300), the periods of timed blocks
// begin, EDEF connects its bits again, cells of the interface are preset. Must be called after all code is lowered.
void makeStart(const SourceProgram& program, Emitter& emitter, ir::RoutineId routine, const State& state,
               const Clocks& clocks, BitMessages& messages);

// A procedure that the control calls (man. l.1614-1644, l.3834).
struct Event {
  std::string name;
  ir::RoutineId routine;
};
std::vector<Event> makeEvents(const SourceProgram& program, Emitter& emitter, const Procedures& procedures,
                              Clocks& clocks);

// Cells of the interface that the control presets: at power-on, and when MODULE_INIT starts.

void addPowerOnPresets(ir::Module& module);
void storeStartPresets(ir::RungBuilder& b);

} // namespace rung::frontend::technol
