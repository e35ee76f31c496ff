// Rows: messages, program control, services of the NC (man. §6.13-§6.18). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/rows_float.h"

namespace rung::nct {

constexpr NctInstruction messageRow(RowText text, std::string_view variableKind) {
  return {.info = {.mnemonic = text.mnemonic, .title = text.title, .group = "message", .pins = {P{"EN", "shows on its rising, deletes on its falling edge", true}},
                   .operands = {O{"Message Number", "dec", Access::Read, "1 to 999", 1, 999}, O{"Channel Index", "dec", Access::Read, "0 to 99", 0, 99},
                                O{"Arbitrary Index", "dec", Access::Read, "0 to 99", 0, 99},
                                O{.name = "Optional Variable", .kind = variableKind, .doc = "printed in the text", .optional = true}},
                   .output = Output::Always, .stateful = true, .ref = text.ref, .doc = text.doc, .example = text.example}};
}

constexpr NctInstruction controlRow(RowText text, std::string_view operand, Placement placement, Flow flow) {
  NctInstruction row{.info = {.mnemonic = text.mnemonic, .title = text.title, .group = "program-control", .pins = {P{"EN", "condition"}},
                              .output = Output::None, .placement = placement, .ref = text.ref, .doc = text.doc, .example = text.example},
                     .flow = flow};
  if (!operand.empty()) row.info.operands = {O{operand, "label", Access::None, "#0 to #99"}};
  return row;
}

inline constexpr NctInstruction kControlRows[] = {
    messageRow({"MSG", "integer message, screen", "6.13.1, l.2775", "Shows a message while the input is TRUE.", "|--[FAULT]--{MSG #20 #0 #0 #0}--[N_CLRMSG]--(R FAULT)"}, "dec"),
    messageRow({"MSGF", "floating-point message, screen", "6.13.1, l.2775", "As MSG, with a double.", "|--[FAULT]--{MSGF #20 #0 #0 *1.5}--[N_CLRMSG]--(R FAULT)"}, "float"),
    messageRow({"ALR", "integer message, screen and log", "6.13.1, l.2775", "As MSG, and the rising edge writes to the log.", "|--[FAULT]--{ALR #20 #0 #0 #0}--[N_CLRMSG]--(R FAULT)"}, "dec"),
    messageRow({"ALRF", "floating-point message, screen and log", "6.13.1, l.2775", "As ALR, with a double.", "|--[FAULT]--{ALRF #20 #0 #0 *1.5}--[N_CLRMSG]--(R FAULT)"}, "float"),
    messageRow({"REM", "integer message, log", "6.13.1, l.2775", "The rising edge writes to the log; nothing is shown.", "|--[FAULT]--{REM #20 #0 #0 #0}--(R FAULT)"}, "dec"),
    messageRow({"REMF", "floating-point message, log", "6.13.1, l.2775", "As REM, with a double.", "|--[FAULT]--{REMF #20 #0 #0 *1.5}--(R FAULT)"}, "float"),

    controlRow({"END", "end of the cyclic part of a module", "6.14.1, l.2918",
                "The cycle of the module ends here. Behind it stand the subroutines; without any it may be left out.", "|--{END}"}, "", Placement::AtRail, Flow::End),
    controlRow({"JMP", "conditional jump", "6.14.2, l.2936",
                "With power the program goes on at the JME of this number. What is jumped over keeps its outputs and its memory of edges.",
                "|--[SKIP]--{JMP #5}"}, "Jump Number", Placement::BehindContact, Flow::Jump),
    controlRow({"JME", "target of a jump", "6.14.2, l.2966", "Marks the place at which a JMP of this number goes on.", "|--{JME #5}"}, "Jump Number",
               Placement::AtRail, Flow::Label),
    controlRow({"SBS", "subroutine call", "6.14.3, l.2984", "With power the subroutine is executed; then the program goes on behind this rung.",
                "|--[N_ON]--{SBS #10}"}, "Subroutine Number", Placement::BehindContact, Flow::Call),
    controlRow({"SBN", "start of a subroutine", "6.14.3, l.3020", "A subroutine reaches to the next SBN or to the end of the module.", "|--{SBN #10}"},
               "Subroutine Number", Placement::AtRail, Flow::Subroutine),
    controlRow({"RET", "return from a subroutine", "6.14.3, l.3036", "With power the subroutine ends.", "|--[N_ON]--{RET}"}, "", Placement::BehindContact,
               Flow::Return),

    {.info = {.mnemonic = "MOVCMND", .title = "axis control", .group = "nc-service", .pins = {kEnable},
              .operands = {O{"Axis", "dec", Access::Read, "0 to 31", 0, 31}, O{"Code", "dec", Access::Read, "0 to 14", 0, 14},
                           O{"Speed", "float", Access::Read, ""}, O{"Distance", "float", Access::Read, ""}},
              .output = Output::Optional, .ref = "6.15, l.3052", .doc = "Moves an axis under control of the PLC.",
              .example = "|--[@GO]--{MOVCMND #0 #1 *100.0 *5.0}"}},
    {.info = {.mnemonic = "MACR", .title = "read a macro variable", .group = "nc-service", .pins = {kEnable},
              .operands = {O{"Result", "udouble", Access::Write, ""}, O{"Variable", "dec", Access::Read, "100 to 999", 100, 999}, O{"Channel", "dec", Access::Read, ""}},
              .output = Output::Optional, .ref = "6.16.1, l.3165", .doc = "Result := macro variable of a channel.", .example = "|--[@GO]--{MACR 7000 #500 #0}"}},
    {.info = {.mnemonic = "MACW", .title = "write a macro variable", .group = "nc-service", .pins = {kEnable},
              .operands = {O{"Variable", "dec", Access::Read, "100 to 999", 100, 999}, O{"Operand", "udouble", Access::Read, ""}, O{"Channel", "dec", Access::Read, ""}},
              .output = Output::Optional, .ref = "6.16.2, l.3217", .doc = "Macro variable of a channel := Operand.", .example = "|--[@GO]--{MACW #500 7000 #0}"}},
    {.info = {.mnemonic = "SCP", .title = "read a quantity of the NC", .group = "nc-service", .pins = {kEnable},
              .operands = {O{"Result", "udouble", Access::Write, ""}, O{"Scope", "scope", Access::Read, "name of the quantity"},
                           O{"Parameter 1", "dec", Access::Read, ""}, O{"Parameter 2", "dec", Access::Read, ""}},
              .output = Output::Optional, .ref = "6.17, l.3269", .doc = "Result := position, speed or another quantity of the NC.",
              .example = "|--[N_ON]--{SCP 7000 AXPOS #0 #0}"}},
    {.info = {.mnemonic = "MR", .title = "read data of the NC", .group = "nc-service", .pins = {kEnable},
              .operands = {O{"Data", "word", Access::ReadWrite, "first word of the block"}, O{"Function", "dec", Access::Read, "function code"}},
              .output = Output::Optional, .ref = "6.18.1, l.3394", .doc = "Requests data from the NC; the block's first word is the execution code.",
              .example = "|--[GO]--{MR 7000 #10}--(R GO)"}},
    {.info = {.mnemonic = "MW", .title = "write data of the NC", .group = "nc-service", .pins = {kEnable},
              .operands = {O{"Data", "word", Access::ReadWrite, "first word of the block"}, O{"Function", "dec", Access::Read, "function code"}},
              .output = Output::Optional, .ref = "6.18.2, l.3468", .doc = "Hands data to the NC; the block's first word is the execution code.",
              .example = "|--[GO]--{MW 7000 #11}--(R GO)"}},
};

} // namespace rung::nct
