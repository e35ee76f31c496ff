// Rows: timed blocks, timers, counters (man. ch. 3.11). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

inline constexpr std::string_view kCounterDoc = "Counts when RLO goes from 0 to 1. Then RLO shows whether the count "
                                                "equals the preset in DR, and DR becomes the count.";
inline constexpr Row kTimedBlockShape = {
    .info = {.group = "timed block", .operands = {in("end", kinds::kLabel, "ends the block")}, .stateful = true},
    .role = Role::Timed};
inline constexpr Row kCounterShape = {
    .info = {.group = "counter", .operands = {inout("count", kinds::kCounterCell, "is counted")}, .stateful = true},
    .effects = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr,
    .lower = lowerCounter};

inline constexpr Row kTimingRows[] = {
    // ---- timed blocks, timers, counters (man. ch. 3.11) -----------------------------------------------------------
    rowOf(kTimedBlockShape, "DFTM01", "every 0.1 s", "3.11, l.857",
          "The statements up to the label run only once in 0.1 s; the first time one period after the start.",
          "       DFTM01 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:",
          static_cast<int>(TimedKind::Tenth)),
    rowOf(kTimedBlockShape, "DFTM1", "every 1 s", "3.11, l.858",
          "The statements up to the label run only once in 1 s; the first time one period after the start.",
          "       DFTM1 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:",
          static_cast<int>(TimedKind::Second)),
    rowOf(kTimedBlockShape, "DFTM10", "every 10 s", "3.11, l.859",
          "The statements up to the label run only once in 10 s; the first time one period after the start.",
          "       DFTM10 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:",
          static_cast<int>(TimedKind::TenSeconds)),
    rowOf(kTimedBlockShape, "DFTM100", "every 100 s", "3.11, l.860",
          "The statements up to the label run only once in 100 s; the first time one period after the start.",
          "       DFTM100 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:",
          static_cast<int>(TimedKind::HundredSeconds)),
    {.info = {.mnemonic = "TM",
              .title = "timer",
              .group = "timer",
              .operands = {optional(inout("count", kinds::kTimerCell, "counts the runs"))},
              .stateful = true,
              .ref = "3.11, l.884",
              .doc = "While RLO is 0 the count is 0. While RLO is 1 it counts up to the preset in DR; RLO is 1 when it "
                     "is there already.",
              .example =
                  "       DFTM01 NEXT\n       LDR  GO\n       LOD  50\n       TM   COUNT\n       WR   PUMP\nNEXT:"},
     .effects = kReadsRlo | kSetsRlo | kReadsDr,
     .check = checkTimer,
     .lower = lowerTimer},
    rowOf(kCounterShape, "CU", "counter up", "3.11, l.955", kCounterDoc, "LDR  GO\nLOD  LIMIT\nCU   COUNT\nWR   LAMP",
          kCountUp),
    rowOf(kCounterShape, "CD", "counter down", "3.11, l.956", kCounterDoc, "LDR  GO\nLOD  LIMIT\nCD   COUNT\nWR   LAMP",
          kCountDown),
    rowOf(kCounterShape, "CUBCD", "counter up in BCD", "3.11, l.957", kCounterDoc,
          "LDR  GO\nLOD  LIMIT\nCUBCD COUNT\nWR   LAMP", kCountUpBcd),
};

} // namespace rung::frontend::technol
