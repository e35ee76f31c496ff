// Rows: window, axis control, position signals: FUNC 44-49 (man. Part I §5.45-§5.49). Included by instructions.cpp
// only.
#pragma once
#include "frontend/dialects/gsk/row_parts.h"

namespace rung::gsk {

inline constexpr Row kNcRows[] = {
    {.info = {.mnemonic = "WINDR",
              .title = "window, read",
              .group = "window",
              .number = 44,
              .pins = {kAct},
              .operands = {in("control data", Kind::Byte, "10 bytes and the data"), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.45, l.3089",
              .doc = "Reads data of the CNC through a control block."}},
    {.info = {.mnemonic = "WINDW",
              .title = "window, write",
              .group = "window",
              .number = 45,
              .pins = {kAct},
              .operands = {in("control data", Kind::Byte, "10 bytes and the data"), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.46, l.3148",
              .doc = "Writes data of the CNC through a control block."}},
    {.info = {.mnemonic = "AXLCTL",
              .title = "axis control",
              .group = "axis control",
              .number = 46,
              .pins = {kRst, kAct},
              .operands = {number("group", 1, 8), in("control data", Kind::Byte, "8 bytes"), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.47, l.3241",
              .doc = "Hands a command to an axis of the PLC."}},
    {.info = {.mnemonic = "PSGNL",
              .title = "position signals",
              .group = "position",
              .number = 48,
              .pins = {kAct},
              .operands = {in("zones", Kind::Byte, "29 bytes"), out("area", Kind::Byte), out("result", Kind::Byte)},
              .ref = "5.48, l.3397",
              .doc = "Tells in which zone a machine position lies."}},
    {.info = {.mnemonic = "PSGN2",
              .title = "position signal",
              .group = "position",
              .number = 49,
              .pins = {kAct},
              .operands = {in("zone", Kind::Byte), out("result", Kind::Byte)},
              .output = Output::Always,
              .stateful = true,
              .ref = "5.49, l.3490",
              .doc = "Tells whether a machine position lies in a zone."}},
};

} // namespace rung::gsk
