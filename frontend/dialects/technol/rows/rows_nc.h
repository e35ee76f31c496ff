// Rows: inputs and outputs, sharing, configuration, constants (man. ch. 10, 16, 18, 27). Included by instructions.cpp
// only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "frontend/dialects/technol/rows/row_parts.h"
#include "rtlib/nc/technol/configuration.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::frontend::technol {

inline constexpr OperandInfo kIdentifier = in("ID", "text or literal", "identifier");
constexpr OperandInfo defaultOf(std::string_view kind) {
  return optional(in("default", kind, "value where it is not found"));
}

inline constexpr OperandInfo kNewInput = out("bit", kNewBit, "is declared");
inline constexpr OperandInfo kNewCell = out("val", kNewReal, "is declared");
inline constexpr OperandInfo kNewName = out("val", kNewVariable, "is declared");
inline constexpr OperandInfo kExchangeType = in("type", "type", "of the variable");
inline constexpr OperandInfo kDefaultBit = {.name = "def",
                                            .kind = "default bit",
                                            .doc = "value where there is no configuration",
                                            .min = 0,
                                            .max = 1,
                                            .optional = true};
inline constexpr OperandInfo kDefaultReal =
    optional(in("def", "default real", "value where there is no configuration"));
inline constexpr OperandInfo kDefaultValue = {.name = "def",
                                              .kind = "default value",
                                              .doc = "value where nothing is connected",
                                              .min = INT64_MIN,
                                              .max = INT64_MAX,
                                              .optional = true};
inline constexpr OperandInfo kFast = optional(in("period", "FAST", "how often it is served; without it every cycle"));
inline constexpr OperandInfo kPeriod = optional(in("period", "period", "how often a connection is served"));
inline constexpr OperandInfo kShareName = in("name", "text or literal", "its name");
inline constexpr OperandInfo kLeast = optional(in("min", "limit or length", "least value, or bytes of a text"));
inline constexpr OperandInfo kMost = optional(in("max", "real cell", "greatest value"));
inline constexpr OperandInfo kBit = in("bit", kBitName, "which bit of the byte");

inline constexpr Row kNcRows[] = {
    {.info = {.mnemonic = "MAP_IN",
              .title = "declares a mapped input",
              .group = "inputs and outputs",
              .operands = {kNewInput, kIdentifier, kDefaultBit, kFast},
              .ref = "10.4, l.5767",
              .doc = "Declares a bit that is copied from the input port its configuration names, inverted where "
                     "that says so, before each cycle, with FAST each millisecond. The variable is declared "
                     "by this instruction alone, without DFM or DS, and is known in all files. Where the "
                     "identifier has no configuration, the variable takes the default, which else is the "
                     "configuration's. Shared by itself.",
              .example = "MAP_IN LIMIT_X,'inLimX',0,FAST"},
     .effects = kInitOnly | kDeclares,
     .check = checkDefine,
     .lower = lowerDefine,
     .variant = static_cast<int>(nc::ExchangeKind::MapIn)},
    {.info = {.mnemonic = "MAP_OUT",
              .title = "declares a mapped output",
              .group = "inputs and outputs",
              .operands = {kNewInput, kIdentifier, kDefaultBit, kFast},
              .ref = "10.4, l.5768",
              .doc = "Declares a bit that is copied to the output port its configuration names after each cycle, "
                     "with FAST each millisecond. Several outputs on one bit are ORed. The variable is declared by "
                     "this instruction alone, without DFM or DS, and is known in all files. Where the identifier "
                     "has no configuration, the variable takes the default, which else is the configuration's. "
                     "Shared by itself.",
              .example = "MAP_OUT ENABLE_X,'outXEn'"},
     .effects = kInitOnly | kDeclares,
     .check = checkDefine,
     .lower = lowerDefine,
     .variant = static_cast<int>(nc::ExchangeKind::MapOut)},
    {.info = {.mnemonic = "MAP_AIN",
              .title = "declares a mapped analogue input",
              .group = "inputs and outputs",
              .operands = {kNewCell, kIdentifier, kDefaultReal, kFast},
              .ref = "10.5, l.5850",
              .doc = "Declares a real that follows a physical analogue input: its voltage plus Offset, times "
                     "Scale, held between MinVal and MaxVal. The variable is declared by this instruction alone, "
                     "without DFM or DS, and is known in all files. Where the identifier has no configuration, the "
                     "variable takes the default, which else is the configuration's. Shared by itself.",
              .example = "MAP_AIN VOLTAGE,'PlasmaVoltage',120.0"},
     .effects = kInitOnly | kDeclares,
     .check = checkDefine,
     .lower = lowerDefine,
     .variant = static_cast<int>(nc::ExchangeKind::MapAin)},
    {.info = {.mnemonic = "MAP_AOUT",
              .title = "declares a mapped analogue output",
              .group = "inputs and outputs",
              .operands = {kNewCell, kIdentifier, kDefaultReal, kFast},
              .ref = "10.5, l.5851",
              .doc = "Declares a real that sets a physical analogue output: held between MinVal and MaxVal, times "
                     "Scale, plus Offset. The variable is declared by this instruction alone, without DFM or DS, "
                     "and is known in all files. Where the identifier has no configuration, the variable takes the "
                     "default, which else is the configuration's. Shared by itself.",
              .example = "MAP_AOUT FLOW,'CutFlow',30.0"},
     .effects = kInitOnly | kDeclares,
     .check = checkDefine,
     .lower = lowerDefine,
     .variant = static_cast<int>(nc::ExchangeKind::MapAout)},
    {.info = {.mnemonic = "DEF_IN",
              .title = "declares a logical input",
              .group = "inputs and outputs",
              .operands = {kNewName, kIdentifier, kExchangeType, kDefaultValue, kPeriod},
              .ref = "27.6, l.13299",
              .doc = "Declares a variable of the type, or with `[n]` an array of n elements (of TYPE_STR a text of "
                     "n characters, of TYPE_BIN n bytes), which a connection may set, as PLC.Input.ID. Elements "
                     "lie one after the other, a bit in each byte of an array of bits. The name is known in all "
                     "files; DFM and DS declare it no second time. The variable takes the default, if there is "
                     "one. Shared by itself.",
              .example = "DEF_IN FEED,'Feed',TYPE_DWORD,222,ONDEMAND"},
     .effects = kInitOnly | kDeclares,
     .check = checkDefine,
     .lower = lowerDefine,
     .variant = static_cast<int>(nc::ExchangeKind::DefIn)},
    {.info = {.mnemonic = "DEF_OUT",
              .title = "declares a logical output",
              .group = "inputs and outputs",
              .operands = {kNewName, kIdentifier, kExchangeType, kDefaultValue, kPeriod},
              .ref = "27.6, l.13300",
              .doc = "Declares a variable of the type, or with `[n]` an array of n elements (of TYPE_STR a text of "
                     "n characters, of TYPE_BIN n bytes), from which connections may take their values, as "
                     "PLC.Output.ID. Elements lie one after the other, a bit in each byte of an array of bits. "
                     "The name is known in all files; DFM and DS declare it no second time. The variable takes the "
                     "default, if there is one. Shared by itself.",
              .example = "DEF_OUT TORQUE[8],'Torque',TYPE_REAL"},
     .effects = kInitOnly | kDeclares,
     .check = checkDefine,
     .lower = lowerDefine,
     .variant = static_cast<int>(nc::ExchangeKind::DefOut)},
    {.info = {.mnemonic = "UPDATE_IN",
              .title = "takes over a logical input at once",
              .group = "inputs and outputs",
              .operands = {out("val", kLogicalInput, "takes the value")},
              .ref = "27.7, l.13413",
              .doc = "The input, or the element of an array, takes the value that the output connected to it has "
                     "now; meant for inputs with the period ONDEMAND, which nothing else serves. Where nothing is "
                     "connected it stays.",
              .example = "UPDATE_IN INPUT1"},
     .effects = 0,
     .check = checkUpdate,
     .lower = lowerUpdate},
    {.info = {.mnemonic = "SHARE_VAR",
              .title = "gives a variable a public name",
              .group = "sharing",
              .operands = {in("val", "address", "is shared"), kShareName, kExchangeType, kLeast, kMost},
              .ref = "18.2.1, l.13618",
              .doc = "Screens and scenarios find the variable or text by the name, and with it two reals that hold "
                     "its least and its greatest value. They only read it; DEF_IN declares what they may write. "
                     "RLO becomes 1 where it is shared, 0 where the name has another meaning already.",
              .example = "SHARE_VAR POS,'PRESSURE',TYPE_DWORD,RATIO,RATIO"},
     .effects = kInitOnly | kSetsRlo,
     .check = checkShareVariable,
     .lower = lowerShareVariable},
    {.info = {.mnemonic = "SHARE_BIT",
              .title = "gives a bit a public name",
              .group = "sharing",
              .operands = {in("byte", "address", "is the bit's byte"), kShareName, kBit},
              .ref = "18.2.1, l.13705",
              .doc = "Screens and scenarios find the bit of the byte by the name. The byte is any, the name of the "
                     "bit gives its number. RLO becomes 1 where it is shared, 0 where the name has another meaning "
                     "already.",
              .example = "SHARE_BIT CELL1,'LIMIT',LAMP"},
     .effects = kInitOnly | kSetsRlo,
     .check = checkShareBit,
     .lower = lowerShareBit},
    {.info = {.mnemonic = "CNF_GET_INT",
              .title = "integer of the configuration",
              .group = "configuration",
              .operands = {out("val", "integer cell", "is read"), kIdentifier, defaultOf("bitwise value")},
              .ref = "16.1, l.16111",
              .doc = "Reads an integer parameter of the configuration. RLO becomes 1 where it is found; else 0, and "
                     "the default is stored, if there is one.",
              .example = "CNF_GET_INT POS,'TIM_WATER',6"},
     .effects = kSetsRlo,
     .check = checkConfiguration,
     .lower = lowerConfiguration,
     .variant = static_cast<int>(nc::ConfigurationKind::Integer)},
    {.info = {.mnemonic = "CNF_GET_REAL",
              .title = "real of the configuration",
              .group = "configuration",
              .operands = {out("val", "real cell", "is read"), kIdentifier, defaultOf("real value")},
              .ref = "16.1, l.16112",
              .doc = "Reads a real parameter of the configuration. RLO becomes 1 where it is found; else 0, and the "
                     "default is stored, if there is one.",
              .example = "CNF_GET_REAL RATIO,'GAIN',CNST.0.2"},
     .effects = kSetsRlo,
     .check = checkConfiguration,
     .lower = lowerConfiguration,
     .variant = static_cast<int>(nc::ConfigurationKind::Real)},
    {.info = {.mnemonic = "CNF_GET_STR",
              .title = "text of the configuration",
              .group = "configuration",
              .operands = {out("poin", "text", "is read"), kIdentifier, defaultOf("text or literal")},
              .ref = "16.1, l.16113",
              .doc = "Reads a text of the configuration, as far as there is room. RLO becomes 1 where it is found; "
                     "else 0, and the default is stored, if there is one.",
              .example = "CNF_GET_STR TEXT1,'TITLE','Ready'"},
     .effects = kSetsRlo,
     .check = checkConfiguration,
     .lower = lowerConfiguration,
     .variant = static_cast<int>(nc::ConfigurationKind::Text)},
    {.info = {.mnemonic = "CNF_GET_BIN",
              .title = "bytes of the configuration",
              .group = "configuration",
              .operands = {out("poin", "text", "is read"), kIdentifier, defaultOf("text or literal")},
              .ref = "16.1, l.16114",
              .doc = "Reads bytes of the configuration, without a terminator. RLO becomes 1 where it is found; else 0, "
                     "and the default is stored, if there is one.",
              .example = "CNF_GET_BIN TEXT1,'MASK'"},
     .effects = kSetsRlo,
     .check = checkConfiguration,
     .lower = lowerConfiguration,
     .variant = static_cast<int>(nc::ConfigurationKind::Binary)},
    {.info = {.mnemonic = "CNF_GET_BIT",
              .title = "bit of the configuration",
              .group = "configuration",
              .operands = {out("bit", "plain bit", "is read"), kIdentifier, defaultOf("bit or flag")},
              .ref = "16.1, l.16115",
              .doc = "Reads a bit of the configuration: 1 unless the integer is 0. RLO becomes 1 where it is found; "
                     "else 0, and the default is stored, if there is one.",
              .example = "CNF_GET_BIT LAMP,'LIM_SWITCH',0"},
     .effects = kSetsRlo,
     .check = checkConfiguration,
     .lower = lowerConfiguration,
     .variant = static_cast<int>(nc::ConfigurationKind::Bit)},
    {.info = {.mnemonic = "CONST_GET",
              .title = "constant of the PLC",
              .group = "configuration",
              .operands = {out("val", "integer cell", "is read"), kIdentifier},
              .ref = "16.2, l.16355",
              .doc = "Reads a constant of the PLC into the cell and DR. RLO becomes 1 where it is found; else RLO and "
                     "DR become 0 and the cell stays.",
              .example = "CONST_GET POS,'PUMP_START'"},
     .effects = kSetsRlo | kSetsDr,
     .check = checkConfiguration,
     .lower = lowerConfiguration,
     .variant = static_cast<int>(nc::ConfigurationKind::Constant)},
};

} // namespace rung::frontend::technol
