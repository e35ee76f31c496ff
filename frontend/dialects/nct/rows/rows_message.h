// Rows: messages (man. §6.13). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/rows/rows_float.h"

namespace rung::frontend::nct {

constexpr Row messageShape(const OperandKind& variableKind) {
  return {.info = {.group = "message",
                   .pins = {P{"EN", "shows on its rising, deletes on its falling edge", true}},
                   .operands = {O{"Message Number", &kinds::kDecimal, Access::Read, "", 1, 999},
                                O{"Channel Index", &kinds::kDecimal, Access::Read, "", 0, 99},
                                O{"Arbitrary Index", &kinds::kDecimal, Access::Read, "", 0, 99},
                                O{.name = "Optional Variable",
                                  .kind = &variableKind,
                                  .doc = "printed in the text",
                                  .optional = true}},
                   .output = Output::Always,
                   .stateful = true},
          .lower = lowerMessage};
}

inline constexpr Row kMessageRows[] = {
    rowOf(messageShape(kinds::kDecimal), "MSG", "integer message, screen", "6.13.1, l.2775",
          "The rising edge of the input shows the message, the falling edge deletes it. The output is TRUE while "
          "it is on the screen, from the next cycle on.",
          "|--[FAULT]--{MSG #20 #0 #0 #0}--[N_CLRMSG]--(R FAULT)", kMessageOnScreen),
    rowOf(messageShape(kinds::kFloat), "MSGF", "floating-point message, screen", "6.13.1, l.2775",
          "As MSG, with a double.", "|--[FAULT]--{MSGF #20 #0 #0 *1.5}--[N_CLRMSG]--(R FAULT)",
          kMessageOnScreen | kMessageOfReal),
    rowOf(messageShape(kinds::kDecimal), "ALR", "integer message, screen and log", "6.13.1, l.2775",
          "As MSG, and the rising edge writes code and text to the log.",
          "|--[FAULT]--{ALR #20 #0 #0 #0}--[N_CLRMSG]--(R FAULT)", kMessageOnScreen | kMessageToLog),
    rowOf(messageShape(kinds::kFloat), "ALRF", "floating-point message, screen and log", "6.13.1, l.2775",
          "As ALR, with a double.", "|--[FAULT]--{ALRF #20 #0 #0 *1.5}--[N_CLRMSG]--(R FAULT)",
          kMessageOnScreen | kMessageToLog | kMessageOfReal),
    rowOf(messageShape(kinds::kDecimal), "REM", "integer message, log", "6.13.1, l.2775",
          "The rising edge writes code and text to the log; nothing is shown. The output is TRUE when that is "
          "done, until the input turns FALSE.",
          "|--[FAULT]--{REM #20 #0 #0 #0}--(R FAULT)", kMessageToLog),
    rowOf(messageShape(kinds::kFloat), "REMF", "floating-point message, log", "6.13.1, l.2775",
          "As REM, with a double.", "|--[FAULT]--{REMF #20 #0 #0 *1.5}--(R FAULT)", kMessageToLog | kMessageOfReal),
};

} // namespace rung::frontend::nct
