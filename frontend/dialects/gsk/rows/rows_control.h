// Rows: regions, jumps, subprograms: FUNC 33-43 (man. Part I §5.34-§5.44). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/gsk/rows/row_parts.h"

namespace rung::frontend::gsk {

inline constexpr std::string_view kAfterEnd2 = "the part after END2";

// An instruction that begins or ends a part of the program must be the only one at the left rail.
constexpr Row markShape(std::string_view group, Control control, OperandList operands = {}, std::string_view tasks = {},
                        LowerFn lower = &lowerMark) {
  return {{.info = {.group = group, .operands = operands, .placement = Placement::AtRail, .tasks = tasks},
           .control = control,
           .ignoresCondition = control == Control::Sp},
          lower};
}
constexpr Row jumpShape(std::string_view group, Control control, OperandInfo goal, LowerFn lower,
                        std::string_view tasks = {}) {
  return {{.info = {.group = group, .pins = {kAct}, .operands = {goal}, .tasks = tasks}, .control = control}, lower};
}

inline constexpr Row kControlRows[] = {
    {{.info = {.mnemonic = "COM",
               .title = "common line",
               .group = "regions",
               .number = 33,
               .pins = {kAct},
               .ref = "5.34, l.2782",
               .doc =
                   "ACT=0: until COME every OUT becomes 0 and every OUTI 1, whatever its condition; SET and RST do "
                   "nothing; functions run as usual and only the coils after them are forced (P41). ACT=1: no effect.",
               .example = "LD X9.0\nFUNC 33"},
      .control = Control::Com},
     &lowerCommonLine},
    rowOf(markShape("regions", Control::Come), 34, "COME", "end of a common line", "5.35, l.2811",
          "Ends the region of COM.", "FUNC 34"),
    rowOf(jumpShape("jumps", Control::Jmp, number("coils", 0, 0, "number of coils: always 0"), &lowerJump), 35, "JMP",
          "jump over a region", "5.36, l.2829",
          "ACT=1: everything up to JMPE is not executed; coils keep their state, timers are frozen (P19). Regions "
          "cannot be nested (P42).",
          "LD X9.0\nFUNC 35\nPRM 0"),
    rowOf(markShape("jumps", Control::Jmpe), 36, "JMPE", "end of a jumped region", "5.37, l.2861",
          "Ends the region of JMP.", "FUNC 36"),
    rowOf(jumpShape("subprograms", Control::Call, kSubprogram, &lowerCall), 37, "CALL", "conditional call",
          "5.38, l.2879",
          "ACT=1: runs the subprogram, then continues after the call. Coils of a subprogram that is not called keep "
          "their state.",
          "LD X9.0\nFUNC 37\nPRM P1"),
    {{.info = {.mnemonic = "CALLU",
               .title = "call",
               .group = "subprograms",
               .number = 38,
               .operands = {kSubprogram},
               .placement = Placement::AtRail,
               .ref = "5.39, l.2917",
               .doc = "Runs the subprogram in every scan.",
               .example = "FUNC 38\nPRM P1"},
      .control = Control::CallU},
     &lowerCall},
    rowOf(jumpShape("jumps", Control::Jmpb, kLabel, &lowerJump), 39, "JMPB", "jump to a label", "5.40, l.2940",
          "ACT=1: continues at the label, forward or backward, in the same level or subprogram. A loop that does not "
          "end is stopped with the fault dead-loop (P6).",
          "LD X9.0\nFUNC 39\nPRM L1"),
    rowOf(jumpShape("jumps", Control::Jmpc, kLabel, &lowerLeave, "subprograms of Level 2"), 40, "JMPC",
          "jump out of subprograms", "5.41, l.2982",
          "ACT=1: leaves all subprograms and continues at a label of the Level 2 main program (P43).",
          "LD X9.0\nFUNC 40\nPRM L1"),
    {{.info = {.mnemonic = "LBL",
               .title = "label",
               .group = "jumps",
               .number = 41,
               .operands = {kLabel},
               .placement = Placement::Anywhere,
               .ref = "5.42, l.3016",
               .doc = "The place that JMPB and JMPC lead to. A number appears once in the whole program (P44). A "
                      "condition before it has no effect (P13).",
               .example = "FUNC 41\nPRM L1"},
      .control = Control::Lbl,
      .ignoresCondition = true},
     &lowerMark},
    rowOf(markShape("subprograms", Control::Sp, {kSubprogram}, kAfterEnd2), 42, "SP", "begin of a subprogram",
          "5.43, l.3040", "Begins a subprogram. A condition before it has no effect (P13).", "FUNC 42\nPRM P1"),
    rowOf(markShape("subprograms", Control::Spe, {}, kAfterEnd2, &lowerEnd), 43, "SPE", "end of a subprogram",
          "5.44, l.3069", "Returns to the caller.", "FUNC 43"),
};

} // namespace rung::frontend::gsk
