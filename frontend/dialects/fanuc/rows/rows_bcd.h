// Rows: functions on BCD digits, of older machines (inventory §6.4-§6.8). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

inline constexpr OperandInfo kChoice = {
    .name = "format", .kind = &kinds::kChoice, .access = Access::None, .doc = "0 constant, 1 address"};

constexpr OperandInfo digitsOr(std::string_view name) {
  return {.name = name, .kind = &kinds::kNumberOrDigits, .access = Access::Read, .min = 0, .max = 9999};
}
constexpr Row bcdArithmeticRow(int number, std::string_view mnemonic, std::string_view title, std::string_view doc,
                               std::string_view example, frontend::Arithmetic operation) {
  return rowOf(withOutput("arithmetic", {kByt, kRst, kAct},
                          {kChoice, in("first", kinds::kDigits), digitsOr("second"), out("result", kinds::kDigits)},
                          &lowerBcdArithmetic),
               number, mnemonic, title, "6.8, medium", doc, example, operation);
}
constexpr Row bcdCompareRow(int number, std::string_view mnemonic, std::string_view title, std::string_view doc,
                            std::string_view example, frontend::Relation relation) {
  return rowOf(withOutput("comparison", {kByt, kAct}, {kChoice, digitsOr("input"), in("comparison", kinds::kDigits)},
                          &lowerBcdCompare),
               number, mnemonic, title, "6.7, medium", doc, example, relation);
}
inline constexpr OperandInfo kElements = number("elements", 1, 9999, "number of elements");

inline constexpr Row kBcdRows[] = {
    rowOf(withCheck(withOutput("decoding", {kAct},
                               {in("code", kinds::kByte, "two BCD digits"),
                                number("decoded", 1, 9911, "NNDD: NN the digits, DD 01 low, 10 high, 11 both")},
                               &lowerBcdDecode),
                    &checkDecodedDigits),
          4, "DEC", "BCD decoding", "6.4, medium",
          "W1=1 when ACT=1 and the digits of the code that DD chooses are those of NN; the digit that is not compared "
          "is 0 in NN.",
          "RD F7.0\nSUB 4\nF10\n3011\nWRT R200.0"),
    rowOf(
        withWidth(withOutput("rotation",
                             {PinInfo{.name = "RN0", .doc = "positions begin with 0 or 1"}, kByt,
                              PinInfo{.name = "DIR", .doc = "0 always forward, 1 the shorter way"},
                              PinInfo{.name = "POS", .doc = "0 the target, 1 the position before it"},
                              PinInfo{.name = "INC", .doc = "0 the result is a position, 1 a number of steps"}, kAct},
                             {number("positions", 1, 9999), in("current", kinds::kDigits), in("target", kinds::kDigits),
                              out("result", kinds::kDigits)},
                             &lowerBcdRotation),
                  1),
        6, "ROT", "rotation control, BCD", "6.5, medium",
        "As ROTB, with positions in BCD and their number in the program.",
        "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK R0.3\nRD.STK R0.4\nRD.STK X9.0\nSUB 6\n12\nD11\nD13\nD15\nWRT Y9.0"),
    [] {
      Row row = rowOf(
          withCheck(withTable(withOutput("conversion", {kByt, kRst, kAct},
                                         {number("rows", 0, 99, "0: 100 rows"),
                                          in("index", kinds::kByte, "two BCD digits"), out("result", kinds::kDigits)},
                                         &lowerBcdTable)),
                    &checkCut),
          7, "COD", "code conversion by a table, BCD", "6.5, medium",
          "result := row `index` of the table that follows, the first being number 0; rows are numbers of two "
          "digits, with BYT=1 of four. W1=1 when the index is past the last row.",
          "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 7\n2\nD10\nD11\n10\n20\nWRT Y9.0");
      row.capacityAt = 0;
      row.mostRow = 9999;
      return row;
    }(),
    rowOf(withOutput("conversion",
                     {PinInfo{.name = "BYT", .doc = "0 one byte, 1 two bytes"},
                      PinInfo{.name = "CNV", .doc = "0 binary to BCD, 1 BCD to binary"}, kRst, kAct},
                     {in("source", kinds::kDigits), out("result", kinds::kDigits)}, &lowerBcdConversion),
          14, "DCNV", "binary and BCD, without sign", "6.5, medium",
          "W1=1 when a digit is above 9 or the number has too many digits; the result is not written then.",
          "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK X9.0\nSUB 14\nD10\nD12\nWRT Y9.0"),
    bcdCompareRow(15, "COMP", "comparison, BCD",
                  "W1=1 when the input is not greater than the comparison. ACT=0: W1 stays.",
                  "RD R0.0\nRD.STK X9.0\nSUB 15\n0\n10\nD10\nWRT Y9.0", frontend::kLessEqual),
    bcdCompareRow(16, "COIN", "coincidence, BCD", "W1=1 when both are equal. ACT=0: W1 stays.",
                  "RD R0.0\nRD.STK X9.0\nSUB 16\n0\n10\nD10\nWRT Y9.0", frontend::kEqual),
    rowOf(withOutput("data tables", {kByt, kRst, kAct},
                     {kElements, in("table", kinds::kDigitTable), in("searched", kinds::kDigits),
                      out("result", kinds::kDigits)},
                     &lowerBcdSearch),
          17, "DSCH", "search in a data table, BCD", "6.6, medium",
          "result := number of the lowest element that holds the searched data, in BCD, W1=0; W1=1 when there is none.",
          "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 17\n10\nD20\nD11\nD13\nWRT Y9.0"),
    rowOf(withDirection(
              withOutput("data tables",
                         {kByt, PinInfo{.name = "RW", .doc = "0 read from the table, 1 write into it"}, kRst, kAct},
                         {kElements, inout("table", kinds::kDigitTable), inout("data", kinds::kDigits),
                          in("index", kinds::kDigits)},
                         &lowerBcdIndexedMove),
              1),
          18, "XMOV", "indexed transfer, BCD", "6.6, medium",
          "Moves data between a place and the element of a table whose number, in BCD, is the index. W1=1 when the "
          "index is not below the number of elements; nothing is moved then. With R9091.0 or R9091.1 as RW what is "
          "only read may be in X or F.",
          "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK X9.0\nSUB 18\n10\nD20\nD11\nD13\nWRT Y9.0"),
    bcdArithmeticRow(19, "ADD", "addition, BCD",
                     "result := first + second. W1=1 when the sum has too many digits; its low digits are stored.",
                     "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 19\n0\nD10\n25\nD12\nWRT Y9.0", frontend::kAdd),
    bcdArithmeticRow(20, "SUB", "subtraction, BCD",
                     "result := first - second. W1=1 when the difference is negative; its complement is stored.",
                     "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 20\n0\nD10\n25\nD12\nWRT Y9.0", frontend::kSubtract),
    bcdArithmeticRow(21, "MUL", "multiplication, BCD",
                     "result := first * second. W1=1 when the product has too many digits; its low digits are stored.",
                     "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 21\n0\nD10\n25\nD12\nWRT Y9.0", frontend::kMultiply),
    bcdArithmeticRow(
        22, "DIV", "division, BCD",
        "result := first / second, without the remainder. W1=1 when the divisor is 0, which changes nothing "
        "else.",
        "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 22\n0\nD10\n25\nD12\nWRT Y9.0", frontend::kDivide),
    [] {
      Row row =
          rowOf(withCheck(withoutOutput("arithmetic", {number("constant", 0, 9999), out("target", kinds::kDigits)},
                                        &lowerBcdNumber),
                          &checkCut),
                23, "NUME", "definition of a constant, BCD", "6.8, medium",
                "target := constant in BCD. ACT=0: nothing happens.", "RD R0.0\nRD.STK X9.0\nSUB 23\n25\nD10");
      row.info.pins = {kByt, kAct};
      return row;
    }(),
};

} // namespace rung::frontend::fanuc
