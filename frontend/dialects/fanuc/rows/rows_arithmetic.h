// Rows: binary arithmetic, bits (inventory §6.8, §6.9). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

constexpr Row arithmeticShape(std::string_view first, std::string_view second, LowerFn lower) {
  return withOutput(
      "arithmetic", {kRst, kAct},
      {kFormatA, in(first, kinds::kData), in(second, kinds::kConstantOrData), out("result", kinds::kData)}, lower);
}
inline constexpr Row kLogicShape =
    withoutOutput("logic", {kFormatA, in("A", kinds::kData), in("B", kinds::kConstantOrData), out("C", kinds::kData)},
                  &network::lowerLogic);

inline constexpr Row kArithmeticRows[] = {
    rowOf(arithmeticShape("augend", "addend", &network::lowerArithmetic), 36, "ADDB", "addition", "6.8, high",
          "result := augend + addend, signed. W1=1 when the sum does not fit; the low bytes are stored all the same. "
          "R9000 gets zero (bit 0), negative (bit 1), overflow (bit 5). RST=1: W1=0. ACT=0: W1 stays.",
          "RD R0.0\nRD.STK X9.0\nSUB 36\n0002\nD10\n1000\nD20\nWRT R10.0", kAdd),
    rowOf(arithmeticShape("minuend", "subtrahend", &network::lowerArithmetic), 37, "SUBB", "subtraction", "6.8, high",
          "result := minuend - subtrahend, signed; else as ADDB.",
          "RD R0.0\nRD.STK X9.0\nSUB 37\n0002\nD10\n1000\nD20\nWRT R10.0", kSubtract),
    rowOf(arithmeticShape("multiplicand", "multiplier", &network::lowerArithmetic), 38, "MULB", "multiplication",
          "6.8, high", "result := multiplicand * multiplier, signed; else as ADDB.",
          "RD R0.0\nRD.STK X9.0\nSUB 38\n0002\nD10\n3\nD20\nWRT R10.0", kMultiply),
    rowOf(
        arithmeticShape("dividend", "divisor", &network::lowerDivision), 39, "DIVB", "division", "6.8, high",
        "result := dividend / divisor, toward zero; the remainder, with the sign of the dividend, goes to R9002. W1=1 "
        "when the divisor is 0, which changes nothing else (F15), or when the quotient does not fit; else as ADDB.",
        "RD R0.0\nRD.STK X9.0\nSUB 39\n0002\nD10\n3\nD20\nWRT R10.0"),
    rowOf(withoutOutput("arithmetic", {kFormatN, in("constant", kinds::kConstant), out("target", kinds::kElements)},
                        &network::lowerNumber),
          40, "NUMEB", "definition of a constant", "6.8, high",
          "target := constant; with nn in the format each of nn elements. ACT=0: nothing happens.",
          "RD X9.0\nSUB 40\n2\n1000\nD10"),

    rowOf(kLogicShape, 59, "EOR", "exclusive or of bytes", "6.9, high", "C := A xor B. ACT=0: nothing happens.",
          "RD X9.0\nSUB 59\n0001\nD10\n85\nD11", kXor),
    rowOf(kLogicShape, 60, "ANDF", "and of bytes", "6.9, high",
          "C := A and B. ACT=0: nothing happens. AND without an operand on its line is this function, SUB 60.",
          "RD X9.0\nSUB 60\n0001\nD10\n85\nD11", kAnd),
    rowOf(kLogicShape, 61, "ORF", "or of bytes", "6.9, high",
          "C := A or B. ACT=0: nothing happens. OR without an operand on its line is this function, SUB 61.",
          "RD X9.0\nSUB 61\n0001\nD10\n85\nD11", kOr),
    rowOf(withoutOutput("logic", {kFormat, in("A", kinds::kData), out("B", kinds::kData)}, &network::lowerNot), 62,
          "NOT", "complement of bytes", "6.9, high", "B := not A. ACT=0: nothing happens.",
          "RD X9.0\nSUB 62\n1\nD10\nD11"),
    rowOf(withOutput("shifts",
                     {PinInfo{.name = "DIR", .doc = "0 left, 1 right"},
                      PinInfo{.name = "CONT", .doc = "1: bits that were 1 stay 1"}, kRst, kAct},
                     {inout("data", kinds::kWord)}, &network::lowerShift),
          33, "SFT", "shift register", "6.9, medium",
          "Shifts two bytes by one bit in every scan with ACT=1. W1=1 when a 1 fell out. RST=1: W1=0, the data stay.",
          "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK X9.0\nSUB 33\nD10\nWRT Y9.0"),
    rowOf(withOutput("checks", {PinInfo{.name = "OE", .doc = "0 even, 1 odd parity demanded"}, kRst, kAct},
                     {in("data", kinds::kByte)}, &network::lowerParity),
          11, "PARI", "parity check", "6.9, medium",
          "W1=1 when the number of ones in the byte does not have the demanded parity. ACT=0: W1 stays.",
          "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 11\nD10\nWRT Y9.0"),
};

} // namespace rung::frontend::fanuc
