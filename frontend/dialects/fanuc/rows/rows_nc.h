// Rows: messages, windows, axes by the PMC (inventory §6.10, §7). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

// The fixed part of a window block and the shortest data; the length of the data is known at run time only.
inline constexpr uint32_t kWindowBlockBytes = 10 + 1;
inline constexpr uint32_t kAxisBlockBytes = 8;

constexpr Row windowShape(std::string_view block, LowerFn lower) {
  Row row = withOutput("window", {kAct}, {record("control data", Access::ReadWrite, block)}, lower);
  row.recordBytes = kWindowBlockBytes;
  row.asks = Row::Asks::Count;
  return row;
}

constexpr Row axisShape() {
  Row row = withOutput(
      "axes", {PinInfo{.name = "RST", .doc = "1: ECLR of the group and W1=0; has priority over ACT"}, kAct},
      {number("group", 1, 9004, "1 to 4 A to D, with path - 1 in the thousands"),
       record("control data", Access::Read, "8 bytes: +1 command, +2 data 1 (2 bytes), +4 data 2 (4 bytes)")},
      &lowerAxisControl);
  row.recordBytes = kAxisBlockBytes;
  return withCheck(row, &checkAxisGroup);
}

inline constexpr Row kNcRows[] = {
    rowOf(withoutOutput("messages", {number("messages", 0, 9999, "ignored (F18)")}, &lowerDisplay), 41, "DISPB",
          "message display", "6.10, high",
          "ACT=1: the CNC shows the texts of the bits of A that are 1. The number of messages has no effect (F18).",
          "RD R9091.1\nSUB 41\n0"),
    rowOf(withOutput("external data", {kAct}, {in("control data", kinds::kDword)}, &lowerExternalData), 42, "EXIN",
          "external data input", "6.10, medium",
          "W1=1 when the request has ended. Controls here have no external data: it ends at once, and R9000.0 is 1.",
          "RD R0.0\nSUB 42\nD100\nWRT R0.1"),
    rowOf(
        windowShape("10 bytes and the data: words function, completion code, length, number, attribute, then data",
                    &lowerWindow),
        51, "WINDR", "window, read", "7, high",
        "Reads data of the CNC. W1=1 when the reading is finished: with a high-speed function in the scan of the call, "
        "with a low-speed one not before the third. ACT must stay 1 until then and become 0 once; of all low-speed "
        "functions one runs at a time, others wait. The completion code comes to +2, length and data to +4 and +10 "
        "with code 0 only; R9000.0 is 1 with any other. An unknown function ends with 1. ACT=0: W1=0.",
        "RD R0.0\nSUB 51\nD100\nWRT R0.1", kWindowRead),
    rowOf(windowShape("10 bytes and the data: words function, completion code, length, number, attribute, then data",
                      &lowerWindow),
          52, "WINDW", "window, write", "7, high",
          "Writes data of the CNC, always at low speed. The block is read when the request goes out; data without a "
          "length, or over the end of the area, end with 2; else as WINDR.",
          "RD R0.0\nSUB 52\nD100\nWRT R0.1", kWindowWrite),
    rowOf(
        axisShape(), 53, "AXCTL", "axis control by the PMC", "6.10, high",
        "Hands a command to the axes of a group: 1 to 4 are A to D of path 1, 1001 to 1004 of path 2. ACT=1 and EBUF = "
        "EBSY: command and data go to the G bytes of the group and EBUF is inverted. W1=1 when EBSY has followed; with "
        "ACT=0 it becomes 0 again. An unknown command: R9000.0 and W1 are 1, nothing is sent. RST=1 sets ECLR.",
        "RD R0.0\nRD.STK R0.1\nSUB 53\n1\nD100\nWRT R0.2"),
};

} // namespace rung::frontend::fanuc
