// Rows: regions, jumps, subprograms (inventory §6.11, §6.12). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

// An instruction that begins or ends a part of the program must be the only one at the left rail.
constexpr Row markShape(std::string_view group, Control control, OperandList operands = {},
                        LowerFn lower = &network::lowerMark) {
  return {{.info = {.group = group, .operands = operands, .placement = Placement::AtRail}, .control = control}, lower};
}
constexpr Row jumpShape(std::string_view group, Control control, OperandInfo goal, LowerFn lower) {
  return {{.info = {.group = group, .pins = {kAct}, .operands = {goal}}, .control = control}, lower};
}
inline constexpr OperandInfo kCoils = number("coils", 0, 0, "number of coils: always 0");

inline constexpr Row kControlRows[] = {
    rowOf(jumpShape("regions", Control::Com, kCoils, &network::lowerCommonLine), 9, "COM", "common line", "6.11, high",
          "ACT=0: until COME every WRT becomes 0 and every WRT.NOT 1, whatever its condition; SET and RST do nothing; "
          "functions run as usual and only the coils after them are forced. ACT=1: no effect.",
          "RD X9.0\nSUB 9\n0"),
    rowOf(markShape("regions", Control::Come), 29, "COME", "end of a common line", "6.11, high",
          "Ends the region of COM.", "SUB 29"),
    rowOf(jumpShape("jumps", Control::Jmp, kCoils, &network::lowerJump), 10, "JMP", "jump over a region", "6.11, high",
          "ACT=1: everything up to JMPE is not executed; coils keep their state, timers are frozen. Regions cannot be "
          "nested.",
          "RD X9.0\nSUB 10\n0"),
    rowOf(markShape("jumps", Control::Jmpe), 30, "JMPE", "end of a jumped region", "6.11, high",
          "Ends the region of JMP.", "SUB 30"),
    rowOf(jumpShape("jumps", Control::Jmpb, kLabel, &network::lowerJump), 68, "JMPB", "jump to a label", "6.11, medium",
          "ACT=1: continues at the label, forward or backward, in the same level or subprogram. A loop that does not "
          "end is stopped with a fault.",
          "RD X9.0\nSUB 68\nL1"),
    rowOf(jumpShape("jumps", Control::Jmpc, kLabel, &network::lowerLeave), 73, "JMPC", "jump out of subprograms",
          "6.11, medium", "ACT=1: leaves all subprograms and continues at a label of level 2.", "RD X9.0\nSUB 73\nL1"),
    rowOf(markShape("jumps", Control::Lbl, {kLabel}), 69, "LBL", "label", "6.11, medium",
          "The place that JMPB and JMPC lead to. A number appears once in the whole program.", "SUB 69\nL1"),
    rowOf(jumpShape("subprograms", Control::Call, kSubprogram, &network::lowerCall), 65, "CALL", "conditional call",
          "6.12, high",
          "ACT=1: runs the subprogram, then continues after the call. Coils of a subprogram that is not called keep "
          "their state.",
          "RD X9.0\nSUB 65\nP1"),
    rowOf(markShape("subprograms", Control::CallU, {kSubprogram}, &network::lowerCall), 66, "CALLU", "call",
          "6.12, high", "Runs the subprogram in every scan.", "SUB 66\nP1"),
    rowOf(markShape("subprograms", Control::Sp, {kSubprogram}), 71, "SP", "begin of a subprogram", "6.12, high",
          "Begins a subprogram: `SUB 71` with its number, or its symbol and SP on one line.", "SUB 71\nP1"),
    rowOf(markShape("subprograms", Control::Spe, {}, &network::lowerEnd), 72, "SPE", "end of a subprogram",
          "6.12, high", "Returns to the caller.", "SUB 72"),
    rowOf(markShape("others", Control::Plain), 70, "NOP", "no operation", "csv, medium", "Nothing happens.", "SUB 70"),
};

} // namespace rung::frontend::fanuc
