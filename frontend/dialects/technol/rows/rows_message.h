// Rows: messages (man. ch. 14). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

inline constexpr OperandList kMessageOperands = {
    optional(ranged(in("error", kinds::kMessageValue, "number; in DR without it"), 0, 65535)),
    optional(in("subid", kinds::kMessageValue, "additional number")),
    optional(ranged(in("set", kinds::kMessageSwitch, "of a persistent message: 1 shows, 0 removes"), 0, 1)),
    optional(in("par1", kinds::kMessageValue, "value in the text")),
    optional(in("par2", kinds::kMessageValue, "value in the text")),
    optional(in("par3", kinds::kMessageValue, "value in the text"))};

constexpr Row messageShape(uint16_t effects) {
  return {.info = {.group = "message", .operands = kMessageOperands, .terminating = (effects & kReadsRlo) != 0},
          .effects = effects,
          .check = checkMessage,
          .lower = lowerMessage};
}

inline constexpr Row kMessageRows[] = {
    // ---- messages (man. ch. 14) and the ends of start and shutdown (man. ch. 5) -----------------------------------
    rowOf(messageShape(kReadsDr | kDrIfNotGiven), "ESET", "message", "14.3.1, l.5090",
          "Generates a message each time it is executed.", "ESET 12,-,-,BYTE.SPEED", kAlways),
    rowOf(messageShape(kReadsDr | kDrIfNotGiven | kReadsRlo), "ESET1", "message if 1", "14.3.1, l.5091",
          "As ESET, but only while RLO is 1.", "LDR  DOOR\nESET1 12", kIfRlo),
    {.info = {.mnemonic = "EDEF",
              .title = "ties a bit to a message",
              .group = "message",
              .operands = {in("val", kinds::kStatusByte, "byte of the bit; not given: the bit has its own place"),
                           in("bit", kinds::kStatusBit, "state that makes the message"),
                           ranged(in("error", kinds::kMessageNumber, "number"), 0, 65535),
                           in("subid", kinds::kMessageValue, "additional number"),
                           ranged(in("mod", kinds::kConstant,
                                     "bits 0, 1: beginning, bits 2, 3: end; 01 rising, 10 falling edge, 00 never"),
                                  0, 10),
                           optional(
                               in("par1", kinds::kMessageValue, "value in the text, read when the message comes up")),
                           optional(in("par2", kinds::kMessageValue, "value in the text")),
                           optional(in("par3", kinds::kMessageValue, "value in the text"))},
              .ref = "14.3.2, l.5192",
              .doc = "Ties a bit to a message: at the end of each scan the control looks whether the bit has changed. "
                     "The message comes up at the edge that `mod` names as beginning, transient, or persistent where "
                     "`mod` names an end as well. Number and subid are taken when EDEF is carried out, the values when "
                     "the message comes up.",
              .example = "EDEF CELL1,BIT0,1004,-,1001b,CELL4"},
     .effects = kInitOnly,
     .check = checkBitMessage,
     .lower = lowerBitMessage},
};

} // namespace rung::frontend::technol
