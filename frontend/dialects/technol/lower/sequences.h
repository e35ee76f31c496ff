// Units that wait: mechanisms, MODULE_BLOCK_INIT and MODULE_BLOCK_DONE (man. ch. 4; §11.2 of the inventory). A state
// number says where one continues; it begins with a switch over these states.
#pragma once

#include "frontend/dialects/technol/lower/memory.h"
#include "frontend/dialects/technol/lower/trace.h"

namespace rung::frontend::technol {

// A unit during lowering.
struct Sequence {
  UnitId unit;
  ir::RoutineId routine;
  uint32_t mechanism = kNone;                    // kNone: a module
  HostCell moduleDone = HostCell::BlockInitDone; // of a module: set when it has finished
  ir::Place moduleCont;                          // of a module: its state, i32, for the host
  uint32_t leave = kNone;                        // label after its end
  uint32_t dispatch = kNone;                     // handle of the switch at its beginning
  uint32_t dispatchRung = 0;
  std::vector<uint32_t> states;                    // labels by number; 0 is the beginning
  ir::Continuation continuation;                   // has a point for each state
  std::string instruction;                         // key of the current instruction
  uint64_t section = 0;                            // hash of the instructions from the last point to this one
  bool sectionEnds = false;                        // whether this instruction has a point
  std::unordered_map<std::string, uint32_t> alike; // number of points so far, by key
  std::unordered_map<uint32_t, uint32_t> stateOfLabel;
  std::vector<CountCell> cells;    // cells that are cleared when the unit ends or is initialised
  std::vector<ir::SlotId> tickets; // of its requests, forgotten at the same time
};

class Sequences {
public:
  Sequences(const SourceProgram& program, Emitter& emitter, State& state);

  void beginModule(ModuleKind kind, UnitId unit);
  // `leave`: a label after the end, to which a mechanism that is not active jumps.
  void beginMechanism(uint32_t mechanism, UnitId unit);
  // Called when the unit has finished: it starts at its beginning the next time.
  void end();
  // Called before each statement.
  void pass(const Statement& statement);

  // The waiting unit that contains the current statement.
  Sequence& current() { return open_.back(); }
  // A new state of the current instruction; `role` distinguishes several.
  uint32_t newState(Sequence& sequence, std::string_view role = {});
  // The state in which the unit continues at a label.
  uint32_t stateOf(Sequence& sequence, uint32_t label);
  void storeState(const Sequence& sequence, ir::ValueId state);
  ir::ValueId loadState(const Sequence& sequence);
  // Stores the line number of the state in which a mechanism waits.
  void storeLine(const Sequence& sequence, uint32_t line);
  // The code of MECH_INIT.
  void initialise(uint32_t mechanism);
  // The units that have ended.
  std::vector<Trace::Sequence> takeTrace() { return std::move(trace_); }
  // Makes the routines that MECH_INIT calls: they clear the counts of a mechanism.
  void makeResets();

private:
  void begin(Sequence sequence);
  void clear(std::span<const CountCell> cells, std::span<const ir::SlotId> tickets);
  void clearAtBeginning(Sequence& sequence);
  void addPoint(Sequence& sequence, std::string_view role);

  const SourceProgram& program_;
  Emitter& emitter_;
  State& state_;
  std::vector<Sequence> open_; // the innermost last
  struct Kept {                // of a mechanism
    ir::SlotId state;
    ir::RoutineId reset; // invalid if not called
    std::vector<CountCell> cells;
    std::vector<ir::SlotId> tickets;
  };
  std::vector<Kept> mechanisms_;
  std::vector<Trace::Sequence> trace_;
};

} // namespace rung::frontend::technol
