// Rows: services of the NC (man. §6.15-§6.18). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/rows/rows_float.h"
#include "rtlib/nc/nct/axis_codes.h"

namespace rung::frontend::nct {

constexpr Row macroShape(frontend::FixedList<O, 8> operands) {
  return {.info = {.group = "nc-service",
                   .pins = {kEnable},
                   .operands = operands,
                   .output = Output::Optional,
                   .stateful = true},
          .lower = lowerMacro,
          .check = checkMacro};
}

constexpr Row arrayServiceShape(CheckFn check) {
  return {.info = {.group = "nc-service",
                   .pins = {P{"EN", "stays TRUE until the output is"}},
                   .operands = {O{"Data", &kinds::kWord, Access::ReadWrite, "first word of the operand block"},
                                O{"Function", &kinds::kDecimal, Access::Read, "see Functions of MR and MW"}},
                   .output = Output::Optional,
                   .stateful = true},
          .lower = lowerArrayService,
          .check = check};
}

inline constexpr Row kNcRows[] = {
    {.info = {.mnemonic = "MOVCMND",
              // The table of contents prints MOVCMND (l.135), the chapter also the others (l.3052, l.3155).
              .aliases = {"MOVCMD", "MOVCMMD", "MOVCMO"},
              .title = "axis control",
              .group = "nc-service",
              .pins = {kEnable},
              .operands = {O{"Axis", &kinds::kDecimal, Access::Read, "index of the axis", 0, nc::nct::kAxes - 1},
                           O{"Code", &kinds::kDecimal, Access::Read, "see Codes of MOVCMND", 0, 14},
                           O{"Speed", &kinds::kFloat, Access::Read, "in the unit of N0104"},
                           O{"Distance", &kinds::kFloat, Access::Read, "in the unit of N0104"}},
              .output = Output::Optional,
              .ref = "6.15, l.3052",
              .doc = "Writes a command into the buffer of an axis that the PLC has requested (AP_PLCR=1, AN_PLCA=1), "
                     "as soon as the buffer is empty (AN_BEPTY=1); the output is TRUE in that cycle. FL_ER=1 and "
                     "output FALSE: the axis is not the PLC's, the code is wrong, or codes 2 to 5 have speed 0.",
              .example = "|--[@GO]--{MOVCMND #0 #1 *100.0 *5.0}"},
     .lower = lowerAxisCommand},
    rowOf(macroShape({O{"Result", &kinds::kUserDouble, Access::Write, ""},
                      O{"Variable", &kinds::kDecimal, Access::Read, "", 100, 999},
                      O{"Channel", &kinds::kDecimal, Access::Read, "index, 0 to 7"}}),
          "MACR", "read a macro variable", "6.16.1, l.3165",
          "Result := macro variable #100 to #999 of a channel (index 0 to 7). FL_ER=1 and output FALSE: there is "
          "no such variable or channel.",
          "|--[@GO]--{MACR 7000 #500 #0}", kReadMacro),
    rowOf(macroShape({O{"Variable", &kinds::kDecimal, Access::Read, "", 100, 999},
                      O{"Operand", &kinds::kUserDouble, Access::Read, ""},
                      O{"Channel", &kinds::kDecimal, Access::Read, "index, 0 to 7"}}),
          "MACW", "write a macro variable", "6.16.2, l.3217",
          "Macro variable of a channel := Operand. FL_ER=1 and output FALSE: there is no such variable or channel, "
          "or P_MAC forbids it.",
          "|--[@GO]--{MACW #500 7000 #0}", kWriteMacro),
    {.info = {.mnemonic = "SCP",
              .title = "read a quantity of the NC",
              .group = "nc-service",
              .pins = {kEnable},
              .operands = {O{"Result", &kinds::kUserDouble, Access::Write, ""},
                           O{"Scope", &kinds::kScope, Access::Read, "see Quantities of SCP"},
                           O{"Parameter 1", &kinds::kDecimal, Access::Read, "as the symbol says"},
                           O{"Parameter 2", &kinds::kDecimal, Access::Read, "as the symbol says"}},
              .output = Output::Optional,
              .stateful = true,
              .ref = "6.17, l.3269",
              .doc = "Result := position, speed or another quantity of the NC, as a double. FL_ER=1 and output FALSE: "
                     "a parameter is out of range.",
              .example = "|--[N_ON]--{SCP 7000 ActPosAx #1 #0}"},
     .lower = lowerScope,
     .check = checkScope},
    rowOf(arrayServiceShape(checkReadFunction), "MR", "read data of the NC", "6.18.1, l.3394",
          "Requests data from the NC. Word 0 of the block is the execution code, word 1 the amount of data "
          "(the number of words after it); the rest depends on the function. The request takes several "
          "cycles: the output is TRUE when the answer is in the block, whatever its code, and stays so "
          "until EN is FALSE. When EN is FALSE too early the answer is dropped. A block that does not fit "
          "into memory gets code 2, an unknown function code 1, at once.",
          "|--[GO]--{MR 7000 #10}--(R GO)", kReadArray),
    rowOf(arrayServiceShape(checkWriteFunction), "MW", "write data of the NC", "6.18.2, l.3468",
          "As MR, handing data to the NC.", "|--[GO]--{MW 7000 #11}--(R GO)", kWriteArray),
};

} // namespace rung::frontend::nct
