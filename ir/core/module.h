// The module: everything that engines know about a program. Plain data; built with builder.h, checked by ir/verify.
//
// Invariants (checked by ir/verify): ids are in range; a rung's values are defined before use and never cross the rung;
// regions (if/else/endif, loop/endloop) nest; routines do not call each other in a loop; every operation is total.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/core/op_code.h"
#include "ir/core/type.h"
#include "rung/program.h"

namespace rung::ir {

// Source position of a rung or an operation. Line 0: unknown.
struct Location {
  FileIndex file;
  uint32_t line = 0;
  uint32_t column = 0;
  bool operator==(const Location&) const = default;
};

// One operation. `args` and results are ids of the rung's values; see Attr for imm, ref and count.
struct Op {
  OpCode code{};
  Type type = Type::None; // T of the OpInfo row; None where the row has no types
  uint16_t argCount = 0;
  uint16_t resultCount = 0;
  uint32_t firstArg = 0; // in Rung::args
  ValueId result;        // the first of `resultCount` consecutive ids
  uint32_t ref = 0;
  uint32_t count = 0;
  int64_t imm = 0;
  uint32_t line = 0; // in the rung's file; 0: the rung's first line
  bool operator==(const Op&) const = default;
};

enum class TransferKind : uint8_t {
  Next,   // the rung below
  Goto,   // if `cond`, rung `target` of the same routine
  Call,   // if `cond`, routine `callee`; then the rung below
  Ret,    // if `cond`, back to the caller; at the outermost level the task's run ends
  End,    // if `cond`, the task's run ends
  Switch, // rung targets[value]; a value outside goes to targets[0]
};

// How control leaves a rung. Unconditional if `cond` is invalid; otherwise the rung below follows if `cond` is 0. After
// the last rung of a routine control returns.
struct Transfer {
  TransferKind kind = TransferKind::Next;
  ValueId cond{};  // bit
  ValueId value{}; // Switch: i32, unsigned
  uint32_t target = 0;
  RoutineId callee{};
  std::vector<uint32_t> targets{};
  bool operator==(const Transfer&) const = default;
};

// Where a rung was when the front end built it.
struct Origin {
  std::string routine;
  uint32_t index = RUNG_NONE; // over all routines, as in rung_program::rungs
  bool operator==(const Origin&) const = default;
};

// A bit of a space, counted from its beginning.
struct SpaceBit {
  SpaceId space;
  uint32_t bit = 0;
  bool operator==(const SpaceBit&) const = default;
};

struct Rung {
  uint32_t number = 0;    // as drawn: from 1, over all files in their order; 0: made by the compiler
  std::string title;      // the rung's comment
  std::string sourceText; // the lines as written, for readers of generated code; may be empty
  Location begin;
  uint32_t lastLine = 0;
  uint64_t key = 0;    // stable while the rung's text is unchanged (rungKey in rung/types.hpp)
  uint32_t copy = 0;   // number of earlier rungs in its routine with the same text: part of the key
  uint32_t weight = 1; // in steps, as the dialect counts them
  // Bits that never change. The rung reads them, but its code has their value and no operation.
  std::vector<SpaceBit> constantBits;
  std::vector<Op> ops;
  std::vector<ValueId> args; // operands of all ops
  std::vector<Type> values;  // type of each value
  std::vector<std::string> notes;
  Transfer transfer;
  uint32_t transferLine = 0; // source line of the transfer; 0: the first line of the rung
  Origin origin;             // set for all rungs once a pass has moved some, otherwise for none
};

struct Routine {
  std::string name;
  std::vector<Rung> rungs; // at least one
};

// The routine of the rung in the source; `routine` contains it now.
inline const std::string& homeOf(const Routine& routine, const Rung& rung) {
  return rung.origin.index == RUNG_NONE ? routine.name : rung.origin.routine;
}

struct Space {
  std::string name;
  uint32_t unitBytes = 1; // 1, 2, 4, 8
  uint32_t units = 0;
  uint32_t flags = 0;      // enum rung_space_flags
  bool packedOnly = false; // the host or a copy needs the dialect's own packing
};

// State made by the compiler. `key` does not change with edits elsewhere in the program, for hot reload.
struct Slot {
  Type type = Type::Bit;
  int64_t init = 0;
  bool transient = false; // a register between rungs: undefined before the first store of a run
  std::string key;
};

// A cell of 32 bits that determines where a mechanism continues: a slot, or a hidden symbol's. The value v means
// points[v]; 0 is the beginning. Keys are those of the slot or symbol, and of the places in the program; they do not
// change as long as the instruction does not.
struct Continuation {
  std::string key;
  SlotId slot; // invalid: the cell is in the space
  SpaceId space;
  uint32_t byte = 0;
  std::vector<std::string> points; // all different
};

// A cell of a timer: a slot, or a place in a space.
struct TimerCell {
  Type type = Type::None; // None: there is no cell
  SlotId slot;            // invalid: the cell is in the space
  SpaceId space;
  uint32_t byte = 0;
};

// A timer, for displays (see rung_timer).
struct Timer {
  std::string name; // the instruction as the dialect writes it
  uint32_t flags = 0;
  TimerCell time;
  uint32_t timeUs = 1;                 // microseconds of a unit of the time
  SlotId running;                      // a bit; invalid: it runs while its time is between 0 and its end
  TimerCell preset;                    // without one `constant`
  int64_t constant = -1;               // negative: not known
  TimerCell unit;                      // its number selects one of the units; without one the first
  std::vector<uint32_t> unitsUs = {1}; // of the preset
};

// The enum rung_type of a type; for None that of a byte, which a name without a type names.
constexpr uint32_t abiType(Type type) {
  constexpr uint32_t kTypes[kTypeCount] = {RUNG_TYPE_I8,  RUNG_TYPE_BIT, RUNG_TYPE_I8, RUNG_TYPE_I16,
                                           RUNG_TYPE_I32, RUNG_TYPE_I64, RUNG_TYPE_F64};
  return kTypes[static_cast<int>(type)];
}

struct Symbol {
  std::string name;
  std::string comment;
  SpaceId space;
  uint32_t byte = 0;
  uint32_t bit = 0;
  uint32_t type = RUNG_TYPE_BIT; // enum rung_type
  uint32_t count = 1;
  uint32_t flags = 0; // enum rung_symbol_flags
  int64_t value = 0;
};

// A range of a space, in bytes.
struct SpaceSpan {
  SpaceId space;
  uint32_t byte = 0;
  uint32_t size = 0;
};

struct Copy {
  bool masked = false; // RUNG_COPY_MASKED
  SpaceSpan from;
  SpaceId to;
  uint32_t toByte = 0;
  SpaceId mask; // masked only
  uint32_t maskByte = 0;
};

struct Init {
  SpaceId space;
  uint32_t byte = 0;
  std::vector<uint8_t> data;
};

struct Task {
  std::string name;
  RoutineId entry;
  uint32_t periodUs = 0;
  uint32_t budget = 1'000'000; // weight of one run
  FaultId budgetFault;
  std::vector<Copy> begin;
  std::vector<Copy> end;
  uint32_t parts = 1; // parts of a run; set by cutTask (parts.h), as are `borders`
  // Rungs of the entry routine that begin parts 2, 3, …, ascending. Passes do not change them, because the contents of
  // a part belong to the meaning of the program. Parts without a border are empty.
  std::vector<uint32_t> borders;
};

struct Step {
  uint32_t op = RUNG_STEP_RUN; // enum rung_step_op
  TaskId task;
  uint32_t arg = 1;
};

struct MessageText {
  uint32_t number = 0;
  std::string text;
};

struct Module {
  std::string name;
  std::string dialect; // for output only
  std::vector<std::string> files;
  std::vector<Space> spaces;
  std::vector<Slot> slots;
  std::vector<Continuation> continuations;
  std::vector<Timer> timers;
  std::vector<Symbol> symbols;
  std::vector<Init> inits;
  std::vector<SpaceSpan> retains;
  std::vector<SpaceSpan> safeSpans; // cleared by a fault
  std::vector<std::string> faults;
  std::vector<std::string> services;
  std::vector<MessageText> messages;
  std::vector<Routine> routines;
  std::vector<Task> tasks;
  TaskId mainTask;
  TaskId fastTask;
  std::vector<Step> scan;
  std::vector<Step> fast;
  std::vector<Step> slices; // see rung_program
  bool instrumented = false;

  const Space& at(SpaceId id) const { return spaces[id.index]; }
  const Slot& at(SlotId id) const { return slots[id.index]; }
  const Routine& at(RoutineId id) const { return routines[id.index]; }
};

// Ids by name, invalid if there is none; linear, for front ends and tests.
SpaceId findSpace(const Module& module, std::string_view name);
RoutineId findRoutine(const Module& module, std::string_view name);
TaskId findTask(const Module& module, std::string_view name);
// All routines that a run of this one may reach, itself first, each once.
std::vector<RoutineId> routinesFrom(const Module& module, RoutineId entry);
// Symbols of places in memory, not of constants: the author's first, then hidden ones.
std::vector<const Symbol*> placedSymbols(const Module& module);

// The operands of an operation.
inline const ValueId* argsOf(const Rung& rung, const Op& op) { return rung.args.data() + op.firstArg; }
inline ValueId arg(const Rung& rung, const Op& op, int i) { return rung.args[op.firstArg + static_cast<uint32_t>(i)]; }
inline Type typeOf(const Rung& rung, ValueId value) { return rung.values[value.index]; }
inline uint32_t lineOf(const Rung& rung, const Op& op) { return op.line != 0 ? op.line : rung.begin.line; }

} // namespace rung::ir
