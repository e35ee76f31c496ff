// Rows: contacts, coils, pulses, section (man. §6.1, §6.2). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/nct/lower/lowering.h"
#include "frontend/dialects/nct/rows/instructions.h"
#include "frontend/dialects/nct/rows/operand_kinds.h"

namespace rung::nct {

using frontend::Access;
using frontend::Output;
using frontend::Placement;
using P = frontend::PinInfo;
using O = frontend::OperandInfo;

// --- families: rows that differ in a few words
// --------------------------------------------------------------------------
struct RowText {
  std::string_view mnemonic;
  std::string_view title;
  std::string_view ref;
  std::string_view doc;
  std::string_view example;
};

constexpr NctInstruction contactOf(RowText text, O operand, int variant) {
  return {.info = {.mnemonic = text.mnemonic,
                   .title = text.title,
                   .group = "bit",
                   .pins = {P{"IN", "power from the left"}},
                   .operands = {operand},
                   .output = Output::Always,
                   .placement = Placement::Anywhere,
                   .stateful = true,
                   .ref = text.ref,
                   .doc = text.doc,
                   .example = text.example},
          .lower = lowerContact,
          .variant = variant,
          .shape = Shape::Contact};
}
constexpr NctInstruction bitContact(RowText text, int variant) {
  return contactOf(
      text, {"Address", &kinds::kBit, Access::Read, "direct, indirect or indexed; @, % or, in INT0, ! before it"},
      variant);
}
constexpr NctInstruction wordContact(RowText text, int variant) {
  return contactOf(text, {"Address", &kinds::kWord, Access::Read, "may be indexed; @ or % before it"}, variant);
}

constexpr NctInstruction coilOf(RowText text, int variant, Claim claim) {
  return {.info = {.mnemonic = text.mnemonic,
                   .title = text.title,
                   .group = "bit",
                   .pins = {P{"IN", "condition"}},
                   .operands = {O{"Address", &kinds::kBit, Access::Write, "may be indexed; in INT0 ! before it"}},
                   .ref = text.ref,
                   .doc = text.doc,
                   .example = text.example},
          .lower = lowerCoil,
          .variant = variant,
          .claim = claim,
          .shape = Shape::Coil};
}

constexpr NctInstruction pulseRow(RowText text, int variant) {
  return {.info = {.mnemonic = text.mnemonic,
                   .title = text.title,
                   .group = "bit",
                   .pins = {P{"IN", "condition", true}},
                   .operands = {O{"Address", &kinds::kBit, Access::Write, "may be indexed"}},
                   .stateful = true,
                   .ref = text.ref,
                   .doc = text.doc,
                   .example = text.example},
          .lower = lowerPulse,
          .variant = variant,
          .claim = Claim::Once};
}

inline constexpr NctInstruction kBitRows[] = {
    bitContact({"open-contact-bit", "open contact on a bit", "6.1.1, l.785",
                "Power passes when the bit is 1. With @ or % it passes for one cycle after the bit has risen or "
                "fallen; the edge is kept for each contact of its own. With ! the time-slice memory is read.",
                "|--[START]--(MOTOR)"},
               0),
    wordContact({"open-contact-dword", "open contact on a double word", "6.1.2, l.829",
                 "Power passes when the word is not 0: a timer still runs, a counter has counted. Edges are those "
                 "of 'not 0'.",
                 "|--[T_WARM]--(WARMING)"},
                kOnWord),
    bitContact({"closed-contact-bit", "closed contact on a bit", "6.1.3, l.851",
                "Power passes when the bit is 0. With @ or % it is interrupted for one cycle after the edge and "
                "passes otherwise.",
                "|--[/STOP]--(MOTOR)"},
               kClosed),
    wordContact({"closed-contact-dword", "closed contact on a double word", "6.1.4, l.896",
                 "Power passes when the word is 0.", "|--[/T_WARM]--(WARM)"},
                kClosed | kOnWord),
    coilOf({"coil", "coil", "6.1.5, l.918", "The bit becomes 1 with power and 0 without it, in every evaluation.",
            "|--[START]--(MOTOR)"},
           kCoil, Claim::Once),
    coilOf({"negated-coil", "negated coil", "6.1.6, l.952",
            "The bit becomes 0 with power and 1 without it, in every evaluation.", "|--[RUNNING]--(/IDLE)"},
           kNegatedCoil, Claim::Once),
    coilOf({"SET", "set a bit", "6.1.7, l.986", "With power the bit becomes 1, without it nothing changes.",
            "|--[START]--(S LATCH)"},
           kSet, Claim::SetReset),
    coilOf({"RST", "reset a bit", "6.1.8, l.1019", "With power the bit becomes 0, without it nothing changes.",
            "|--[STOP]--(R LATCH)"},
           kReset, Claim::SetReset),
    pulseRow({"DIFU", "pulse on the rising edge of the condition", "6.1.9, l.1052",
              "The bit is 1 in the evaluation in which the condition turns TRUE and 0 in all others: a pulse of "
              "one cycle of its module.",
              "|--[START]--{DIFU START_P}"},
             kRising),
    pulseRow({"DIFD", "pulse on the falling edge of the condition", "6.1.10, l.1085",
              "The bit is 1 in the evaluation in which the condition turns FALSE and 0 in all others.",
              "|--[START]--{DIFD START_N}"},
             kFalling),
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

} // namespace rung::nct
