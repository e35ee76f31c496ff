// Checked statements to IR. Lowering walks the modules; the lowering functions of the rows (lower_*.cpp) use its public
// part only.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/lower/host_cells.h"
#include "frontend/dialects/technol/lower/routine_builder.h"
#include "frontend/dialects/technol/program.h"
#include "ir/core/marks.h"

namespace rung::frontend::technol {

// A place in memory as an operation reaches it: fixed, or by a checked index.
struct Access {
  ir::Place place;
  bool indexed = false;
  ir::Window window;
  ir::ValueId index;
};

// A memory cell that an instruction counts in: written by the program, or made by the compiler.
struct CountCell {
  bool automatic = false;
  ir::SlotId slot;
  Access access;
  ir::Type type = ir::Type::I16;
};

// A sequential unit while it is lowered: a mechanism, MODULE_BLOCK_INIT or MODULE_BLOCK_DONE (§11.2 of the inventory).
struct Sequence {
  uint32_t unit = kNone;
  ir::RoutineId routine;
  uint32_t mechanism = kNone;                      // kNone: a module
  ir::Place moduleCont;                            // of a module: i32 for the host
  uint32_t leave = kNone;                          // label after its end
  uint32_t dispatch = kNone;                       // handle of the switch at its beginning
  std::vector<uint32_t> states;                    // labels by number; 0 is the beginning
  ir::Continuation continuation;                   // has a point for each of them
  uint64_t section = 0;                            // hash of the instructions from the last point to this one
  bool sectionEnds = false;                        // this one has a point
  std::unordered_map<std::string, uint32_t> alike; // points so far, by their keys
  std::unordered_map<uint32_t, uint32_t> stateOfLabel;
  std::vector<CountCell> cells; // cleared when the unit ends or is initialised
};

// A bit that makes a message, as EDEF has tied them. Each execution of the statement that differs in number or index is
// an entry in the hidden space @EDEF, which outlives CLEAR.
struct BitMessage {
  const Statement* statement = nullptr;
  Operand bit;
  std::array<Operand, 3> pars;
  std::array<ir::Window, 4> windows; // of bit and pars where they are indexed
  uint32_t mode = 0;
  uint32_t capacity = 1;
  uint32_t table = 0; // first byte in @EDEF: the number of entries, then these
};

struct LoweredModule {
  ModuleKind kind;
  ir::RoutineId routine;
  uint64_t weight = 0;
};

class Lowering {
public:
  // The spaces of `module` exist; `periodUs` is the main task's period; `marks` may be null. The program has no errors.
  Lowering(const Program& program, const TypedProgram& typed, ir::Module& module, uint32_t periodUs, ir::Marks* marks);
  void run();
  const std::vector<LoweredModule>& modules() const { return modules_; }
  // Procedures that the control calls by their reserved names (man. l.1609).
  const std::vector<LoweredModule>& events() const { return events_; }
  const std::vector<std::string>& eventNames() const { return eventNames_; }
  // Makes the messages of EDEF, at the end of each scan; no routine where there are none.
  const LoweredModule& bitMessages() const { return bitMessageTask_; }
  ir::FaultId fault(std::string_view text);
  ir::ServiceId service(std::string_view signature);

  // ---- for the lowering functions --------------------------------------------------------------------------------
  const Program& program() const { return program_; }
  ir::RungBuilder& b() { return out_->b(); }
  Registers& r() { return out_->registers(); }
  RoutineBuilder& out() { return *out_; }
  const Statement& statement() const { return *statement_; }
  // What LA, LO, LX without operand took off the stack.
  ir::ValueId popped() const { return popped_; }

  // Where a cell or bit lies; an index outside its space stops the program (where `guard` is 1, if there is one).
  Access reach(const Operand& operand, ir::ValueId guard = {});
  ir::ValueId load(const Access& access, ir::Type type);
  void store(const Access& access, ir::ValueId value);
  // A bit with its sign.
  ir::ValueId bit(const Operand& operand);
  // The bit that LDR, LA, LO and LX ask.
  ir::ValueId contact(const Operand& operand);
  // A constant or a cell; `guard` as for reach.
  ir::ValueId value(const Operand& operand, ir::ValueId guard = {});

  uint32_t bytesOf(ir::SpaceId space) const { return program_.bytesOf(space); }
  // Stops the program where `bad` is 1: an access outside the memory.
  void protect(ir::ValueId bad);
  // A hidden space that holds the bytes.
  ir::SpaceId constantBytes(std::string_view bytes);
  // CLEAR GLOBAL,ALL and CLEAR INTERNAL,ALL.
  void clearAll(bool global);

  // State of this statement alone, e.g. the former value of an edge.
  ir::SlotId newSlot(ir::Type type, std::string_view what);
  // Names cells of an allocated space, so that they are found again in a changed program.
  void nameCells(std::string key, ir::SpaceId space, uint32_t byte, ir::Type type, uint32_t count = 1);
  // The instruction at hand with its operands: what its state is known by.
  std::string instructionKey(std::string_view mnemonic) const;
  // EDGE: forgotten at every start.
  void forgetAtStart(ir::SlotId slot) { forgotten_.push_back(slot); }
  CountCell countCell(const Operand& operand);
  ir::ValueId loadCount(const CountCell& cell);
  void storeCount(const CountCell& cell, ir::ValueId value);

  // Code label of a program's label.
  uint32_t jumpTarget(const Operand& label);
  // The unit that waits where the statement waits.
  Sequence& sequence() { return sequences_.back(); }
  // `role` tells the states of one instruction apart.
  uint32_t newState(Sequence& sequence, std::string_view role = {});
  void addPoint(Sequence& sequence, std::string_view role);
  uint32_t stateOf(Sequence& sequence, uint32_t label);
  void storeCont(const Sequence& sequence, ir::ValueId state);
  ir::ValueId loadCont(const Sequence& sequence);
  // The line number of the state in which a mechanism waits.
  void storeLine(const Sequence& sequence, uint32_t line);
  void initMechanism(uint32_t mechanism);
  void callProcedure(uint32_t procedure, ir::ValueId cond = {});
  // _ON_ESET, or kNone.
  uint32_t onMessage() const { return onMessage_; }
  // The procedure that is being lowered, or kNone.
  uint32_t currentProcedure() const { return procedure_; }
  ir::Place place(HostCell cell) const;
  void saveRegisters();
  void restoreRegisters();
  void addBitMessage(BitMessage message, ir::ValueId number, ir::ValueId subId);

private:
  void lowerModule(ModuleKind kind);
  void lowerPart(const ModulePart& part, ModuleKind kind);
  void enterPart(const ModulePart& part, ModuleKind kind);
  void prologue(ModuleKind kind);
  int64_t filesOwing(bool SourceFile::* finishes) const;
  void findTimed();
  ModuleKind firstFast() const;
  void enterClock(ModuleKind kind);
  void leaveClock(ModuleKind kind);
  void setClock(int32_t clock);
  void callEvent(ir::RoutineId procedure);
  void advanceClock(bool fast);
  void lowerStatement(const Statement& statement, uint32_t index);
  void bindLabels(const Statement& statement, uint32_t index);
  void lowerCode();
  Sequence* ownSequence();
  void beginRungFor(const Row& row);
  void applyStack(const StackUse& use);
  void mark(ir::MarkKind kind, ir::ValueId value);
  void markDecision(const Row& row);
  void markResult(const Row& row, uint32_t rung);
  void beginSequence(uint32_t mechanism, uint32_t unit);
  void endSequence();
  void beginMechanism();
  void endMechanism();
  void beginProcedure();
  void endProcedure();
  void beginTimed();
  ir::SlotId dueSlot(bool fast, TimedKind kind);
  ir::ValueId isDue(TimedKind kind);
  void finishProcedures();
  void makeResets();
  void makeStart();
  void makeClears();
  void clearData(bool local);
  void clearSlots(std::span<const ir::SlotId> slots);
  void fillData();
  void makeEvents();
  void makeBitMessages();
  void forgetBitMessages();
  ir::RoutineId newRoutine(std::string name);
  std::unique_ptr<RoutineBuilder> newBuilder(ir::RoutineId routine);
  RungSource sourceOf(const Statement& statement) const;

  const Program& program_;
  const TypedProgram& typedProgram_;
  ir::Module& module_;
  uint32_t periodUs_;
  ir::Marks* marks_;
  RegisterSlots slots_;

  std::unique_ptr<RoutineBuilder> out_;
  std::vector<std::unique_ptr<RoutineBuilder>> outer_; // interrupted by procedures
  std::vector<uint32_t> outerProcedures_;
  const Statement* statement_ = nullptr;
  const Typed* typed_ = nullptr;
  ModuleKind kind_ = ModuleKind::Main;
  uint32_t procedure_ = kNone;
  uint32_t onMessage_ = kNone;
  std::vector<Sequence> sequences_;
  std::vector<uint32_t> codeLabels_; // by program label

  ir::ValueId popped_;
  std::vector<LoweredModule> modules_;
  std::vector<LoweredModule> events_;
  std::vector<std::string> eventNames_;
  std::vector<ir::RoutineId> procedureRoutines_;
  std::vector<ir::SlotId> contSlots_; // of mechanisms
  std::vector<ir::RoutineId> resets_;
  std::vector<std::vector<CountCell>> resetCells_;
  std::vector<ir::SlotId> forgotten_;
  std::array<std::array<bool, 4>, 2> timedUsed_{}; // of the 20 ms task and of the fast one; by TimedKind
  std::map<std::pair<bool, TimedKind>, ir::SlotId> due_;
  std::vector<ir::SlotId> phases_;    // cycles of each period that have passed
  ir::SlotId clock_;                  // of the running module, where procedures have timed blocks
  std::vector<ir::SlotId> automatic_; // that instructions made for themselves
  std::vector<ir::SlotId> timers_;    // those of them that count time
  ir::RoutineId clears_[2];           // CLEAR GLOBAL, CLEAR INTERNAL; invalid where not used
  std::unordered_map<std::string, ir::SpaceId> constants_;
  std::unordered_map<std::string, uint32_t> slotNames_;
  std::unordered_map<std::string, ir::FaultId> faults_;
  ir::RoutineId start_;
  std::vector<ir::SlotId> saved_;
  std::vector<BitMessage> bitMessages_;
  ir::SpaceId bitMessageSpace_;
  LoweredModule bitMessageTask_{ModuleKind::Main, {}, 0};
};

} // namespace rung::frontend::technol
