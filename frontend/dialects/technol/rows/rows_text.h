// Rows: memory and texts (man. ch. 3.15, 3.18). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/instructions.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

inline constexpr OperandInfo kTarget = out("text1", kinds::kText, "the target");
inline constexpr OperandInfo kSource = in("text2", kinds::kTextOrLiteral, "the source");
inline constexpr OperandInfo kCharacters = lengthOf("num", "at most so many characters", true);

inline constexpr Row kNumberTextShape = {
    .info = {.group = "text",
             .operands = {out("text1", kinds::kText, "of 1 to 10 characters"), widthOf(kinds::kDoubleWidth)}},
    .effects = kReadsDr,
    .check = checkNumberToText,
    .lower = lowerNumberToText};

constexpr Row textShape(OperandList operands, CheckFn check, LowerFn lower, uint16_t effects = 0) {
  return {.info = {.group = "text", .operands = operands}, .effects = effects, .check = check, .lower = lower};
}

inline constexpr Row kTextRows[] = {
    // ---- memory (man. ch. 3.15) -----------------------------------------------------------------------------------
    {.info = {.mnemonic = "MV",
              .title = "move memory",
              .group = "memory",
              .operands = {in("src", kinds::kAddress, "where the bytes are"),
                           out("dest", kinds::kAddress, "where they go"), lengthOf("num", "how many bytes", false)},
              .ref = "3.15, l.1484",
              .doc =
                  "Copies bytes from the first address to the second, also where the areas overlap. RLO and DR stay.",
              .example = "MV   TABLE,ARRAY+8,8"},
     .check = checkMoveMemory,
     .lower = lowerMoveMemory},
    {.info = {.mnemonic = "CLEAR",
              .title = "clear memory",
              .group = "memory",
              .operands = {out("begin", kinds::kBeginning, "the first byte, or which data"),
                           in("end", kinds::kEnd, "the first byte that stays, or ALL")},
              .ref = "3.15, l.1521",
              .doc = "Bytes become 0 from the first address up to the second, which stays. GLOBAL,ALL brings all "
                     "global data, mechanisms and timers into the state after power-up; INTERNAL,ALL clears the data "
                     "of DATA_LOCAL and the cells that instructions made for themselves. RLO and DR stay.",
              .example = "CLEAR ARRAY,ARRAY+16\nCLEAR GLOBAL,ALL"},
     .check = checkClear,
     .lower = lowerClear},
    // ---- texts (man. ch. 3.18) ------------------------------------------------------------------------------------
    rowOf(textShape({kTarget, kSource, kCharacters}, checkTexts, lowerCopyText), "STRCPY", "copy a text",
          "3.18, l.1700",
          "Copies characters from the second text to the first: with the terminator after the last one, "
          "until the first text is full, or, without a terminator, as many as the third operand says.",
          "STRCPY TEXT1,'READY'\nSTRCPY TEXT1+2,'AB',2"),
    rowOf(textShape({kTarget, kSource}, checkTexts, lowerAddText), "STRADD", "join texts", "3.18, l.1701",
          "Appends the second text to the first, as far as that holds it.", "STRADD TEXT1,' MM'"),
    rowOf(kNumberTextShape, "BINSTR", "number to text", "3.18, l.1808",
          "DR becomes decimal digits, as many as the text has characters, with leading zeros: 16 bits without sign, "
          "with DWRD 32. Digits before those are lost.",
          "LOD    COUNT\nBINSTR TEXT1", 0),
    rowOf(kNumberTextShape, "BCDSTR", "BCD number to text", "3.18, l.1809",
          "As BINSTR, for a number of 4 or, with DWRD, 8 BCD digits.", "LOD    COUNT\nBCD\nBCDSTR TEXT1", 1),
    rowOf(textShape(
              {in("text1", kinds::kText, "is compared"), in("text2", kinds::kTextOrLiteral, "with this"), kCharacters},
              checkTexts, lowerCompareText, kSetsRlo),
          "STRCMP", "compare texts", "3.18, l.1844",
          "RLO is 1 when the texts are equal up to and with the second one's terminator, or in as many "
          "characters as the third operand says.",
          "STRCMP TEXT1,'READY'\nWR   LAMP"),
    rowOf(textShape({kTarget, in("text2", kinds::kText, "the source"), lengthOf("num", "how many bytes", true)},
                    checkCopyBytes, lowerCopyBytes),
          "MEMCPY", "copy bytes of texts", "3.18, l.1901",
          "Copies bytes from the second text to the first, a terminator as any other, until the first is "
          "full or as many as the third operand says.",
          "MEMCPY TEXT1,TEXT1+4,2"),
    rowOf(textShape({in("text1", kinds::kText, "is compared"), in("text2", kinds::kText, "with this"),
                     lengthOf("num", "how many bytes", true)},
                    checkCompareBytes, lowerCompareBytes, kSetsRlo),
          "MEMCMP", "compare bytes of texts", "3.18, l.1934",
          "RLO is 1 when the texts have the same bytes, as many as the second holds or the third operand "
          "says; a terminator is a byte as any other.",
          "MEMCMP TEXT1,TEXT1+4,2\nWR   LAMP"),
};

} // namespace rung::frontend::technol
