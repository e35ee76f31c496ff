// Rows: the basic commands and the ends of the levels (man. Part I §4, §5.1, §5.2). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/gsk/rows/row_parts.h"

namespace rung::frontend::gsk {

inline constexpr Row kBasicRows[] = {
    basic("LD", "normally open contact, new block", kBitRead, "4.1, l.820", "Pushes the bit onto the stack register."),
    basic("LDI", "normally closed contact, new block", kBitRead, "4.1, l.821",
          "Pushes the inverted bit onto the stack register."),
    basic("OUT", "coil", out("bit", kinds::kCoil), "4.1, l.822", "The bit becomes ST0; ST0 stays."),
    basic("OUTI", "inverted coil", out("bit", kinds::kCoil), "4.1, l.823",
          "The bit becomes the inverse of ST0; ST0 stays."),
    basic("AND", "contact in series", kBitRead, "4.2, l.824", "ST0 := ST0 and bit."),
    basic("ANI", "normally closed contact in series", kBitRead, "4.2, l.825", "ST0 := ST0 and not bit."),
    basic("OR", "contact in parallel", kBitRead, "4.3, l.826", "ST0 := ST0 or bit."),
    basic("ORI", "normally closed contact in parallel", kBitRead, "4.3, l.827", "ST0 := ST0 or not bit."),
    basic("ORB", "blocks in parallel", {}, "4.4, l.828", "ST1 := ST1 or ST0, and ST0 is dropped."),
    basic("ANB", "blocks in series", {}, "4.5, l.829", "ST1 := ST1 and ST0, and ST0 is dropped."),
    basic("SET", "set", out("bit", kinds::kCoil), "4.6, l.830", "The bit becomes 1 when ST0 is 1, and stays."),
    basic("RST", "reset", out("bit", kinds::kCoil), "4.6, l.831", "The bit becomes 0 when ST0 is 1, and stays."),

    {{.info = {.mnemonic = "END1",
               .title = "end of Level 1",
               .group = "ends",
               .number = 0,
               .placement = Placement::AtRail,
               .ref = "5.1, l.1040",
               .doc = "Ends the Level 1 program. Appears exactly once, even if Level 1 is empty.",
               .example = "FUNC 0"},
      .control = Control::LevelEnd},
     &lowerEnd},
    {{.info = {.mnemonic = "END2",
               .title = "end of Level 2",
               .group = "ends",
               .number = 1,
               .placement = Placement::AtRail,
               .ref = "5.2, l.1054",
               .doc = "Ends the Level 2 program. Only subprograms may follow.",
               .example = "FUNC 1"},
      .control = Control::LevelEnd},
     &lowerEnd},
};

} // namespace rung::frontend::gsk
