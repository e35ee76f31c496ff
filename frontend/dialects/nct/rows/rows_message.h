// Rows: messages (man. §6.13). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/rows/rows_float.h"

namespace rung::nct {

constexpr NctInstruction messageRow(RowText text, const OperandKind& variableKind, int variant) {
  return {.info = {.mnemonic = text.mnemonic,
                   .title = text.title,
                   .group = "message",
                   .pins = {P{"EN", "shows on its rising, deletes on its falling edge", true}},
                   .operands = {O{"Message Number", &kinds::kDecimal, Access::Read, "1 to 999", 1, 999},
                                O{"Channel Index", &kinds::kDecimal, Access::Read, "0 to 99", 0, 99},
                                O{"Arbitrary Index", &kinds::kDecimal, Access::Read, "0 to 99", 0, 99},
                                O{.name = "Optional Variable",
                                  .kind = &variableKind,
                                  .doc = "printed in the text",
                                  .optional = true}},
                   .output = Output::Always,
                   .stateful = true,
                   .ref = text.ref,
                   .doc = text.doc,
                   .example = text.example},
          .lower = lowerMessage,
          .variant = variant};
}

inline constexpr NctInstruction kMessageRows[] = {
    messageRow({"MSG", "integer message, screen", "6.13.1, l.2775",
                "The rising edge of the input shows the message, the falling edge deletes it. The output is TRUE while "
                "it is on the screen, from the next cycle on.",
                "|--[FAULT]--{MSG #20 #0 #0 #0}--[N_CLRMSG]--(R FAULT)"},
               kinds::kDecimal, kMessageOnScreen),
    messageRow({"MSGF", "floating-point message, screen", "6.13.1, l.2775", "As MSG, with a double.",
                "|--[FAULT]--{MSGF #20 #0 #0 *1.5}--[N_CLRMSG]--(R FAULT)"},
               kinds::kFloat, kMessageOnScreen | kMessageOfReal),
    messageRow({"ALR", "integer message, screen and log", "6.13.1, l.2775",
                "As MSG, and the rising edge writes code and text to the log.",
                "|--[FAULT]--{ALR #20 #0 #0 #0}--[N_CLRMSG]--(R FAULT)"},
               kinds::kDecimal, kMessageOnScreen | kMessageToLog),
    messageRow({"ALRF", "floating-point message, screen and log", "6.13.1, l.2775", "As ALR, with a double.",
                "|--[FAULT]--{ALRF #20 #0 #0 *1.5}--[N_CLRMSG]--(R FAULT)"},
               kinds::kFloat, kMessageOnScreen | kMessageToLog | kMessageOfReal),
    messageRow({"REM", "integer message, log", "6.13.1, l.2775",
                "The rising edge writes code and text to the log; nothing is shown. The output is TRUE when that is "
                "done, until the input turns FALSE.",
                "|--[FAULT]--{REM #20 #0 #0 #0}--(R FAULT)"},
               kinds::kDecimal, kMessageToLog),
    messageRow({"REMF", "floating-point message, log", "6.13.1, l.2775", "As REM, with a double.",
                "|--[FAULT]--{REMF #20 #0 #0 *1.5}--(R FAULT)"},
               kinds::kFloat, kMessageToLog | kMessageOfReal),
};

} // namespace rung::nct
