// Rows: inputs and outputs, sharing, configuration, constants (man. ch. 10, 16, 18, 27). Included by instructions.cpp
// only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/row_parts.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

inline constexpr OperandInfo kIdentifier = in("ID", kinds::kTextOrLiteral, "identifier");
constexpr OperandInfo defaultOf(const OperandKind& kind) {
  return optional(in("default", kind, "value where it is not found"));
}

inline constexpr OperandInfo kNewInput = out("bit", kinds::kNewBit, "is declared");
inline constexpr OperandInfo kNewCell = out("val", kinds::kNewReal, "is declared");
inline constexpr OperandInfo kNewName = out("val", kinds::kNewVariable, "is declared");
inline constexpr OperandInfo kExchangeType = in("type", kinds::kType, "of the variable");
inline constexpr OperandInfo kDefaultBit = {.name = "def",
                                            .kind = &kinds::kDefaultBit,
                                            .doc = "value without configuration",
                                            .min = 0,
                                            .max = 1,
                                            .optional = true};
inline constexpr OperandInfo kDefaultReal = optional(in("def", kinds::kDefaultReal, "value without configuration"));
inline constexpr OperandInfo kDefaultValue = {.name = "def",
                                              .kind = &kinds::kDefaultValue,
                                              .doc = "value where nothing is connected",
                                              .min = INT64_MIN,
                                              .max = INT64_MAX,
                                              .optional = true};
inline constexpr OperandInfo kFast =
    optional(in("period", kinds::kFast, "how often it is served; without it every cycle"));
inline constexpr OperandInfo kPeriod = optional(in("period", kinds::kPeriod, "how often a connection is served"));
inline constexpr OperandInfo kShareName = in("name", kinds::kTextOrLiteral, "its name");
inline constexpr OperandInfo kLeast = optional(in("min", kinds::kLimitOrLength, "least value, or bytes of a text"));
inline constexpr OperandInfo kMost = optional(in("max", kinds::kRealCell, "greatest value"));
inline constexpr OperandInfo kBit = in("bit", kinds::kBitName, "which bit of the byte");

constexpr Row definitionShape(OperandList operands) {
  return {.info = {.group = "inputs and outputs", .operands = operands},
          .effects = kInitOnly | kDeclares,
          .check = checkDefine,
          .lower = lowerDefine};
}
inline constexpr Row kMappedBitShape = definitionShape({kNewInput, kIdentifier, kDefaultBit, kFast});
inline constexpr Row kMappedRealShape = definitionShape({kNewCell, kIdentifier, kDefaultReal, kFast});
inline constexpr Row kLogicalShape = definitionShape({kNewName, kIdentifier, kExchangeType, kDefaultValue, kPeriod});

constexpr Row configurationShape(OperandList operands, uint16_t effects = kSetsRlo) {
  return {.info = {.group = "configuration", .operands = operands},
          .effects = effects,
          .check = checkConfiguration,
          .lower = lowerConfiguration};
}

inline constexpr Row kNcRows[] = {
    rowOf(kMappedBitShape, "MAP_IN", "declares a mapped input", "10.4, l.5767",
          "Declares a bit that is copied from the input port its configuration names, inverted where that says so, "
          "before each cycle, with FAST each millisecond. The variable is declared by this instruction alone, without "
          "DFM or DS, and is known in all files. Where the identifier has no configuration, the variable takes the "
          "default, which else is the configuration's. Shared by itself.",
          "MAP_IN LIMIT_X,'inLimX',0,FAST", static_cast<int>(nc::ExchangeKind::MapIn)),
    rowOf(kMappedBitShape, "MAP_OUT", "declares a mapped output", "10.4, l.5768",
          "Declares a bit that is copied to the output port its configuration names after each cycle, with FAST each "
          "millisecond. Several outputs on one bit are ORed. The variable is declared by this instruction alone, "
          "without DFM or DS, and is known in all files. Where the identifier has no configuration, the variable takes "
          "the default, which else is the configuration's. Shared by itself.",
          "MAP_OUT ENABLE_X,'outXEn'", static_cast<int>(nc::ExchangeKind::MapOut)),
    rowOf(kMappedRealShape, "MAP_AIN", "declares a mapped analogue input", "10.5, l.5850",
          "Declares a real that follows a physical analogue input: its voltage plus Offset, times Scale, held between "
          "MinVal and MaxVal. The variable is declared by this instruction alone, without DFM or DS, and is known in "
          "all files. Where the identifier has no configuration, the variable takes the default, which else is the "
          "configuration's. Shared by itself.",
          "MAP_AIN VOLTAGE,'PlasmaVoltage',120.0", static_cast<int>(nc::ExchangeKind::MapAin)),
    rowOf(kMappedRealShape, "MAP_AOUT", "declares a mapped analogue output", "10.5, l.5851",
          "Declares a real that sets a physical analogue output: held between MinVal and MaxVal, times Scale, plus "
          "Offset. The variable is declared by this instruction alone, without DFM or DS, and is known in all files. "
          "Where the identifier has no configuration, the variable takes the default, which else is the "
          "configuration's. Shared by itself.",
          "MAP_AOUT FLOW,'CutFlow',30.0", static_cast<int>(nc::ExchangeKind::MapAout)),
    rowOf(kLogicalShape, "DEF_IN", "declares a logical input", "27.6, l.13299",
          "Declares a variable of the type, or with `[n]` an array of n elements (of TYPE_STR a text of n characters, "
          "of TYPE_BIN n bytes), which a connection may set, as PLC.Input.ID. Elements lie one after the other, a bit "
          "in each byte of an array of bits. The name is known in all files; DFM and DS declare it no second time. The "
          "variable takes the default, if there is one. Shared by itself.",
          "DEF_IN FEED,'Feed',TYPE_DWORD,222,ONDEMAND", static_cast<int>(nc::ExchangeKind::DefIn)),
    rowOf(kLogicalShape, "DEF_OUT", "declares a logical output", "27.6, l.13300",
          "Declares a variable of the type, or with `[n]` an array of n elements (of TYPE_STR a text of n characters, "
          "of TYPE_BIN n bytes), from which connections may take their values, as PLC.Output.ID. Elements lie one "
          "after the other, a bit in each byte of an array of bits. The name is known in all files; DFM and DS declare "
          "it no second time. The variable takes the default, if there is one. Shared by itself.",
          "DEF_OUT TORQUE[8],'Torque',TYPE_REAL", static_cast<int>(nc::ExchangeKind::DefOut)),
    {.info =
         {.mnemonic = "UPDATE_IN",
          .title = "takes over a logical input at once",
          .group = "inputs and outputs",
          .operands = {out("val", kinds::kLogicalInput, "takes the value")},
          .ref = "27.7, l.13413",
          .doc =
              "The input, or the element of an array, takes the value that the output connected to it has now; meant "
              "for inputs with the period ONDEMAND, which nothing else serves. Where nothing is connected it stays.",
          .example = "UPDATE_IN INPUT1"},
     .effects = 0,
     .check = checkUpdate,
     .lower = lowerUpdate},
    {.info = {.mnemonic = "SHARE_VAR",
              .title = "gives a variable a public name",
              .group = "sharing",
              .operands = {in("val", kinds::kAddress, "is shared"), kShareName, kExchangeType, kLeast, kMost},
              .ref = "18.2.1, l.13618",
              .doc = "Screens and scenarios find the variable or text by the name, and with it two reals that hold its "
                     "least and its greatest value. They only read it; DEF_IN declares what they may write. RLO "
                     "becomes 1 where it is shared, 0 where the name has another meaning already.",
              .example = "SHARE_VAR POS,'PRESSURE',TYPE_DWORD,RATIO,RATIO"},
     .effects = kInitOnly | kSetsRlo,
     .check = checkShareVariable,
     .lower = lowerShareVariable},
    {.info = {.mnemonic = "SHARE_BIT",
              .title = "gives a bit a public name",
              .group = "sharing",
              .operands = {in("byte", kinds::kAddress, "is the bit's byte"), kShareName, kBit},
              .ref = "18.2.1, l.13705",
              .doc =
                  "Screens and scenarios find the bit of the byte by the name. The byte is any, the name of the bit "
                  "gives its number. RLO becomes 1 where it is shared, 0 where the name has another meaning already.",
              .example = "SHARE_BIT CELL1,'LIMIT',LAMP"},
     .effects = kInitOnly | kSetsRlo,
     .check = checkShareBit,
     .lower = lowerShareBit},
    rowOf(
        configurationShape({out("val", kinds::kIntegerCell, "is read"), kIdentifier, defaultOf(kinds::kBitwiseValue)}),
        "CNF_GET_INT", "integer of the configuration", "16.1, l.16111",
        "Reads an integer parameter of the configuration. RLO becomes 1 where it is found; else 0, and the default is "
        "stored, if there is one.",
        "CNF_GET_INT POS,'TIM_WATER',6", static_cast<int>(nc::ConfigurationKind::Integer)),
    rowOf(configurationShape({out("val", kinds::kRealCell, "is read"), kIdentifier, defaultOf(kinds::kRealValue)}),
          "CNF_GET_REAL", "real of the configuration", "16.1, l.16112",
          "Reads a real parameter of the configuration. RLO becomes 1 where it is found; else 0, and the default is "
          "stored, if there is one.",
          "CNF_GET_REAL RATIO,'GAIN',CNST.0.2", static_cast<int>(nc::ConfigurationKind::Real)),
    rowOf(configurationShape({out("poin", kinds::kText, "is read"), kIdentifier, defaultOf(kinds::kTextOrLiteral)}),
          "CNF_GET_STR", "text of the configuration", "16.1, l.16113",
          "Reads a text of the configuration, as far as there is room. RLO becomes 1 where it is found; else 0, and "
          "the default is stored, if there is one.",
          "CNF_GET_STR TEXT1,'TITLE','Ready'", static_cast<int>(nc::ConfigurationKind::Text)),
    rowOf(configurationShape({out("poin", kinds::kText, "is read"), kIdentifier, defaultOf(kinds::kTextOrLiteral)}),
          "CNF_GET_BIN", "bytes of the configuration", "16.1, l.16114",
          "Reads bytes of the configuration, without a terminator. RLO becomes 1 where it is found; else 0, and the "
          "default is stored, if there is one.",
          "CNF_GET_BIN TEXT1,'MASK'", static_cast<int>(nc::ConfigurationKind::Binary)),
    rowOf(configurationShape({out("bit", kinds::kPlainBit, "is read"), kIdentifier, defaultOf(kinds::kBitOrFlag)}),
          "CNF_GET_BIT", "bit of the configuration", "16.1, l.16115",
          "Reads a bit of the configuration: 1 unless the integer is 0. RLO becomes 1 where it is found; else 0, and "
          "the default is stored, if there is one.",
          "CNF_GET_BIT LAMP,'LIM_SWITCH',0", static_cast<int>(nc::ConfigurationKind::Bit)),
    rowOf(configurationShape({out("val", kinds::kIntegerCell, "is read"), kIdentifier}, kSetsRlo | kSetsDr),
          "CONST_GET", "constant of the PLC", "16.2, l.16355",
          "Reads a constant of the PLC into the cell and DR. RLO becomes 1 where it is found; else RLO and DR become 0 "
          "and the cell stays.",
          "CONST_GET POS,'PUMP_START'", static_cast<int>(nc::ConfigurationKind::Constant)),
};

} // namespace rung::frontend::technol
