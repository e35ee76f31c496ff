// Rows: window, axis control, position signals: FUNC 44-49 (man. Part I §5.45-§5.49). Included by instructions.cpp
// only.
#pragma once
#include "frontend/dialects/gsk/rows/row_parts.h"
#include "rtlib/nc/gsk/axis_commands.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::frontend::gsk {

// The fixed part of a window block and the shortest data; the length of the data is known at run time only.
inline constexpr uint32_t kWindowBlockBytes = nc::pmc::kWindowDataAt + 1;
inline constexpr uint32_t kZoneBlockBytes = 1 + 7 * 4;  // man. l.3437-3447
inline constexpr uint32_t kRangeBlockBytes = 1 + 2 * 4; // P56

constexpr Row windowShape(std::string_view block) {
  return {{.info = {.group = "window",
                    .pins = {kAct},
                    .operands = {record("control data", Access::ReadWrite, block),
                                 out("result", kinds::kByte, "bit 0: an error")},
                    .output = Output::Always,
                    .stateful = true},
           .recordBytes = kWindowBlockBytes},
          &lowerWindow,
          0,
          Row::Asks::Count};
}

inline constexpr Row kNcRows[] = {
    rowOf(windowShape("10 bytes and the data: words function, end code, length L, number M, attribute N, then L bytes"),
          44, "WINDR", "window, read", "5.45, l.3089",
          "Reads data of the CNC. OUT=1 when the reading is finished: with a high-speed function in the scan of the "
          "call, with a low-speed one not before the third. Low speed: ACT must stay 1 until then and has to be taken "
          "away once; of all low-speed functions of the program one runs at a time, others wait while its ACT is 1; "
          "when ACT goes too early the answer is thrown away (P48). The end code comes to +2, the data to +10 with end "
          "code 0 only; bit 0 of the result is 1 with any other (P47). Without asking the CNC end, in this order: a "
          "function that WINDR does not know, 1; one that is not open, 6; a length other than 1, 2, 4, or data over "
          "the end of the area, 2 (P49). ACT=0: OUT=0.",
          "LD R0.0\nFUNC 44\nPRM D100\nPRM R10\nOUT R0.1", kWindowRead),
    rowOf(windowShape(
              "10 bytes and the data: words function, end code, length L, number M, attribute N, then L bytes, signed"),
          45, "WINDW", "window, write", "5.46, l.3148",
          "Writes data of the CNC, always at low speed. The block is read when the request goes out; else as WINDR.",
          "LD R0.0\nFUNC 45\nPRM D100\nPRM R10\nOUT R0.1", kWindowWrite),
    {{.info = {.mnemonic = "AXLCTL",
               .title = "PLC axis control",
               .group = "axis control",
               .number = 46,
               .pins = {PinInfo{.name = "RST", .doc = "1: ECLR of the group and OUT=0; has priority over ACT (P17)"},
                        kAct},
               .operands = {number("group", 1, 8, "1 A to 8 H"),
                            record("control data", Access::Read,
                                   "8 bytes: +1 command (bit 7 EMSBK), +2 data 1 (2 bytes), +4 data 2 (4 bytes)"),
                            out("result", kinds::kByte, "bit 5: unknown command")},
               .output = Output::Always,
               .stateful = true,
               .ref = "5.47, l.3241",
               .doc =
                   "Hands a command to the axes of a group. ACT=1 and EBUF = EBSY: the command, data 1 and data 2 go "
                   "to the G bytes of the group and EBUF is inverted. OUT=1 when EBSY has followed, also when ACT "
                   "has gone; with ACT=0 it becomes 0 again (P52). An unknown command: bit 5 of the result, OUT=1, "
                   "nothing is sent (P53). RST=1 sets ECLR, RST=0 clears it.",
               .example = "LD R0.0\nLD R0.1\nFUNC 46\nPRM 1\nPRM D100\nPRM R10\nOUT R0.2"},
      .recordBytes = nc::pmc::kAxisBlockBytes},
     &lowerAxisControl},
    {{.info = {.mnemonic = "PSGNL",
               .title = "position signals",
               .group = "position",
               .number = 48,
               .pins = {kAct},
               .operands = {record("zones", Access::Read, "29 bytes: axis number, then limits I to VII of 4 bytes"),
                            out("area", kinds::kByte, "bit 7 the lowest zone, bit 0 the highest"),
                            out("result", kinds::kByte, "bit 0: no such axis, bit 1: limits not ascending")},
               .ref = "5.48, l.3397",
               .doc = "The bit of the zone that holds the machine position of the axis becomes 1, the others 0. Limits "
                      "are signed, in 0.001 mm, and ascend; a position at a limit is in the zone above; limits may be "
                      "equal, the zone between is empty then. On an error the area is 0 (P55). ACT=0: nothing happens.",
               .example = "LD X9.0\nFUNC 48\nPRM D100\nPRM R10\nPRM R11"},
      .recordBytes = kZoneBlockBytes},
     &lowerPositionZones},
    {{.info = {.mnemonic = "PSGN2",
               .title = "position signal",
               .group = "position",
               .number = 49,
               .pins = {kAct},
               .operands = {record("control data", Access::Read,
                                   "9 bytes: axis number, lower limit (4 bytes), upper limit (4 bytes)"),
                            out("result", kinds::kByte, "bit 0: no such axis, bit 1: limits not ascending")},
               .output = Output::Always,
               .stateful = true,
               .ref = "5.49, l.3490",
               .doc = "OUT=1 when lower limit <= machine position of the axis <= upper limit, signed, in 0.001 mm "
                      "(P56). On an error OUT=0. ACT=0: OUT stays (P15).",
               .example = "LD X9.0\nFUNC 49\nPRM D100\nPRM R11\nOUT R0.3"},
      .recordBytes = kRangeBlockBytes},
     &lowerPositionRange},
};

} // namespace rung::frontend::gsk
