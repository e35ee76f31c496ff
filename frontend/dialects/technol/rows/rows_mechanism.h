// Rows: mechanisms and their states (man. ch. 4). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

inline constexpr OperandList kTimedOperands = {
    inout("count", kinds::kTimerCell, "counts the cycles"), in("time", kinds::kTime, "cycles of the PLC"),
    in("error", kinds::kLabel, "where a time-out leads"), optional(in("code", kinds::kConstant, "DR at the time-out"))};

// A state of a unit that waits.
constexpr Row stateShape(OperandList operands, uint16_t effects, LowerFn lower, CheckFn check = nullptr) {
  return {.info = {.group = "mechanism state",
                   .operands = operands,
                   .terminating = true,
                   .stateful = true,
                   .tasks = kSequentialUnits},
          .effects = effects,
          .check = check,
          .lower = lower};
}

inline constexpr Row kMechanismRows[] = {
    // ---- mechanisms (man. ch. 4) ----------------------------------------------------------------------------------
    {.info = {.mnemonic = "MECH_BEGIN",
              .title = "mechanism",
              .group = "mechanism",
              .operands = {in("mech", kinds::kDeclaration, "a new name")},
              .stateful = true,
              .ref = "4.2, l.2037",
              .doc = "Begins a mechanism: code that is executed one part per cycle while its bit is 1. Declares the "
                     "bit and the word NAME_LINE.",
              .example = "MECH_BEGIN CLAMP\nFL   1,PUMP\nEX\nLDR  READY\nEX0\nFL   0,PUMP\nMECH_END CLAMP"},
     .role = Role::MechBegin},
    {.info = {.mnemonic = "MECH_END",
              .title = "end of a mechanism",
              .group = "mechanism",
              .operands = {in("mech", kinds::kDeclaration, "the name of its MECH_BEGIN")},
              .ref = "4.2, l.2038",
              .doc = "Ends a mechanism: its bit becomes 0, and it starts at its beginning the next time.",
              .example = "MECH_BEGIN CLAMP\nFL   1,PUMP\nEX\nLDR  READY\nEX0\nFL   0,PUMP\nMECH_END CLAMP"},
     .role = Role::MechEnd},
    {.info = {.mnemonic = "MECH_INIT",
              .title = "initialise a mechanism",
              .group = "mechanism",
              .operands = {in("mech", kinds::kMechanism, "is stopped")},
              .ref = "4.2, l.2039",
              .doc = "The mechanism is stopped and starts at its beginning the next time.",
              .example = "MECH_INIT CLAMP"},
     .lower = lowerMechInit},
    rowOf(stateShape({}, kWaits, lowerEx), "EX", "next cycle", "4.2, l.2055",
          "Stops the unit for this cycle; it continues after EX in the next.", "FL   1,PUMP\nEX\nFL   0,PUMP"),
    rowOf(stateShape({}, kWaits | kKeepsDr | kReadsRlo, lowerExWhile), "EX0", "wait while 0", "4.2, l.2056",
          "While RLO is 0 the unit is left; in the next cycle it continues after the last state passed.",
          "LDR  READY\nEX0", 0),
    rowOf(stateShape({}, kWaits | kKeepsDr | kReadsRlo, lowerExWhile), "EX1", "wait while 1", "4.2, l.2057",
          "While RLO is 1 the unit is left; in the next cycle it continues after the last state passed.",
          "LDR  DOOR\nEX1", 1),
    rowOf(stateShape({}, kWaits, lowerBex), "BEX", "set the point of return", "4.2, l.2058",
          "Does not wait; a later state that waits returns here.", "BEX\nMOVR LAMP,DOOR\nLDR  READY\nEX0"),
    rowOf(stateShape(kTimedOperands, kWaits | kKeepsDr | kReadsRlo, lowerTimedEx, checkTimedEx), "TEX0",
          "wait while 0, with time-out", "4.2, l.2092",
          "As EX0, but at most for the time; then control goes to the label with the code in DR.",
          "LDR  CHAIN_STOPPED\nTEX0 -,250,ERROR,4", 0),
    rowOf(stateShape(kTimedOperands, kWaits | kKeepsDr | kReadsRlo, lowerTimedEx, checkTimedEx), "TEX1",
          "wait while 1, with time-out", "4.2, l.2093",
          "As EX1, but at most for the time; then control goes to the label with the code in DR.",
          "LDR  DOOR\nTEX1 -,250,ERROR,5", 1),
    rowOf(stateShape(
              {inout("count", kinds::kTimerCell, "counts the cycles"), in("time", kinds::kTime, "cycles of the PLC")},
              kWaits, lowerWait),
          "TIM", "wait", "4.2, l.2136", "Waits for the time.", "TIM  -,50"),
};

} // namespace rung::frontend::technol
