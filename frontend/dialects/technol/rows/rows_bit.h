// Rows: bit logic and jumps (man. ch. 3.5-3.8). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/instructions.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

inline constexpr OperandInfo kFlagValue = {.name = "value", .kind = &kinds::kFlag, .doc = "0 or 1", .min = 0, .max = 1};

inline constexpr Row kJoinShape = {
    .info = {.group = "bit logic",
             .operands = {optional(in("bit", kinds::kBit, "joined with RLO; without it the value stored last"))}},
    .effects = kJoins | kSetsRlo | kReadsRlo,
    .lower = lowerJoin};
inline constexpr Row kEdgeShape = {.info = {.group = "bit logic",
                                            .operands = {in("bit", kinds::kPlainBit, "the bit that is watched")},
                                            .stateful = true},
                                   .effects = kSetsRlo,
                                   .lower = lowerEdge};

// An instruction that depends on RLO ends the equation.
constexpr Row flagShape(uint16_t effects) {
  return {.info = {.group = "bit write",
                   .operands = {kFlagValue, repeated(out("bit", kinds::kPlainBit, "becomes the value"))},
                   .terminating = effects == kReadsRlo},
          .effects = effects,
          .lower = lowerFlag};
}
constexpr Row moveBitShape(uint16_t effects) {
  return {.info = {.group = "bit write",
                   .operands = {out("dst", kinds::kPlainBit, "becomes the source"), in("src", kinds::kBit, "is read")},
                   .terminating = effects == kReadsRlo},
          .effects = effects,
          .lower = lowerMoveBit};
}
constexpr Row jumpShape(uint16_t effects, decltype(InstructionInfo::aliases) aliases = {}) {
  return {.info = {.aliases = aliases,
                   .group = "jump",
                   .operands = {in("adr", kinds::kLabel, "where control goes")},
                   .terminating = (effects & kReadsRlo) != 0},
          .effects = effects,
          .check = checkJump,
          .lower = lowerJump};
}

inline constexpr Row kBitRows[] = {
    // ---- bit logic (man. ch. 3.5-3.7) -----------------------------------------------------------------------------
    {.info = {.mnemonic = "LDR",
              .title = "load a bit",
              .group = "bit logic",
              .operands = {in("bit", kinds::kBit, "what RLO becomes")},
              .ref = "3.5, l.174",
              .doc = "RLO becomes the bit. Where an equation is open already, RLO is stored on the stack first.",
              .example = "LDR  A1\nLA   -B1\nWR   OUT1"},
     .effects = kPushes | kSetsRlo,
     .lower = lowerLoadBit},
    rowOf(
        kJoinShape, "LA", "and", "3.6, l.250",
        "RLO becomes RLO AND the bit. Without an operand it takes the value stored last off the stack and joins that.",
        "LA  A2", kAnd),
    rowOf(kJoinShape, "LO", "or", "3.6, l.251",
          "RLO becomes RLO OR the bit. Without an operand it takes the value stored last off the stack and joins that.",
          "LO  A2", kOr),
    rowOf(kJoinShape, "LX", "exclusive or", "3.6, l.252",
          "RLO becomes RLO EXCLUSIVE OR the bit. Without an operand it takes the value stored last off the stack and "
          "joins that.",
          "LX  A2", kXor),
    {.info = {.mnemonic = "CA",
              .title = "complement",
              .group = "bit logic",
              .ref = "3.6, l.281",
              .doc = "RLO becomes NOT RLO.",
              .example = "LDR  DOOR\nCA\nWR   LAMP"},
     .effects = kReadsRlo | kSetsRlo,
     .lower = lowerComplement},
    rowOf(kEdgeShape, "EDGE_H", "rising edge", "3.6, l.288",
          "RLO is 1 in the run in which the bit goes from 0 to 1, else 0. The first run after a start only records the "
          "bit.",
          "EDGE_H GO\nFL1  1,PUMP", 1),
    rowOf(kEdgeShape, "EDGE_L", "falling edge", "3.6, l.289",
          "RLO is 1 in the run in which the bit goes from 1 to 0, else 0. The first run after a start only records the "
          "bit.",
          "EDGE_L GO\nFL1  0,PUMP", 0),
    {.info = {.mnemonic = "CHECK",
              .title = "check of the stack",
              .group = "bit logic",
              .ref = "3.6, l.232",
              .doc = "The compiler checks here that nothing is left on the stack.",
              .example = "LDR  GO\nLA   DOOR\nWR   PUMP\nCHECK"},
     .check = checkEmptyStack,
     .lower = lowerNothing},
    {.info = {.mnemonic = "WR",
              .title = "write",
              .group = "bit write",
              .operands = {repeated(out("bit", kinds::kPlainBit, "becomes RLO"))},
              .terminating = true,
              .ref = "3.7, l.380",
              .doc = "Each bit becomes RLO; RLO and DR stay.",
              .example = "LDR  GO\nWR   PUMP,LAMP"},
     .effects = kReadsRlo,
     .lower = lowerWrite},
    rowOf(flagShape(0), "FL", "set or clear", "3.7, l.396", "Each bit becomes 0 or 1, whatever RLO is.",
          "FL   1,LAMP,PUMP", kAlways),
    rowOf(flagShape(kReadsRlo), "FL1", "set or clear if RLO", "3.7, l.420", "As FL, but only while RLO is 1.",
          "LDR  DOOR\nFL1  0,PUMP,LAMP", kIfRlo),
    rowOf(moveBitShape(0), "MOVR", "move a bit", "3.7, l.447", "One bit becomes another; RLO and DR stay.",
          "MOVR LAMP,-DOOR", kAlways),
    rowOf(moveBitShape(kReadsRlo), "MOVR1", "move a bit if RLO", "3.7, l.448", "As MOVR, but only while RLO is 1.",
          "LDR  GO\nMOVR1 LAMP,PUMP", kIfRlo),
    {.info = {.mnemonic = "LDR_LIC",
              .title = "load a licence",
              .group = "bit logic",
              .operands = {in("feature", kinds::kLicence, "what is asked for")},
              .ref = "8.4.7, l.7631",
              .doc = "RLO becomes 1 while the licence is valid, or the hardware key connected. Where an equation is "
                     "open already, RLO is stored on the stack first.",
              .example = "LDR_LIC FeaturePlc1\nWR   LAMP"},
     .effects = kPushes | kSetsRlo,
     .lower = lowerLicence},
    // ---- jumps (man. ch. 3.8) -------------------------------------------------------------------------------------
    rowOf(jumpShape(kJumps), "JUM", "jump", "3.8, l.484", "Control goes to the label, which is in the same unit.",
          "      JUM  NEXT\n      FL   1,LAMP\nNEXT: LOD  COUNT", kAlways),
    rowOf(jumpShape(kJumps | kReadsRlo, {"JLO"}), "JL0", "jump if 0", "3.8, l.485",
          "Control goes to the label when RLO is 0.",
          "      LDR  GO\n      JL0  NEXT\n      FL   1,LAMP\nNEXT: LOD  COUNT", kIfNotRlo),
    rowOf(jumpShape(kJumps | kReadsRlo), "JL1", "jump if 1", "3.8, l.486", "Control goes to the label when RLO is 1.",
          "      LDR  GO\n      JL1  NEXT\n      FL   0,LAMP\nNEXT: LOD  COUNT", kIfRlo),
};

} // namespace rung::frontend::technol
