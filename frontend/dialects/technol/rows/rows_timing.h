// Rows: timed blocks, timers, counters (man. ch. 3.11). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

inline constexpr Row kTimingRows[] = {
    // ---- timed blocks, timers, counters (man. ch. 3.11) -----------------------------------------------------------
    {.info = {.mnemonic = "DFTM01",
              .title = "every 0.1 s",
              .group = "timed block",
              .operands = {in("end", "label", "ends the block")},
              .stateful = true,
              .ref = "3.11, l.857",
              .doc =
                  "The statements up to the label run only once in 0.1 s; the first time one period after the start.",
              .example = "       DFTM01 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:"},
     .role = Role::Timed,
     .variant = static_cast<int>(TimedKind::Tenth)},
    {.info = {.mnemonic = "DFTM1",
              .title = "every 1 s",
              .group = "timed block",
              .operands = {in("end", "label", "ends the block")},
              .stateful = true,
              .ref = "3.11, l.858",
              .doc = "The statements up to the label run only once in 1 s; the first time one period after the start.",
              .example = "       DFTM1 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:"},
     .role = Role::Timed,
     .variant = static_cast<int>(TimedKind::Second)},
    {.info = {.mnemonic = "DFTM10",
              .title = "every 10 s",
              .group = "timed block",
              .operands = {in("end", "label", "ends the block")},
              .stateful = true,
              .ref = "3.11, l.859",
              .doc = "The statements up to the label run only once in 10 s; the first time one period after the start.",
              .example = "       DFTM10 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:"},
     .role = Role::Timed,
     .variant = static_cast<int>(TimedKind::TenSeconds)},
    {.info = {.mnemonic = "DFTM100",
              .title = "every 100 s",
              .group = "timed block",
              .operands = {in("end", "label", "ends the block")},
              .stateful = true,
              .ref = "3.11, l.860",
              .doc =
                  "The statements up to the label run only once in 100 s; the first time one period after the start.",
              .example = "       DFTM100 NEXT\n       LOD  COUNT\n       INR\n       STO  COUNT\nNEXT:"},
     .role = Role::Timed,
     .variant = static_cast<int>(TimedKind::HundredSeconds)},
    {.info = {.mnemonic = "TM",
              .title = "timer",
              .group = "timer",
              .operands = {optional(inout("count", "timer cell", "counts the runs"))},
              .stateful = true,
              .ref = "3.11, l.884",
              .doc = "While RLO is 0 the count is 0. While RLO is 1 it counts up to the preset in DR; RLO is 1 when it "
                     "is there already.",
              .example =
                  "       DFTM01 NEXT\n       LDR  GO\n       LOD  50\n       TM   COUNT\n       WR   PUMP\nNEXT:"},
     .effects = kReadsRlo | kSetsRlo | kReadsDr,
     .check = checkTimer,
     .lower = lowerTimer},
    {.info = {.mnemonic = "CU",
              .title = "counter up",
              .group = "counter",
              .operands = {inout("count", "counter cell", "is counted")},
              .stateful = true,
              .ref = "3.11, l.955",
              .doc = "Counts when RLO goes from 0 to 1. Then RLO shows whether the count equals the preset in DR, and "
                     "DR becomes the count.",
              .example = "LDR  GO\nLOD  LIMIT\nCU   COUNT\nWR   LAMP"},
     .effects = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr,
     .lower = lowerCounter,
     .variant = kCountUp},
    {.info = {.mnemonic = "CD",
              .title = "counter down",
              .group = "counter",
              .operands = {inout("count", "counter cell", "is counted")},
              .stateful = true,
              .ref = "3.11, l.956",
              .doc = "Counts when RLO goes from 0 to 1. Then RLO shows whether the count equals the preset in DR, and "
                     "DR becomes the count.",
              .example = "LDR  GO\nLOD  LIMIT\nCD   COUNT\nWR   LAMP"},
     .effects = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr,
     .lower = lowerCounter,
     .variant = kCountDown},
    {.info = {.mnemonic = "CUBCD",
              .title = "counter up in BCD",
              .group = "counter",
              .operands = {inout("count", "counter cell", "is counted")},
              .stateful = true,
              .ref = "3.11, l.957",
              .doc = "Counts when RLO goes from 0 to 1. Then RLO shows whether the count equals the preset in DR, and "
                     "DR becomes the count.",
              .example = "LDR  GO\nLOD  LIMIT\nCUBCD COUNT\nWR   LAMP"},
     .effects = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr,
     .lower = lowerCounter,
     .variant = kCountUpBcd},
};

} // namespace rung::frontend::technol
