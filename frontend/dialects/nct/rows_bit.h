// Rows: contacts, coils, pulses, section (man. §6.1, §6.2). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/instructions.h"
#include "frontend/dialects/nct/lowering.h"

namespace rung::nct {

using frontend::Access;
using frontend::Output;
using frontend::Placement;
using P = frontend::PinInfo;
using O = frontend::OperandInfo;

inline constexpr NctInstruction kBitRows[] = {
    {.info = {.mnemonic = "open-contact-bit", .title = "open contact on a bit", .group = "bit", .pins = {P{"IN", "power from the left"}},
              .operands = {O{"Address", "bit", Access::Read, "direct, indirect or indexed; @ % or, in INT0, ! in front"}},
              .output = Output::Always, .placement = Placement::Anywhere, .stateful = true, .ref = "6.1.1, l.785",
              .doc = "Power passes when the bit is 1. With @ or % it passes for one cycle after the bit has risen or fallen; the edge is "
                     "kept for each contact of its own. With ! the time-slice memory is read.",
              .example = "|--[START]--(MOTOR)"},
     .lower = lowerContact, .variant = 0, .shape = Shape::Contact},
    {.info = {.mnemonic = "open-contact-dword", .title = "open contact on a double word", .group = "bit", .pins = {P{"IN", "power from the left"}},
              .operands = {O{"Address", "word", Access::Read, "may be indexed; @ or % in front"}},
              .output = Output::Always, .placement = Placement::Anywhere, .stateful = true, .ref = "6.1.2, l.829",
              .doc = "Power passes when the word is not 0: a timer still runs, a counter has counted. Edges are those of 'not 0'.",
              .example = "|--[T_WARM]--(WARMING)"},
     .lower = lowerContact, .variant = kOnWord, .shape = Shape::Contact},
    {.info = {.mnemonic = "closed-contact-bit", .title = "closed contact on a bit", .group = "bit", .pins = {P{"IN", "power from the left"}},
              .operands = {O{"Address", "bit", Access::Read, "direct, indirect or indexed; @ % or, in INT0, ! in front"}},
              .output = Output::Always, .placement = Placement::Anywhere, .stateful = true, .ref = "6.1.3, l.851",
              .doc = "Power passes when the bit is 0. With @ or % it is interrupted for one cycle after the edge and passes otherwise.",
              .example = "|--[/STOP]--(MOTOR)"},
     .lower = lowerContact, .variant = kClosed, .shape = Shape::Contact},
    {.info = {.mnemonic = "closed-contact-dword", .title = "closed contact on a double word", .group = "bit", .pins = {P{"IN", "power from the left"}},
              .operands = {O{"Address", "word", Access::Read, "may be indexed; @ or % in front"}},
              .output = Output::Always, .placement = Placement::Anywhere, .stateful = true, .ref = "6.1.4, l.896",
              .doc = "Power passes when the word is 0.", .example = "|--[/T_WARM]--(WARM)"},
     .lower = lowerContact, .variant = kClosed | kOnWord, .shape = Shape::Contact},
    {.info = {.mnemonic = "coil", .title = "coil", .group = "bit", .pins = {P{"IN", "condition"}},
              .operands = {O{"Address", "bit", Access::Write, "may be indexed; in INT0 ! in front"}}, .ref = "6.1.5, l.918",
              .doc = "The bit becomes 1 with power and 0 without it, in every evaluation.", .example = "|--[START]--(MOTOR)"},
     .lower = lowerCoil, .variant = kCoil, .claim = Claim::Once, .shape = Shape::Coil},
    {.info = {.mnemonic = "negated-coil", .title = "negated coil", .group = "bit", .pins = {P{"IN", "condition"}},
              .operands = {O{"Address", "bit", Access::Write, "may be indexed; in INT0 ! in front"}}, .ref = "6.1.6, l.952",
              .doc = "The bit becomes 0 with power and 1 without it, in every evaluation.", .example = "|--[RUNNING]--(/IDLE)"},
     .lower = lowerCoil, .variant = kNegatedCoil, .claim = Claim::Once, .shape = Shape::Coil},
    {.info = {.mnemonic = "SET", .title = "set a bit", .group = "bit", .pins = {P{"IN", "condition"}},
              .operands = {O{"Address", "bit", Access::Write, "may be indexed; in INT0 ! in front"}}, .ref = "6.1.7, l.986",
              .doc = "With power the bit becomes 1, without it nothing changes.", .example = "|--[START]--(S LATCH)"},
     .lower = lowerCoil, .variant = kSet, .claim = Claim::SetReset, .shape = Shape::Coil},
    {.info = {.mnemonic = "RST", .title = "reset a bit", .group = "bit", .pins = {P{"IN", "condition"}},
              .operands = {O{"Address", "bit", Access::Write, "may be indexed; in INT0 ! in front"}}, .ref = "6.1.8, l.1019",
              .doc = "With power the bit becomes 0, without it nothing changes.", .example = "|--[STOP]--(R LATCH)"},
     .lower = lowerCoil, .variant = kReset, .claim = Claim::SetReset, .shape = Shape::Coil},
    {.info = {.mnemonic = "DIFU", .title = "pulse on the rising edge of the condition", .group = "bit", .pins = {P{"IN", "condition", true}},
              .operands = {O{"Address", "bit", Access::Write, "may be indexed"}}, .stateful = true, .ref = "6.1.9, l.1052",
              .doc = "The bit is 1 in the evaluation in which the condition turns TRUE and 0 in all others: a pulse of one cycle of its module.",
              .example = "|--[START]--{DIFU START_P}"},
     .lower = lowerPulse, .variant = kRising, .claim = Claim::Once},
    {.info = {.mnemonic = "DIFD", .title = "pulse on the falling edge of the condition", .group = "bit", .pins = {P{"IN", "condition", true}},
              .operands = {O{"Address", "bit", Access::Write, "may be indexed"}}, .stateful = true, .ref = "6.1.10, l.1085",
              .doc = "The bit is 1 in the evaluation in which the condition turns FALSE and 0 in all others.",
              .example = "|--[START]--{DIFD START_N}"},
     .lower = lowerPulse, .variant = kFalling, .claim = Claim::Once},
    {.info = {.mnemonic = "SEC", .title = "title of a section", .group = "structure", .pins = {P{"IN", "the left rail"}},
              .operands = {O{.name = "Remark", .kind = "text", .access = Access::None, .doc = "text in quotes", .optional = true}},
              .placement = Placement::AtRail, .ref = "6.2.2, l.1193",
              .doc = "Divides the listing and does nothing. Ladder text writes it as `section \"text\"` outside of rungs.",
              .example = "section \"Spindle\""},
     .flow = Flow::Section},
};

} // namespace rung::nct
