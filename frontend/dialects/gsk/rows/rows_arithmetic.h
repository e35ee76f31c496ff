// Rows: arithmetic, edges, shifts, logic: FUNC 21-32 (man. Part I §5.22-§5.33). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/gsk/rows/row_parts.h"

namespace rung::frontend::gsk {

constexpr Row arithmeticShape(std::string_view first, std::string_view second, LowerFn lower) {
  return {{.info = {.group = "arithmetic",
                    .pins = {kRst, kAct},
                    .operands = {kFormatA, in(first, kinds::kData), in(second, kinds::kConstantOrData),
                                 out("result", kinds::kData)},
                    .output = Output::Always,
                    .stateful = true}},
          lower};
}
inline constexpr Row kEdgeShape = {{.info = {.group = "edges",
                                             .pins = {kAct},
                                             .operands = {number("number", 1, 200)},
                                             .output = Output::Always,
                                             .stateful = true},
                                    .numbers = Row::Numbers::Edge},
                                   &lowerEdge};
inline constexpr Row kLogicShape = {
    {.info = {.group = "logic",
              .pins = {kAct},
              .operands = {kFormatA, in("A", kinds::kData), in("B", kinds::kConstantOrData), out("C", kinds::kData)}}},
    &lowerLogic};

inline constexpr Row kArithmeticRows[] = {
    rowOf(arithmeticShape("augend", "addend", &lowerArithmetic), 21, "ADDB", "addition", "5.22, l.2121",
          "result := augend + addend, signed. OUT=1 when the sum does not fit; the low bytes are stored all the same "
          "(P38). R1000 gets zero (bit 0), negative (bit 1), overflow (bit 5) (P22).",
          "LD R0.0\nLD X9.0\nFUNC 21\nPRM 0002\nPRM D10\nPRM 1000\nPRM D20\nOUT R10.0", kAdd),
    rowOf(arithmeticShape("minuend", "subtrahend", &lowerArithmetic), 22, "SUBB", "subtraction", "5.23, l.2188",
          "result := minuend - subtrahend, signed; else as ADDB.",
          "LD R0.0\nLD X9.0\nFUNC 22\nPRM 0002\nPRM D10\nPRM 1000\nPRM D20\nOUT R10.0", kSubtract),
    rowOf(arithmeticShape("multiplicand", "multiplier", &lowerArithmetic), 23, "MULB", "multiplication", "5.24, l.2251",
          "result := multiplicand * multiplier, signed; else as ADDB. RST=1: OUT=0 (P16).",
          "LD R0.0\nLD X9.0\nFUNC 23\nPRM 0002\nPRM D10\nPRM 3\nPRM D20\nOUT R10.0", kMultiply),
    rowOf(arithmeticShape("dividend", "divisor", &lowerDivision), 24, "DIVB", "division", "5.25, l.2318",
          "result := dividend / divisor, toward zero (P37); the remainder, with the sign of the dividend, goes to "
          "R1002. OUT=1 when the divisor is 0, which changes nothing else (P38), or when the quotient does not fit. "
          "RST=1: OUT=0 (P16).",
          "LD R0.0\nLD X9.0\nFUNC 24\nPRM 0002\nPRM D10\nPRM 3\nPRM D20\nOUT R10.0"),
    {{.info = {.mnemonic = "NUMEB",
               .title = "definition of a constant",
               .group = "arithmetic",
               .number = 25,
               .pins = {kAct},
               .operands = {kFormat, in("constant", kinds::kConstant), out("target", kinds::kData)},
               .ref = "5.26, l.2385",
               .doc = "target := constant. ACT=0: nothing happens.",
               .example = "LD X9.0\nFUNC 25\nPRM 2\nPRM 1000\nPRM D10"}},
     &lowerNumber},

    rowOf(kEdgeShape, 26, "DIFU", "rising edge", "5.27, l.2427",
          "OUT=1 for one scan after ACT has become 1. The memory belongs to the instruction, not to the number (P39).",
          "LD X9.0\nFUNC 26\nPRM 1\nOUT R9.0", kRising),
    rowOf(kEdgeShape, 27, "DIFD", "falling edge", "5.28, l.2465",
          "OUT=1 for one scan after ACT has become 0. The memory belongs to the instruction, not to the number (P39).",
          "LD X9.0\nFUNC 27\nPRM 2\nOUT R9.1", kFalling),
    {{.info = {.mnemonic = "SFT",
               .title = "shift register",
               .group = "shifts",
               .number = 28,
               .pins = {PinInfo{.name = "DIR", .doc = "0 left, 1 right"},
                        PinInfo{.name = "CONT", .doc = "1: bits that were 1 stay 1"}, kRst, kAct},
               .operands = {inout("data", kinds::kWord)},
               .output = Output::Always,
               .stateful = true,
               .ref = "5.29, l.2503",
               .doc =
                   "Shifts two bytes by one bit in every scan with ACT=1. OUT=1 when a 1 fell out. RST=1: OUT=0, the "
                   "data stay (P40).",
               .example = "LD R0.0\nLD R0.1\nLD R0.2\nLD X9.0\nFUNC 28\nPRM D10\nOUT Y9.0"}},
     &lowerShift},

    rowOf(kLogicShape, 29, "EOR", "exclusive or of bytes", "5.30, l.2565", "C := A xor B. ACT=0: nothing happens.",
          "LD X9.0\nFUNC 29\nPRM 0001\nPRM D10\nPRM 85\nPRM D11", kXor),
    rowOf(kLogicShape, 30, "ANDF", "and of bytes", "5.31, l.2621", "C := A and B. ACT=0: nothing happens.",
          "LD X9.0\nFUNC 30\nPRM 0001\nPRM D10\nPRM 85\nPRM D11", kAnd),
    rowOf(kLogicShape, 31, "ORF", "or of bytes", "5.32, l.2676", "C := A or B. ACT=0: nothing happens.",
          "LD X9.0\nFUNC 31\nPRM 0001\nPRM D10\nPRM 85\nPRM D11", kOr),
    {{.info = {.mnemonic = "NOT",
               .title = "complement of bytes",
               .group = "logic",
               .number = 32,
               .pins = {kAct},
               .operands = {kFormat, in("A", kinds::kData), out("B", kinds::kData)},
               .ref = "5.33, l.2732",
               .doc = "B := not A. ACT=0: nothing happens.",
               .example = "LD X9.0\nFUNC 32\nPRM 1\nPRM D10\nPRM D11"}},
     &lowerNot},
};

} // namespace rung::frontend::gsk
