// Rows: messages (man. ch. 14). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/instructions.h"
#include "frontend/dialects/technol/lower.h"

namespace rung::frontend::technol {

inline constexpr Row kMessageRows[] = {
    // ---- messages (man. ch. 14) and the ends of start and shutdown (man. ch. 5) -----------------------------------
    {.info = {.mnemonic = "ESET",
              .title = "message",
              .group = "message",
              .operands =
                  {OperandInfo{
                       .name = "error", .kind = "message value", .doc = "number; in DR without it", .optional = true},
                   OperandInfo{.name = "subid", .kind = "message value", .doc = "additional number", .optional = true},
                   OperandInfo{.name = "set",
                               .kind = "message value",
                               .doc = "of a persistent message: 1 shows, 0 removes",
                               .optional = true},
                   OperandInfo{.name = "par1", .kind = "message value", .doc = "value in the text", .optional = true},
                   OperandInfo{.name = "par2", .kind = "message value", .doc = "value in the text", .optional = true},
                   OperandInfo{.name = "par3", .kind = "message value", .doc = "value in the text", .optional = true}},
              .ref = "14.3.1, l.5090",
              .doc = "Generates a message each time it is carried out.",
              .example = "ESET 12,-,-,BYTE.SPEED"},
     .effects = kReadsDr,
     .lower = lowerMessage,
     .variant = kAlways},
    {.info = {.mnemonic = "ESET1",
              .title = "message if 1",
              .group = "message",
              .operands =
                  {OperandInfo{
                       .name = "error", .kind = "message value", .doc = "number; in DR without it", .optional = true},
                   OperandInfo{.name = "subid", .kind = "message value", .doc = "additional number", .optional = true},
                   OperandInfo{.name = "set",
                               .kind = "message value",
                               .doc = "of a persistent message: 1 shows, 0 removes",
                               .optional = true},
                   OperandInfo{.name = "par1", .kind = "message value", .doc = "value in the text", .optional = true},
                   OperandInfo{.name = "par2", .kind = "message value", .doc = "value in the text", .optional = true},
                   OperandInfo{.name = "par3", .kind = "message value", .doc = "value in the text", .optional = true}},
              .terminating = true,
              .ref = "14.3.1, l.5091",
              .doc = "As ESET, but only while RLO is 1.",
              .example = "LDR  DOOR\nESET1 12"},
     .effects = kReadsDr | kReadsRlo,
     .lower = lowerMessage,
     .variant = kIfRlo},
    {.info = {.mnemonic = "EDEF",
              .title = "ties a bit to a message",
              .group = "message",
              .ref = "14.3.2, l.5192",
              .doc = "Ties a bit to a message."},
     .role = Role::NotBuilt,
     .effects = kInitOnly},
};

} // namespace rung::frontend::technol
