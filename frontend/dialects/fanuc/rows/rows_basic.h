// Rows: the basic commands and the ends (inventory §4, §2.2). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

constexpr Row endRow(int number, std::string_view mnemonic, std::string_view title, std::string_view ref,
                     std::string_view doc, std::string_view example, Control control) {
  return rowOf({{.info = {.group = "ends", .placement = Placement::AtRail}, .control = control}, &network::lowerEnd},
               number, mnemonic, title, ref, doc, example);
}

inline constexpr std::string_view kCommands = "4.1, high"; // .ref of all of them

inline constexpr Row kBasicRows[] = {
    basic("RD", "normally open contact, begins a network", kBitRead, kCommands, "ST0 := bit."),
    basic("RD.NOT", "normally closed contact, begins a network", kBitRead, kCommands, "ST0 := not bit."),
    basic("RD.STK", "normally open contact, new block", kBitRead, kCommands, "Pushes the bit onto the stack."),
    basic("RD.NOT.STK", "normally closed contact, new block", kBitRead, kCommands,
          "Pushes the inverted bit onto the stack. RD.STK.NOT is the same."),
    basic("RDNT", "falling edge, begins a network", kBitRead, kCommands,
          "ST0 := 1 for one scan after the bit has become 0. The memory belongs to the instruction."),
    basic("AND", "contact in series", kBitRead, kCommands, "ST0 := ST0 and bit."),
    basic("AND.NOT", "normally closed contact in series", kBitRead, kCommands, "ST0 := ST0 and not bit."),
    basic("OR", "contact in parallel", kBitRead, kCommands, "ST0 := ST0 or bit."),
    basic("OR.NOT", "normally closed contact in parallel", kBitRead, kCommands, "ST0 := ST0 or not bit."),
    basic("OR.STK", "blocks in parallel", {}, kCommands, "ST1 := ST1 or ST0, and ST0 is dropped."),
    basic("AND.STK", "blocks in series", {}, kCommands, "ST1 := ST1 and ST0, and ST0 is dropped."),
    basic("WRT", "coil", out("bit", kinds::kCoil), kCommands, "The bit becomes ST0; ST0 stays."),
    basic("WRT.NOT", "inverted coil", out("bit", kinds::kCoil), kCommands,
          "The bit becomes the inverse of ST0; ST0 stays."),
    basic("SET", "set", out("bit", kinds::kCoil), kCommands, "The bit becomes 1 when ST0 is 1, and stays."),
    basic("RST", "reset", out("bit", kinds::kCoil), kCommands, "The bit becomes 0 when ST0 is 1, and stays."),

    endRow(1, "END1", "end of level 1", "2.2, high", "Ends level 1. Appears exactly once, even if level 1 is empty.",
           "SUB 1", Control::LevelEnd),
    endRow(2, "END2", "end of level 2", "2.2, high", "Ends level 2.", "SUB 2", Control::LevelEnd),
    endRow(48, "END3", "end of level 3", "2.2, medium",
           "Ends level 3, which a program need not have: it runs once in each cycle of level 2 (F10).", "SUB 48",
           Control::LevelEnd),
    endRow(64, "END", "end of the program", "2.2, high",
           "Ends the program, after the last subprogram. If it is missing that is a warning (F9).", "SUB 64",
           Control::ProgramEnd),
};

} // namespace rung::frontend::fanuc
