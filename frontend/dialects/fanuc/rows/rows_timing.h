// Rows: timers, counters, edges (inventory §6.2, §6.3, §6.9). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

constexpr Row timerShape(OperandList operands, Row::Numbers numbers, LowerFn lower = &lowerTimer) {
  Row row = withOutput("timers", {kAct}, operands, lower);
  row.numbers = numbers;
  row.asks = Row::Asks::Time;
  return row;
}
constexpr Row counterShape(OperandList operands, Row::Numbers numbers) {
  Row row = withOutput("counters", {kCn0, kUpDown, kRst, kCount}, operands, &lowerCounter);
  row.numbers = numbers;
  return row;
}
inline constexpr Row kEdgeShape = {{.info = {.group = "edges",
                                             .pins = {kAct},
                                             .operands = {number("number", 0, 3000, "0: numbered by the compiler")},
                                             .output = Output::Always,
                                             .stateful = true},
                                    .numbers = Row::Numbers::Edge},
                                   &lowerEdge};
inline constexpr OperandInfo kTimerNumber = number("number", 0, 1500, "0: numbered by the compiler");
inline constexpr OperandInfo kPresetMs = number("preset", 0, 32'760'000, "milliseconds");

inline constexpr Row kTimingRows[] = {
    rowOf(withPlaces(timerShape({number("number", 1, 500)}, Row::Numbers::Timer), {areas::kT, 0, 2}), 3, "TMR",
          "on-delay timer, set value in T (tmr.N)", "6.2, high",
          "W1 becomes 1 when ACT has been 1 for the set value, a word of T in units of the timer's accuracy: 48 ms for "
          "timers 1-8 and 8 ms from 9 on, unless the word in T9000 says 1 (1 ms), 2 (10 ms), 3 (100 ms), 4 (1 s) or 5 "
          "(1 min). ACT=0: W1=0, the time is forgotten.",
          "RD X9.0\nSUB 3\n1\nWRT Y9.0", kTimerPage),
    rowOf(withCheck(timerShape({kTimerNumber, kPresetMs}, Row::Numbers::Timer), &checkPreset), 24, "TMRB",
          "on-delay timer, preset in the program", "6.2, high",
          "As TMR, but the preset is part of the program, in milliseconds; up to PMC-SB7 in units of 8 ms. Its numbers "
          "are a set of their own.",
          "RD X9.0\nSUB 24\n1\n1000\nWRT Y9.0", kTimerFixed),
    rowOf(
        timerShape(
            {number("accuracy", 0, 7, "0: 8 ms, 1: 48 ms, 2: 1 s, 3: 10 s, 4: 1 min, 5: 1 ms, 6: 10 ms, 7: 100 ms"),
             in("set value", kinds::kWord, "unsigned, in units of the accuracy"),
             inout("register", kinds::kDword, "for the control's own use")},
            Row::Numbers::Free),
        54, "TMRC", "on-delay timer, set value in memory", "6.2, high",
        "As TMR, but the set value is a word anywhere, which may change at any time. The contents of the register are "
        "not defined.",
        "RD X9.0\nSUB 54\n0\nD10\nR100\nWRT Y9.0", kTimerMemory),
    rowOf(withCheck(timerShape({kTimerNumber, kPresetMs}, Row::Numbers::Timer, &lowerOffDelay), &checkPreset), 77,
          "TMRBF", "off-delay timer, preset in the program", "6.2, high",
          "W1 is 1 while ACT is 1, and for the preset after it has become 0.", "RD X9.0\nSUB 77\n1\n1000\nWRT Y9.0"),

    rowOf(
        withPlaces(counterShape({number("number", 1, 300)}, Row::Numbers::Counter), {areas::kC, 0, 4}), 5, "CTR",
        "ring counter, preset in C (ctr.N)", "6.3, high",
        "Counts rising edges of ACT. Up: from the start value (CN0) to the preset, the next pulse begins again. Down: "
        "from the preset to CN0. RST=1 sets the start value (down: the preset) and W1=0. W1=1 when a count arrives at "
        "the end of its way. Preset and value are words from C4(n-1) on, binary (F17).",
        "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK X9.0\nSUB 5\n1\nWRT Y9.0", kCounterPage),
    rowOf(withPlaces(counterShape({number("number", 1, 300), number("preset", 0, 32767)}, Row::Numbers::Counter),
                     {areas::kC, kFixedCounters, 2}),
          56, "CTRB", "ring counter, preset in the program", "6.3, high",
          "As CTR, but the preset is part of the program, and the value is the word at C5000+2(n-1). Its numbers are a "
          "set of their own.",
          "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK X9.0\nSUB 56\n1\n5\nWRT Y9.0", kCounterFixed),
    rowOf(counterShape({in("preset", kinds::kWord, "0-32767"),
                        inout("register", kinds::kDword, "+0 current value, +2 for the control's own use")},
                       Row::Numbers::Free),
          55, "CTRC", "ring counter, preset in memory", "6.3, high", "As CTR, with preset and current value in memory.",
          "RD R0.0\nRD.STK R0.1\nRD.STK R0.2\nRD.STK X9.0\nSUB 55\nD10\nD12\nWRT Y9.0", kCounterMemory),

    rowOf(kEdgeShape, 57, "DIFU", "rising edge", "6.9, high",
          "W1=1 for one scan after ACT has become 1. Instructions with the same number share their memory.",
          "RD X9.0\nSUB 57\n1\nWRT R9.0", kRising),
    rowOf(kEdgeShape, 58, "DIFD", "falling edge", "6.9, high",
          "W1=1 for one scan after ACT has become 0. Instructions with the same number share their memory.",
          "RD X9.0\nSUB 58\n2\nWRT R9.1", kFalling),
};

} // namespace rung::frontend::fanuc
