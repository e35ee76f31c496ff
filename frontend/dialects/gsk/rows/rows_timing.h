// Rows: timers, counters, decoding, rotation, code tables: FUNC 2-9 (man. Part I §5.3-§5.10). Included by
// instructions.cpp only.
#pragma once
#include "frontend/dialects/gsk/rows/row_parts.h"

namespace rung::frontend::gsk {

constexpr Row timerShape(OperandList operands, Row::Numbers numbers = Row::Numbers::Free) {
  return {
      {.info = {.group = "timers", .pins = {kAct}, .operands = operands, .output = Output::Always, .stateful = true},
       .numbers = numbers},
      &lowerTimer,
      0,
      Row::Asks::Time};
}
constexpr Row counterShape(OperandList operands, Row::Numbers numbers = Row::Numbers::Free) {
  return {{.info = {.group = "counters",
                    .pins = {kCn0, kUpDown, kRst, kCount},
                    .operands = operands,
                    .output = Output::Always,
                    .stateful = true},
           .numbers = numbers},
          &lowerCounter};
}

inline constexpr Row kTimingRows[] = {
    rowOf(timerShape({number("number", 1, 100)}, Row::Numbers::Timer), 2, "TMR",
          "on-delay timer, preset on its page (tmr.N)", "5.3, l.1074",
          "OUT becomes 1 when ACT has been 1 for the preset time, which is set on the timer page and kept through "
          "power-off: timers 1-20 in units of 48 ms, 21-100 in units of 8 ms, the remainder dropped. ACT=0: OUT=0, the "
          "time is forgotten. The time counts from the first scan with ACT=1 (P23).",
          "LD X9.0\nFUNC 2\nPRM 1\nOUT Y9.0", kTimerPage),
    rowOf(
        timerShape({number("number", 1, 200), number("preset", 8, 999999, "milliseconds; a remainder of 8 is dropped")},
                   Row::Numbers::Timer),
        3, "TMRB", "on-delay timer, preset in the program", "5.4, l.1118",
        "As TMR, but the preset is part of the program, in milliseconds and units of 8 ms. Its numbers are a set of "
        "their own.",
        "LD X9.0\nFUNC 3\nPRM 1\nPRM 1000\nOUT Y9.0", kTimerFixed),
    rowOf(timerShape({number("accuracy", 0, 2, "0: 8 ms, 1: 48 ms, 2: 1 s"),
                      in("preset", kinds::kWord, "unsigned, in units of the accuracy"),
                      inout("register", kinds::kWorkArea, "for the control's own use")}),
          4, "TMRC", "on-delay timer, preset in memory", "5.5, l.1164",
          "As TMR, but the preset is a word of memory that may change at any time. The contents of the register are "
          "not defined.",
          "LD X9.0\nFUNC 4\nPRM 0\nPRM D10\nPRM R100\nOUT Y9.0", kTimerMemory),

    {{.info = {.mnemonic = "DECB",
               .title = "binary decoding",
               .group = "decoding",
               .number = 5,
               .pins = {kAct},
               .operands = {kFormat, in("code", kinds::kData), in("first code", kinds::kConstant),
                            out("result", kinds::kByte)},
               .ref = "5.6, l.1217",
               .doc = "Bit i of the result becomes 1 when the code equals first code + i, for i = 0-7; the others "
                      "become 0. Codes are compared as bit patterns (P25). ACT=0: all eight bits become 0.",
               .example = "LD F7.0\nFUNC 5\nPRM 2\nPRM F10\nPRM 3\nPRM R200"}},
     &lowerDecode},

    rowOf(
        counterShape({number("number", 1, 100)}, Row::Numbers::Counter), 6, "CTR",
        "ring counter, preset on its page (ctr.N)", "5.7, l.1271",
        "Counts rising edges of ACT. Up: from the start value (CN0) to the preset, the next pulse begins again. Down: "
        "from the preset to CN0 (P26). RST=1 sets the start value (down: the preset) and OUT=0. OUT=1 when a count "
        "arrives at the end of "
        "its way. Preset and value lie in C, two bytes each from C(4(n-1)), and are kept through power-off (P8).",
        "LD R0.0\nLD R0.1\nLD R0.2\nLD X9.0\nFUNC 6\nPRM 1\nOUT Y9.0", kCounterPage),
    rowOf(counterShape({in("preset", kinds::kWord, "0-32767"),
                        inout("register", kinds::kDword, "+0 current value, +2 for the control's own use")}),
          7, "CTRC", "ring counter, preset in memory", "5.8, l.1340",
          "As CTR, with preset and current value in memory. With its register in R it begins at 0 after power-on.",
          "LD R0.0\nLD R0.1\nLD R0.2\nLD X9.0\nFUNC 7\nPRM D10\nPRM D12\nOUT Y9.0", kCounterMemory),

    {{.info = {.mnemonic = "ROTB",
               .title = "rotation control",
               .group = "rotation",
               .number = 8,
               .pins = {kCn0, PinInfo{.name = "DIR", .doc = "0 always forward, 1 the shorter way"},
                        PinInfo{.name = "POS", .doc = "0 the target, 1 the position before it"},
                        PinInfo{.name = "INC", .doc = "0 the result is a position, 1 a number of steps"}, kAct},
               .operands = {kFormat, in("positions", kinds::kData), in("current", kinds::kData),
                            in("target", kinds::kData), out("result", kinds::kData)},
               .output = Output::Always,
               .stateful = true,
               .ref = "5.9, l.1425",
               .doc = "Way of a turret or magazine from the current to the target position. OUT: 0 forward (numbers "
                      "increase), 1 reverse; equal ways go forward (P30). ACT=0, or a position outside the table: "
                      "result and OUT stay (P31).",
               .example = "LD R0.0\nLD R0.1\nLD R0.2\nLD R0.3\nLD X9.0\nFUNC 8\nPRM 1\nPRM D10\nPRM D11\nPRM D12\nPRM "
                          "D13\nOUT Y9.0"}},
     &lowerRotation},
    {{.info = {.mnemonic = "CODB",
               .title = "code conversion by a table",
               .group = "conversion",
               .number = 9,
               .pins = {kRst, kAct},
               .operands = {kFormat, number("capacity", 1, 256, "rows of the table"), in("index", kinds::kByte),
                            out("result", kinds::kData)},
               .output = Output::Always,
               .stateful = true,
               .ref = "5.10, l.1509",
               .doc = "result := row `index` of the table that follows as TABLE rows, the first being number 0. OUT=1 "
                      "when the index is past the last row (P32).",
               .example = "LD R0.0\nLD X9.0\nFUNC 9\nPRM 1\nPRM 2\nPRM D10\nPRM D11\nTABLE 10\nTABLE 20\nOUT Y9.0"},
      .hasTable = true},
     &lowerCodeTable},
};

} // namespace rung::frontend::gsk
