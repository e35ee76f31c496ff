// Rows: transfers, decoding, comparison, conversion, tables (inventory §6.4-§6.7). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

constexpr Row moveShape(const OperandKind& kind) {
  return withoutOutput("transfers", {in("source", kind), out("target", kind)}, &network::lowerMove);
}
constexpr Row rangeShape(const OperandKind& kind) {
  return withOutput("comparison", {kAct}, {in("bound 1", kind), in("bound 2", kind), in("input", kind)}, &lowerRange);
}
inline constexpr std::string_view kRangeDoc =
    "W1=1 when ACT=1 and the input lies between both bounds, bounds included, whichever of them is lower. Signed.";

// EQB to LED: relations of three lengths.
constexpr Row relationRow(const OperandKind& kind, int number, std::string_view mnemonic, std::string_view title,
                          std::string_view example, frontend::Relation relation) {
  return rowOf(withOutput("comparison", {kAct}, {in("data 1", kind), in("data 2", kind)}, &lowerRelation), number,
               mnemonic, title, "6.7, high",
               "W1=1 when ACT=1 and the relation of data 1 to data 2 holds, signed; otherwise W1=0.", example,
               relation);
}

inline constexpr Row kDataRows[] = {
    rowOf(withoutOutput("transfers",
                        {in("high mask", kinds::kMask), in("low mask", kinds::kMask), in("source", kinds::kByte),
                         out("target", kinds::kByte)},
                        &network::lowerMoveMasked),
          8, "MOVE", "masked transfer", "6.6, high", "target := source and mask. ACT=0: nothing happens.",
          "RD X9.0\nSUB 8\n0000\n1111\nD10\nD11"),
    rowOf(withoutOutput("transfers",
                        {in("source", kinds::kByte), in("or data", kinds::kByte), out("target", kinds::kByte)},
                        &network::lowerMoveOr),
          28, "MOVOR", "transfer with or", "6.6, high", "target := source or data. ACT=0: nothing happens.",
          "RD X9.0\nSUB 28\nD10\nD11\nD12"),
    rowOf(moveShape(kinds::kByte), 43, "MOVB", "transfer of a byte", "6.6, high",
          "target := source, one byte. ACT=0: nothing happens.", "RD X9.0\nSUB 43\nD10\nD11", 1),
    rowOf(moveShape(kinds::kWord), 44, "MOVW", "transfer of 2 bytes", "6.6, high",
          "target := source, two bytes. ACT=0: nothing happens.", "RD X9.0\nSUB 44\nD10\nD12", 2),
    rowOf(moveShape(kinds::kDword), 47, "MOVD", "transfer of 4 bytes", "6.6, high",
          "target := source, four bytes. ACT=0: nothing happens.", "RD X9.0\nSUB 47\nD10\nD14", 4),
    rowOf(withoutOutput("transfers",
                        {number("bytes", 1, 9999), in("source", kinds::kBlock), out("target", kinds::kBlock)},
                        &network::lowerMoveBlock),
          45, "MOVN", "transfer of a block", "6.6, high",
          "target := source; areas that overlap behave as if copied at once. ACT=0: nothing happens.",
          "RD X9.0\nSUB 45\n10\nD10\nD100"),

    rowOf(
        withoutOutput(
            "decoding",
            {kFormatN, in("code", kinds::kData), in("first code", kinds::kConstant), out("result", kinds::kBytes)},
            &network::lowerDecode),
        25, "DECB", "binary decoding", "6.4, high",
        "Bit i of the result becomes 1 when the code equals first code + i, the others 0: for eight codes, or with nn "
        "in the format for 8 nn codes in nn bytes. The code is compared in the given length only. ACT=0: all bits "
        "become 0.",
        "RD F7.0\nSUB 25\n1\nF10\n3\nR200"),
    rowOf(
        withTable(withOutput("conversion", {kRst, kAct},
                             {kFormat, number("rows", 1, 256), in("index", kinds::kByte), out("result", kinds::kData)},
                             &network::lowerCodeTable)),
        27, "CODB", "code conversion by a table", "6.5, high",
        "result := row `index` of the table that follows, the first being number 0. W1=1 when the index is past the "
        "last row.",
        "RD R0.0\nRD.STK X9.0\nSUB 27\n1\n2\nD10\nD11\n10\n20\nWRT Y9.0"),
    rowOf(
        withOutput("conversion",
                   {PinInfo{.name = "SIN", .doc = "sign of BCD input, 1 negative"},
                    PinInfo{.name = "CNV", .doc = "0 binary to BCD, 1 BCD to binary"}, kRst, kAct},
                   {kFormat, in("source", kinds::kData), out("result", kinds::kData)}, &network::lowerBcd),
        31, "DCNVB", "binary and BCD", "6.5, high",
        "Converts between signed binary and BCD of the same length. W1=1 when a digit is above 9 or the number has too "
        "many digits; the result is not written then. Binary to BCD: R9000.1 is the sign, R9000.5 the overflow.",
        "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK X9.0\nSUB 31\n2\nD10\nD12\nWRT Y9.0"),

    rowOf(
        withoutOutput("comparison", {kFormatA, in("input", kinds::kConstantOrData), in("comparison", kinds::kData)},
                      &lowerCompare),
        32, "COMPB", "comparison", "6.7, high",
        "Signed. R9000.0 becomes 1 when both are equal, R9000.1 when the input is less, otherwise 0; R9000.5 when the "
        "difference does not fit the length. ACT=0: nothing happens.",
        "RD X9.0\nSUB 32\n0001\n10\nD10"),
    relationRow(kinds::kEitherByte, 200, "EQB", "bytes: equal", "RD X9.0\nSUB 200\nR10\n5\nWRT Y9.0", frontend::kEqual),
    relationRow(kinds::kEitherWord, 201, "EQW", "2 bytes: equal", "RD X9.0\nSUB 201\nR10\n5\nWRT Y9.0",
                frontend::kEqual),
    relationRow(kinds::kEitherDword, 202, "EQD", "4 bytes: equal", "RD X9.0\nSUB 202\nR10\n5\nWRT Y9.0",
                frontend::kEqual),
    relationRow(kinds::kEitherByte, 203, "NEB", "bytes: not equal", "RD X9.0\nSUB 203\nR10\n5\nWRT Y9.0",
                frontend::kNotEqual),
    relationRow(kinds::kEitherWord, 204, "NEW", "2 bytes: not equal", "RD X9.0\nSUB 204\nR10\n5\nWRT Y9.0",
                frontend::kNotEqual),
    relationRow(kinds::kEitherDword, 205, "NED", "4 bytes: not equal", "RD X9.0\nSUB 205\nR10\n5\nWRT Y9.0",
                frontend::kNotEqual),
    relationRow(kinds::kEitherByte, 206, "GTB", "bytes: greater", "RD X9.0\nSUB 206\nR10\n5\nWRT Y9.0",
                frontend::kGreater),
    relationRow(kinds::kEitherWord, 207, "GTW", "2 bytes: greater", "RD X9.0\nSUB 207\nR10\n5\nWRT Y9.0",
                frontend::kGreater),
    relationRow(kinds::kEitherDword, 208, "GTD", "4 bytes: greater", "RD X9.0\nSUB 208\nR10\n5\nWRT Y9.0",
                frontend::kGreater),
    relationRow(kinds::kEitherByte, 209, "LTB", "bytes: less", "RD X9.0\nSUB 209\nR10\n5\nWRT Y9.0", frontend::kLess),
    relationRow(kinds::kEitherWord, 210, "LTW", "2 bytes: less", "RD X9.0\nSUB 210\nR10\n5\nWRT Y9.0", frontend::kLess),
    relationRow(kinds::kEitherDword, 211, "LTD", "4 bytes: less", "RD X9.0\nSUB 211\nR10\n5\nWRT Y9.0",
                frontend::kLess),
    relationRow(kinds::kEitherByte, 212, "GEB", "bytes: greater or equal", "RD X9.0\nSUB 212\nR10\n5\nWRT Y9.0",
                frontend::kGreaterEqual),
    relationRow(kinds::kEitherWord, 213, "GEW", "2 bytes: greater or equal", "RD X9.0\nSUB 213\nR10\n5\nWRT Y9.0",
                frontend::kGreaterEqual),
    relationRow(kinds::kEitherDword, 214, "GED", "4 bytes: greater or equal", "RD X9.0\nSUB 214\nR10\n5\nWRT Y9.0",
                frontend::kGreaterEqual),
    relationRow(kinds::kEitherByte, 215, "LEB", "bytes: less or equal", "RD X9.0\nSUB 215\nR10\n5\nWRT Y9.0",
                frontend::kLessEqual),
    relationRow(kinds::kEitherWord, 216, "LEW", "2 bytes: less or equal", "RD X9.0\nSUB 216\nR10\n5\nWRT Y9.0",
                frontend::kLessEqual),
    relationRow(kinds::kEitherDword, 217, "LED", "4 bytes: less or equal", "RD X9.0\nSUB 217\nR10\n5\nWRT Y9.0",
                frontend::kLessEqual),
    rowOf(rangeShape(kinds::kEitherByte), 218, "RNGB", "range of bytes", "6.7, high", kRangeDoc,
          "RD X9.0\nSUB 218\n1\n9\nR10\nWRT Y9.0"),
    rowOf(rangeShape(kinds::kEitherWord), 219, "RNGW", "range of 2 bytes", "6.7, high", kRangeDoc,
          "RD X9.0\nSUB 219\n1\n900\nR10\nWRT Y9.0"),
    rowOf(rangeShape(kinds::kEitherDword), 220, "RNGD", "range of 4 bytes", "6.7, high", kRangeDoc,
          "RD X9.0\nSUB 220\nD0\nD4\nR10\nWRT Y9.0"),

    rowOf(withOutput("data tables", {kRst, kAct},
                     {kFormat, in("entries", kinds::kData, "number of entries"), in("table", kinds::kTable),
                      in("searched", kinds::kData), out("result", kinds::kData)},
                     &network::lowerSearch),
          34, "DSCHB", "search in a data table", "6.6, medium",
          "result := number of the lowest entry that holds the searched data, W1=0; W1=1 when there is none. As many "
          "entries as given, from 0 on.",
          "RD R0.0\nRD.STK X9.0\nSUB 34\n1\nD10\nD20\nD11\nD12\nWRT Y9.0"),
    rowOf(withDirection(
              withOutput("data tables",
                         {PinInfo{.name = "RW", .doc = "0 read from the table, 1 write into it"}, kRst, kAct},
                         {kFormatN, in("entries", kinds::kData, "number of entries"), inout("table", kinds::kTable),
                          inout("data", kinds::kElements), in("index", kinds::kData)},
                         &network::lowerIndexedMove),
              0),
          35, "XMOVB", "indexed transfer", "6.6, high",
          "Moves data between a place and an entry of a table; with nn in the format that entry and those after it. "
          "W1=1 when the index is not below the number of entries; nothing is moved then. With R9091.0 or R9091.1 as "
          "RW what is only read may be in X or F.",
          "RD R0.0\nRD.STK R0.1\nRD.STK X9.0\nSUB 35\n1\nD10\nD20\nD11\nD12\nWRT Y9.0"),
    rowOf(withOutput("rotation",
                     {PinInfo{.name = "RN0", .doc = "positions begin with 0 or 1"},
                      PinInfo{.name = "DIR", .doc = "0 always forward, 1 the shorter way"},
                      PinInfo{.name = "POS", .doc = "0 the target, 1 the position before it"},
                      PinInfo{.name = "INC", .doc = "0 the result is a position, 1 a number of steps"}, kAct},
                     {kFormat, in("positions", kinds::kData), in("current", kinds::kData), in("target", kinds::kData),
                      out("result", kinds::kData)},
                     &network::lowerRotation),
          26, "ROTB", "rotation control", "6.5, medium",
          "Way of a turret or magazine from the current to the target position. W1: 0 forward (numbers increase), 1 "
          "reverse; equal ways go forward. ACT=0, or a position outside the table: result and W1 stay.",
          "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK R0.3\nRD.STK X9.0\nSUB 26\n1\nD10\nD11\nD12\nD13\nWRT Y9.0"),
};

} // namespace rung::frontend::fanuc
