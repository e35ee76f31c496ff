// Rows: contacts, coils, pulses, section (man. §6.1, §6.2). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/lower/lower.h"
#include "frontend/dialects/nct/rows/instructions.h"
#include "frontend/dialects/nct/rows/operand_kinds.h"

namespace rung::frontend::nct {

using frontend::Access;
using frontend::Output;
using frontend::Placement;
using frontend::rowOf;
using P = frontend::PinInfo;
using O = frontend::OperandInfo;

// --- shapes of families: rows that differ in a few words
// --------------------------------------------------------------------------
constexpr Row contactShape(O operand) {
  return {.info = {.group = "bit",
                   .pins = {P{"IN", "power from the left"}},
                   .operands = {operand},
                   .output = Output::Always,
                   .placement = Placement::Anywhere,
                   .stateful = true},
          .lower = lowerContact,
          .shape = Shape::Contact};
}
inline constexpr Row kBitContact =
    contactShape({"Address", &kinds::kBit, Access::Read, "direct, indirect or indexed; @, % or, in INT0, ! before it"});
inline constexpr Row kWordContact =
    contactShape({"Address", &kinds::kWord, Access::Read, "may be indexed; @ or % before it"});

constexpr Row coilShape(Reservation reservation) {
  return {.info = {.group = "bit",
                   .pins = {P{"IN", "condition"}},
                   .operands = {O{"Address", &kinds::kBit, Access::Write, "may be indexed; in INT0 ! before it"}}},
          .lower = lowerCoil,
          .reservation = reservation,
          .shape = Shape::Coil};
}

inline constexpr Row kPulseShape = {.info = {.group = "bit",
                                             .pins = {P{"IN", "condition", true}},
                                             .operands = {O{"Address", &kinds::kBit, Access::Write, "may be indexed"}},
                                             .stateful = true},
                                    .lower = lowerPulse,
                                    .reservation = Reservation::Once};

inline constexpr Row kBitRows[] = {
    rowOf(kBitContact, "open-contact-bit", "open contact on a bit", "6.1.1, l.785",
          "Power passes when the bit is 1. With @ or % it passes for one cycle after the bit has risen or "
          "fallen; the edge is kept for each contact of its own. With ! the time-slice memory is read.",
          "|--[START]--(MOTOR)"),
    rowOf(kWordContact, "open-contact-dword", "open contact on a double word", "6.1.2, l.829",
          "Power passes when the word is not 0: a timer still runs, a counter has counted. Edges are those "
          "of 'not 0'.",
          "|--[T_WARM]--(WARMING)", kOnWord),
    rowOf(kBitContact, "closed-contact-bit", "closed contact on a bit", "6.1.3, l.851",
          "Power passes when the bit is 0. With @ or % it is interrupted for one cycle after the edge and "
          "passes otherwise.",
          "|--[/STOP]--(MOTOR)", kClosed),
    rowOf(kWordContact, "closed-contact-dword", "closed contact on a double word", "6.1.4, l.896",
          "Power passes when the word is 0.", "|--[/T_WARM]--(WARM)", kClosed | kOnWord),
    rowOf(coilShape(Reservation::Once), "coil", "coil", "6.1.5, l.918",
          "The bit becomes 1 with power and 0 without it, in every evaluation.", "|--[START]--(MOTOR)", kCoil),
    rowOf(coilShape(Reservation::Once), "negated-coil", "negated coil", "6.1.6, l.952",
          "The bit becomes 0 with power and 1 without it, in every evaluation.", "|--[RUNNING]--(/IDLE)", kNegatedCoil),
    rowOf(coilShape(Reservation::SetReset), "SET", "set a bit", "6.1.7, l.986",
          "With power the bit becomes 1, without it nothing changes.", "|--[START]--(S LATCH)", kSet),
    rowOf(coilShape(Reservation::SetReset), "RST", "reset a bit", "6.1.8, l.1019",
          "With power the bit becomes 0, without it nothing changes.", "|--[STOP]--(R LATCH)", kReset),
    rowOf(kPulseShape, "DIFU", "pulse on the rising edge of the condition", "6.1.9, l.1052",
          "The bit is 1 in the evaluation in which the condition turns TRUE and 0 in all others: a pulse of "
          "one cycle of its module.",
          "|--[START]--{DIFU START_P}", kRising),
    rowOf(kPulseShape, "DIFD", "pulse on the falling edge of the condition", "6.1.10, l.1085",
          "The bit is 1 in the evaluation in which the condition turns FALSE and 0 in all others.",
          "|--[START]--{DIFD START_N}", kFalling),
    {.info = {.mnemonic = "SEC",
              .title = "title of a section",
              .group = "structure",
              .pins = {P{"IN", "the left rail"}},
              .operands = {O{.name = "Remark",
                             .kind = &kinds::kText,
                             .access = Access::None,
                             .doc = "text in quotes",
                             .optional = true}},
              .placement = Placement::AtRail,
              .ref = "6.2.2, l.1193",
              .doc =
                  "Divides the listing and does nothing. Ladder text writes it as `section \"text\"` outside of rungs.",
              .example = "section \"Spindle\""},
     .flow = Flow::Section},
};

} // namespace rung::frontend::nct
