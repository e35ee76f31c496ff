// Rows: program control (man. §6.14). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/rows/rows_float.h"

namespace rung::frontend::nct {

constexpr Row controlShape(std::string_view operand, Placement placement, Flow flow) {
  Row row{.info = {.group = "program-control",
                   .pins = {P{"EN", "condition"}},
                   .output = Output::None,
                   .placement = placement},
          .flow = flow};
  if (!operand.empty()) row.info.operands = {O{operand, &kinds::kLabel, Access::None, "#0 to #99"}};
  return row;
}

inline constexpr Row kControlRows[] = {
    rowOf(controlShape("", Placement::AtRail, Flow::End), "END", "end of the cyclic part of a module", "6.14.1, l.2918",
          "The cycle of the module ends here. The subroutines follow it; without any it may be left out.", "|--{END}"),
    rowOf(controlShape("Jump Number", Placement::AfterContact, Flow::Jump), "JMP", "conditional jump", "6.14.2, l.2936",
          "With power the program continues at the JME of this number. What is jumped over keeps its outputs and "
          "its memory of edges.",
          "|--[SKIP]--{JMP #5}"),
    rowOf(controlShape("Jump Number", Placement::AtRail, Flow::Label), "JME", "target of a jump", "6.14.2, l.2966",
          "Marks the place at which a JMP of this number continues.", "|--{JME #5}"),
    rowOf(controlShape("Subroutine Number", Placement::AfterContact, Flow::Call), "SBS", "subroutine call",
          "6.14.3, l.2984", "With power the subroutine is executed; then the program continues after this rung.",
          "|--[N_ON]--{SBS #10}"),
    rowOf(controlShape("Subroutine Number", Placement::AtRail, Flow::Subroutine), "SBN", "start of a subroutine",
          "6.14.3, l.3020", "A subroutine reaches to the next SBN or to the end of the module.", "|--{SBN #10}"),
    rowOf(controlShape("", Placement::AfterContact, Flow::Return), "RET", "return from a subroutine", "6.14.3, l.3036",
          "With power the subroutine ends.", "|--[N_ON]--{RET}"),
};

} // namespace rung::frontend::nct
