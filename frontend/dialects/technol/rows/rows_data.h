// Rows: data, arithmetic, comparisons, conversions (man. ch. 3.9-3.16). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/instructions.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

// A cell has at most 8 bits (man. l.1280).
inline constexpr OperandInfo kShiftCount = {
    .name = "n", .kind = &kinds::kShiftCount, .doc = "by how many bits", .min = 0, .max = 255};

inline constexpr Row kStoreIfShape = {
    .info = {.group = "data", .operands = {out("val", kinds::kCell, "becomes DR")}, .terminating = true},
    .effects = kReadsDr | kReadsRlo,
    .check = checkRealUse,
    .lower = lowerStore};
inline constexpr Row kSumShape = {
    .info = {.group = "arithmetic", .operands = {in("val", kinds::kValue, "the second operand")}},
    .effects = kReadsDr | kSetsDr,
    .check = checkArithmetic,
    .lower = lowerArithmetic};
inline constexpr Row kProductShape = {
    .info = {.group = "arithmetic", .operands = {in("val", kinds::kNarrowValue, "the second operand")}},
    .effects = kReadsDr | kSetsDr,
    .check = checkArithmetic,
    .lower = lowerArithmetic};
inline constexpr Row kBitwiseShape = {
    .info = {.group = "bitwise", .operands = {in("val", kinds::kBitwiseValue, "the second operand")}},
    .effects = kReadsDr | kSetsDr,
    .lower = lowerBitwise};
inline constexpr Row kUnaryShape = {.info = {.group = "DR operation", .operands = {widthOf(kinds::kWidth)}},
                                    .effects = kReadsDr | kSetsDr,
                                    .check = checkRealUse,
                                    .lower = lowerUnary};
inline constexpr Row kShiftShape = {
    .info = {.group = "DR operation", .operands = {kShiftCount, widthOf(kinds::kIntegerWidth)}},
    .effects = kReadsDr | kSetsDr,
    .lower = lowerShift};
inline constexpr Row kCompareShape = {
    .info = {.group = "comparison", .operands = {in("val", kinds::kValue, "compared with DR")}},
    .effects = kReadsDr | kSetsRlo,
    .check = checkRealUse,
    .lower = lowerCompare};

constexpr Row moveShape(uint16_t effects) {
  return {.info = {.group = "data",
                   .operands = {out("dst", kinds::kCell, "becomes the source"), in("src", kinds::kCell, "is read")},
                   .terminating = effects == kReadsRlo},
          .effects = effects,
          .check = checkMove,
          .lower = lowerMove};
}
// Works on decimal digits in DR.
constexpr Row decimalShape(LowerFn lower, OperandList operands = {}) {
  return {.info = {.group = "DR operation", .operands = operands}, .effects = kReadsDr | kSetsDr, .lower = lower};
}

inline constexpr Row kDataRows[] = {
    // ---- load and store (man. ch. 3.10) ---------------------------------------------------------------------------
    {.info = {.mnemonic = "LOD",
              .title = "load",
              .group = "data",
              .operands = {in("val", kinds::kSignedValue, "is loaded")},
              .ref = "3.10, l.673",
              .doc = "DR becomes the value, sign-extended to 64 bits. With REAL. or a real constant DR_REAL becomes "
                     "it, and DR its integer.",
              .example = "LOD  WORD.SPEED\nLOD  -CNST.5"},
     .effects = kSetsDr,
     .check = checkLoad,
     .lower = lowerLoad},
    {.info = {.mnemonic = "STO",
              .title = "store",
              .group = "data",
              .operands = {out("val", kinds::kCell, "becomes DR")},
              .ref = "3.10, l.740",
              .doc = "The cell becomes the low bits of DR; with REAL. it becomes DR_REAL.",
              .example = "LOD  COUNT\nSTO  LIMIT"},
     .effects = kReadsDr,
     .check = checkRealUse,
     .lower = lowerStore,
     .variant = kAlways},
    rowOf(kStoreIfShape, "STO1", "store if 1", "3.10, l.771", "As STO, but only while RLO is 1.",
          "LDR  GO\nLOD  COUNT\nSTO1 LIMIT", kIfRlo),
    rowOf(kStoreIfShape, "STO0", "store if 0", "3.10, l.783", "As STO, but only while RLO is 0.",
          "LDR  GO\nLOD  COUNT\nSTO0 LIMIT", kIfNotRlo),
    rowOf(moveShape(0), "MOVE", "move", "3.10, l.795", "One cell becomes another of the same type; RLO and DR stay.",
          "MOVE LIMIT,COUNT", kAlways),
    rowOf(moveShape(kReadsRlo), "MOVE1", "move if 1", "3.10, l.797", "As MOVE, but only while RLO is 1.",
          "LDR  GO\nMOVE1 LIMIT,COUNT", kIfRlo),
    // ---- arithmetic (man. ch. 3.12) -------------------------------------------------------------------------------
    rowOf(kSumShape, "AD", "add", "3.12, l.1006",
          "The part of DR in the width of the operand becomes the sum; the rest stays. With REAL. or a real constant "
          "DR_REAL is added to.",
          "LOD  COUNT\nAD   LIMIT\nSTO  COUNT", kAdd),
    rowOf(kSumShape, "SU", "subtract", "3.12, l.1008",
          "The part of DR in the width of the operand becomes the difference; the rest stays. With REAL. or a real "
          "constant DR_REAL is subtracted from.",
          "LOD  COUNT\nSU   LIMIT\nSTO  COUNT", kSubtract),
    rowOf(kProductShape, "MULB", "multiply", "3.12, l.1065",
          "DR becomes the signed product of its low part and the operand, sign-extended to 64 bits.",
          "LOD  COUNT\nMULB CNST.3\nSTO  COUNT", kMultiply),
    rowOf(kProductShape, "DIVB", "divide", "3.12, l.1067",
          "DR becomes the signed quotient, rounded toward zero. BYTE divides 16 bits of DR, WORD 32, DWORD and "
          "constants 64. A zero divisor or a quotient beyond 32 bits stops the program.",
          "LOD  COUNT\nDIVB LIMIT\nSTO  COUNT", kDivide),
    rowOf(kBitwiseShape, "ORB", "bitwise or", "3.12, l.1171",
          "The part of DR in the width of the operand becomes its bitwise OR with the operand; the rest stays.",
          "LOD  COUNT\nORB  CNST.80h\nSTO  COUNT", kOr),
    rowOf(kBitwiseShape, "ANDB", "bitwise and", "3.12, l.1172",
          "The part of DR in the width of the operand becomes its bitwise AND with the operand; the rest stays.",
          "LOD  COUNT\nANDB CNST.0Fh\nSTO  COUNT", kAnd),
    rowOf(
        kBitwiseShape, "XORB", "bitwise exclusive or", "3.12, l.1173",
        "The part of DR in the width of the operand becomes its bitwise EXCLUSIVE OR with the operand; the rest stays.",
        "LOD  COUNT\nXORB LIMIT\nSTO  COUNT", kXor),
    // ---- operations on DR (man. ch. 3.13) -------------------------------------------------------------------------
    rowOf(kUnaryShape, "INR", "increment", "3.13, l.1201",
          "DR plus 1 in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The rest of DR stays.",
          "LOD  COUNT\nINR\nSTO  COUNT", kIncrement),
    rowOf(kUnaryShape, "DCR", "decrement", "3.13, l.1202",
          "DR minus 1 in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The rest of DR stays.",
          "LOD  COUNT\nDCR\nSTO  COUNT", kDecrement),
    rowOf(kUnaryShape, "INV", "negate", "3.13, l.1289",
          "The two's complement of DR in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The "
          "rest of DR stays.",
          "LOD  POS\nINV  DWRD\nSTO  POS", kNegate),
    rowOf(kUnaryShape, "ABS", "absolute value", "3.13, l.1290",
          "The absolute value of DR in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The rest "
          "of DR stays.",
          "LOD  POS\nABS  DWRD\nSTO  POS", kAbsolute),
    rowOf(decimalShape(lowerIncrementBcd), "INRBCD", "increment BCD", "3.13, l.1203",
          "DR plus 1 as four decimal digits; 0 follows 9999.", "LOD  COUNT\nINRBCD\nSTO  COUNT"),
    rowOf(decimalShape(lowerBin, {widthOf(kinds::kDoubleWidth)}), "BIN", "BCD to binary", "3.13, l.1233",
          "The digits in DR become their number. With DWRD bit 31 marks a negative number.",
          "LOD  COUNT\nBIN\nSTO  COUNT"),
    rowOf(decimalShape(lowerBcd, {widthOf(kinds::kDoubleWidth)}), "BCD", "binary to BCD", "3.13, l.1234",
          "The number in DR becomes its digits, at most 4, with DWRD 8.", "LOD  POS\nBCD  DWRD\nSTO  POS"),
    rowOf(kShiftShape, "RL", "shift left", "3.13, l.1262",
          "Logical shift left of 16, 32 or 64 bits of DR; zeros come in.", "LOD  COUNT\nRL   2\nSTO  COUNT", 0),
    rowOf(kShiftShape, "RR", "shift right", "3.13, l.1264",
          "Logical shift right of 16, 32 or 64 bits of DR; zeros come in.", "LOD  POS\nRR   4,DWRD\nSTO  POS", 1),
    // ---- comparison (man. ch. 3.14) -------------------------------------------------------------------------------
    rowOf(kCompareShape, "EQ", "equal", "3.14, l.1369",
          "RLO shows whether DR equals the operand, signed, in the operand's width; with REAL. or a real constant "
          "DR_REAL.",
          "LOD  COUNT\nEQ   LIMIT\nWR   LAMP", kEqual),
    rowOf(kCompareShape, "LT", "less", "3.14, l.1371",
          "RLO shows whether DR is less than the operand, signed, in the operand's width; with REAL. or a real "
          "constant DR_REAL.",
          "LOD  COUNT\nLT   LIMIT\nWR   LAMP", kLess),
    rowOf(kCompareShape, "GT", "greater", "3.14, l.1372",
          "RLO shows whether DR is greater than the operand, signed, in the operand's width; with REAL. or a real "
          "constant DR_REAL.",
          "LOD  COUNT\nGT   LIMIT\nWR   LAMP", kGreater),
    rowOf(kCompareShape, "LE", "less or equal", "3.14, l.1373",
          "RLO shows whether DR is less than or equal to the operand, signed, in the operand's width; with REAL. or a "
          "real constant DR_REAL.",
          "LOD  COUNT\nLE   LIMIT\nWR   LAMP", kLessEqual),
    rowOf(kCompareShape, "GE", "greater or equal", "3.14, l.1374",
          "RLO shows whether DR is greater than or equal to the operand, signed, in the operand's width; with REAL. or "
          "a real constant DR_REAL.",
          "LOD  COUNT\nGE   LIMIT\nWR   LAMP", kGreaterEqual),
    {.info = {.mnemonic = "EQ1",
              .title = "equal if RLO",
              .group = "comparison",
              .operands = {in("val", kinds::kValue, "compared with DR")},
              .ref = "3.14, l.1370",
              .doc = "As EQ while RLO is 1; else RLO stays 0. A chain compares areas.",
              .example = "LOD  COUNT\nEQ   5\nLOD  LIMIT\nEQ1  7\nWR   LAMP"},
     .effects = kReadsDr | kReadsRlo | kSetsRlo,
     .check = checkRealUse,
     .lower = lowerCompare,
     .variant = kEqualIfRlo},
    // ---- conversions (man. ch. 3.15) ------------------------------------------------------------------------------
    {.info =
         {.mnemonic = "CONDR",
          .title = "DR to RLO",
          .group = "conversion",
          .operands = {OperandInfo{.name = "bits",
                                   .kind = &kinds::kBitsOfDr,
                                   .doc = "16 bits without it",
                                   .min = 0,
                                   .max = 31,
                                   .optional = true}},
          .ref = "3.15, l.1461",
          .doc = "RLO shows whether DR is not 0 in 16 bits, with DWRD in 32; with a number RLO becomes that bit of DR.",
          .example = "LOD  COUNT\nCONDR 7\nWR   LAMP"},
     .effects = kReadsDr | kSetsRlo,
     .lower = lowerDrToRlo},
    {.info = {.mnemonic = "CONRD",
              .title = "RLO to DR",
              .group = "conversion",
              .operands = {widthOf(kinds::kDoubleWidth)},
              .terminating = true,
              .ref = "3.15, l.1462",
              .doc = "DR becomes FFFFh for RLO 1 and 0 for 0; with DWRD FFFFFFFFh.",
              .example = "LDR  GO\nCONRD\nSTO  COUNT"},
     .effects = kReadsRlo | kSetsDr,
     .check = checkToInteger,
     .lower = lowerRloToDr},
    {.info = {.mnemonic = "REAL",
              .title = "integer to real",
              .group = "conversion",
              .operands = {widthOf(kinds::kIntegerWidth)},
              .ref = "3.15, l.1503",
              .doc = "DR_REAL becomes the signed integer in DR; DR keeps it, sign-extended.",
              .example = "LOD  COUNT\nREAL\nMULB REAL.RATIO\nSTO  REAL.RATIO"},
     .effects = kReadsDr | kSetsDr,
     .check = checkToReal,
     .lower = lowerToReal},
};

} // namespace rung::frontend::technol
