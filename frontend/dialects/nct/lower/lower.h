// The context of a lowering function: the builder, the memory of the dialect, the operands and the power at the pins.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "frontend/dialects/nct/lower/memory.h"
#include "frontend/dialects/nct/rows/instructions.h"
#include "frontend/lower/module_items.h"
#include "frontend/lower/operations.h"
#include "ir/core/builder.h"
#include "ir/core/marks.h"
#include "rtlib/nc/nct/services.h"

namespace rung::frontend::nct {

// Makes the state slots of a routine's elements. Their keys describe the element itself, so that they do not change
// with other edits: routine, instruction and operands, with a number if several are equal.
class SlotMaker {
public:
  SlotMaker(ir::Module& module, std::string_view routine) : module_(module), routine_(routine) {}
  void setElement(std::string text);
  // `role` distinguishes the slots of one element. Elements without a slot are not numbered.
  std::string key(std::string_view role);
  ir::SlotId make(std::string_view role, ir::Type type, int64_t init = 0, bool transient = false);
  // The element as a timer, for displays.
  void addTimer(ir::Timer timer);

private:
  ir::Module& module_;
  std::string_view routine_;
  std::string element_;
  bool numbered_ = false;     // whether element_ has its number
  frontend::Numbering alike_; // elements with a slot so far, by their text
};

// Time since the last run of a task.
struct RunTime {
  // i32, written at the beginning of a run: milliseconds since the last run. Invalid: no timer needs it, or the runs
  // are not whole milliseconds apart, so that each timer keeps its own remainder.
  ir::SlotId passedMs;
};

// Words of a hidden space, unit 4.
struct SharedWords {
  ir::SpaceId space;
  uint32_t first = 0;
  // `count` words after the first `skip`, for a computed index.
  ir::Window window(uint32_t skip, uint32_t count) const {
    return {.space = space, .byte = (first + skip) * 4, .count = count};
  }
};

// Things that boxes share with the NC: the services of the program, and words in hidden spaces that the host finds by
// name.
class Shared {
public:
  // `given` may be null: the module is not compared with another.
  Shared(ir::Module& module, ir::RoutineId routine, ir::GivenNumbers* given)
      : module_(module), routine_(routine), given_(given) {}
  ir::ServiceId service(nc::nct::ServiceKind kind) { return frontend::service(module_, nc::nct::service(kind)); }
  // Words of this box only, under its key: a hidden symbol, so that they are found again in a changed program. The
  // space is made on first use.
  SharedWords words(std::string_view space, uint32_t count, const std::string& key);
  // The number in the space of the first of the words, in the routine's last rung.
  ir::ValueId number(ir::RungBuilder& b, ir::Type type, const SharedWords& words);

private:
  ir::Module& module_;
  const ir::RoutineId routine_;
  ir::GivenNumbers* const given_;
};

struct Lowering {
  ir::RungBuilder& b;
  Memory& memory;
  SlotMaker& slots;
  Shared& shared;
  RunTime time; // set if each run evaluates the box exactly once; otherwise without passedMs
  std::span<const Operand> operands;
  std::span<const ir::ValueId> pins; // invalid: the left rail, always 1
  int variant = 0;
  char edge = 0; // '@' or '%' of a contact
  // The element's own condition, set by pass(), before it is combined with the power to give the output.
  ir::ValueId condition{};

  // The power at a pin as a value.
  ir::ValueId power(size_t pin = 0) { return pins[pin].valid() ? pins[pin] : b.bit(true); }
  // value AND the power at the first pin.
  ir::ValueId gate(ir::ValueId value) { return pins[0].valid() ? b.and_(pins[0], value) : value; }
  // The output of a contact, which passes the power on if the value is 1.
  ir::ValueId pass(ir::ValueId value) {
    condition = value;
    return gate(value);
  }
};

// --- boxes ----------------------------------------------------------------------------------------------------------
// Runs `body` if `valid` (invalid id: always) holds. An invalid operand sets FL_ER, leaves everything else unchanged
// and makes the output 0 (man. l.729). `body` returns the output, an invalid id for "always 1"; so does guarded.
template <class Body>
ir::ValueId guarded(Lowering& box, ir::ValueId valid, Body body) {
  if (!valid.valid()) return body();
  ir::RungBuilder& b = box.b;
  const auto work = [&] {
    const ir::ValueId output = body();
    return output.valid() ? output : b.bit(true);
  };
  return b.choose(valid, work, [&] {
    box.memory.setErrorFlag(true);
    return b.bit(false);
  });
}

// A box that works while its first pin has power: `body` evaluates the operands, so that an idle box costs only a test.
// It returns the output, an invalid id for "always 1"; without power the output is 0.
template <class Body>
ir::ValueId execute(Lowering& box, Body body) {
  ir::RungBuilder& b = box.b;
  const ir::ValueId enable = box.power();
  b.if_(enable);
  const ir::ValueId output = body();
  if (!output.valid()) {
    b.endIf();
    return enable;
  }
  b.else_(std::span(&output, 1));
  const ir::ValueId off = b.bit(false);
  return b.endIf(std::span(&off, 1)).front();
}

// Of the power at a pin; `role` names the slot of the former value.
ir::ValueId risingEdge(Lowering& box, std::string_view role, size_t pin);

// --- lowering functions, by family ----------------------------------------------------------------------------------
using enum frontend::Edge;
using enum frontend::Arithmetic;
using enum frontend::Logic;
using enum frontend::Relation;

// Contacts: variant bit 0: closed; bit 1: on a word.
inline constexpr int kClosed = 1;
inline constexpr int kOnWord = 2;
ir::ValueId lowerContact(Lowering& box);
enum CoilVariant : int { kCoil, kNegatedCoil, kSet, kReset };
ir::ValueId lowerCoil(Lowering& box);
ir::ValueId lowerPulse(Lowering& box); // DIFU, DIFD; an Edge

enum MoveVariant : int { kMove, kMoveComplement };
ir::ValueId lowerMove(Lowering& box);
ir::ValueId lowerMoveDouble(Lowering& box);
ir::ValueId lowerLogic(Lowering& box);
ir::ValueId lowerAddSub(Lowering& box);
ir::ValueId lowerMul(Lowering& box);
ir::ValueId lowerDiv(Lowering& box);

enum TimerVariant : int { kOnDelay, kOffDelay, kTimedPulse };
ir::ValueId lowerTimer(Lowering& box);
RunTime lowerRunTime(ir::RungBuilder& b, SlotMaker& slots); // what a run begins with if timers need it
enum CounterVariant : int { kStopping, kRing };
ir::ValueId lowerCounter(Lowering& box);

ir::ValueId lowerFloatArithmetic(Lowering& box);
enum FunctionVariant : int {
  kPower,
  kSquareRoot,
  kSine,
  kCosine,
  kTangent,
  kArcSine,
  kArcCosine,
  kArcTangent,
  kExponential,
  kLogarithm
};
ir::ValueId lowerFloatFunction(Lowering& box); // PWR to LOG

// Bits of the variant.
inline constexpr int kMessageOnScreen = 1;
inline constexpr int kMessageToLog = 2;
inline constexpr int kMessageOfReal = 4;
ir::ValueId lowerMessage(Lowering& box);
ir::ValueId lowerBin(Lowering& box);
ir::ValueId lowerBcd(Lowering& box);
ir::ValueId lowerFlt(Lowering& box);
ir::ValueId lowerFix(Lowering& box);
enum AngleVariant : int { kToDegrees, kToRadians };
ir::ValueId lowerAngle(Lowering& box);

ir::ValueId lowerRotation(Lowering& box); // ROT
ir::ValueId lowerShiftRegister(Lowering& box);
enum ArrayVariant : int { kShiftLeft, kShiftRight, kRotateLeft, kRotateRight };
ir::ValueId lowerArray(Lowering& box);

ir::ValueId lowerCompare(Lowering& box);      // CMP
ir::ValueId lowerFloatCompare(Lowering& box); // FCMP
ir::ValueId lowerCompareContact(Lowering& box);
ir::ValueId lowerFloatContact(Lowering& box);

enum ArrayServiceVariant : int { kReadArray, kWriteArray };
ir::ValueId lowerArrayService(Lowering& box); // MR, MW
enum MacroVariant : int { kReadMacro, kWriteMacro };
ir::ValueId lowerMacro(Lowering& box);       // MACR, MACW
ir::ValueId lowerScope(Lowering& box);       // SCP
ir::ValueId lowerAxisCommand(Lowering& box); // MOVCMND

// Checks of operands.
void checkTimer(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics);
void checkReadFunction(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics);
void checkWriteFunction(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics);
void checkMacro(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics);
void checkScope(std::span<const Operand> operands, const Config& config, Diagnostics& diagnostics);

} // namespace rung::frontend::nct
