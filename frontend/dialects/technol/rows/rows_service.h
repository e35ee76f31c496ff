// Rows: services of the control (man. ch. 9, 11-13, 17-20, 23, 26). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/device_request.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

struct ServiceCode {
  CheckFn check = nullptr;
  LowerFn lower = nullptr;
  DataForm form = DataForm::None;
};
inline constexpr ServiceCode kPlain{.lower = lowerService};
// Of EX kind, by the form of the data.
constexpr ServiceCode polled(DataForm form = DataForm::None) { return {checkService, lowerPolled, form}; }

struct ServiceShape {
  std::string_view group;
  OperandList operands;
  ServiceCode code;
  uint16_t effects = 0;
};
constexpr Row shapeOf(const ServiceShape& shape) {
  return {.info = {.group = shape.group, .operands = shape.operands},
          .effects = shape.effects,
          .check = shape.code.check,
          .lower = shape.code.lower,
          .variant = static_cast<int>(shape.code.form)};
}
constexpr Row serviceRow(std::string_view mnemonic, const ServiceShape& shape, std::string_view title,
                         std::string_view ref, std::string_view doc, std::string_view example) {
  return rowOf(shapeOf(shape), mnemonic, title, ref, doc, example, static_cast<int>(shape.code.form));
}
// Of EX kind: the program polls the request, its state is in RLO and DR (man. l.2090, l.15549, l.18043, l.18736).
constexpr Row pollingRow(std::string_view mnemonic, ServiceShape shape, std::string_view title, std::string_view ref,
                         std::string_view doc, std::string_view example) {
  shape.effects = kWaits | kSetsRlo | kSetsDr;
  Row row = serviceRow(mnemonic, shape, title, ref, doc, example);
  row.info.terminating = true;
  row.info.tasks = kSequentialUnits;
  return row;
}
constexpr OperandInfo byteNumber(std::string_view name, std::string_view doc) {
  return ranged(in(name, kinds::kNumber, doc), 0, 0xFF);
}
constexpr OperandInfo wordNumber(std::string_view name, std::string_view doc) {
  return ranged(in(name, kinds::kNumber, doc), 0, 0xFFFF);
}

inline constexpr OperandInfo kCan = ranged(in("can", kinds::kNumber, "logical CAN channel"), 1, 2);
inline constexpr OperandInfo kPacket = in("pmsg", kinds::kAddress, "place of 12 bytes for a packet");
inline constexpr OperandInfo kAxis = ranged(in("axis", kinds::kAxis, "number of the axis"), 1, 16);
inline constexpr OperandInfo kRegulatorSet = ranged(in("set", kinds::kNumber, "set of parameters"), 1, 4);
inline constexpr OperandInfo kCom = ranged(in("com", kinds::kNumber, "logical COM channel"), 0, 15);
inline constexpr OperandInfo kTable = byteNumber("TabIdx", "number of the table, from 0");
inline constexpr OperandInfo kLine = wordNumber("Line", "line, from 0");
inline constexpr OperandInfo kColumn = wordNumber("Col", "column, from 0");
inline constexpr OperandInfo kMaster = byteNumber("Master", "number of the EtherCAT master, from 0");
inline constexpr OperandInfo kSlave = wordNumber("Slave", "number of the slave in the order on the net, from 0");
inline constexpr OperandInfo kLength = inout("Len", kinds::kDwordCell, "length wanted, then the real one");
constexpr OperandInfo stored(std::string_view name, std::string_view doc) { return out(name, kinds::kCellOrText, doc); }
constexpr OperandInfo taken(std::string_view name, std::string_view doc) { return in(name, kinds::kCellOrText, doc); }
constexpr OperandList elementIn(const OperandKind& kind) {
  return {kTable, kLine, kColumn, out("Val", kind, "becomes the element")};
}
constexpr OperandList elementFrom(const OperandKind& kind) {
  return {kTable, kLine, kColumn, in("Val", kind, "what the element becomes")};
}

inline constexpr OperandList kReceiveRequest = {kCan,
                                                ranged(in("objl", kinds::kNumber, "lowest object"), 0, 0x7FF),
                                                ranged(in("objh", kinds::kNumberOrDash, "highest object"), 0, 0x7FF),
                                                ranged(in("idl", kinds::kNumber, "lowest NODE-ID"), 0, 0x7F),
                                                ranged(in("idh", kinds::kNumberOrDash, "highest NODE-ID"), 0, 0x7F),
                                                in("proc", kinds::kProcedure, "is called with each such packet"),
                                                kPacket};
inline constexpr OperandList kSystemUnit = {
    kCan, ranged(in("group", kinds::kNumber, "1 INOUT08, 2 KLA50, 3 handwheel"), 1, 3),
    ranged(in("board", kinds::kNumber, "number of the unit"), 1, 32),
    in("item", kinds::kItemOfAUnit, "member of INOUTS")};
inline constexpr OperandList kAnalog = {
    optional(in("val", kinds::kSignedOrDash, "value; without it DR")), optional(kAxis),
    optional(ranged(in("spi", kinds::kNumber, "0 none, 1 main, 2 assistant"), 0, 2))};
inline constexpr OperandList kSpindleToAxis = {in("feed1", kinds::kSignedOrNothing, "first speed"),
                                               in("feed2", kinds::kSignedOrNothing, "speed of the additional turn"),
                                               in("angle", kinds::kSignedOrNothing, "additional turn"),
                                               in("accel", kinds::kNumberOrNothing, "acceleration"), kAxis};
inline constexpr OperandList kShared = {wordNumber("SAIdx", "number of the area, from 0"),
                                        wordNumber("Offset", "first byte"), wordNumber("Size", "number of bytes"),
                                        stored("Val", "cell or text")};
inline constexpr OperandList kSharedFrom = {kShared[0], kShared[1], kShared[2], taken("Val", "cell or text")};
inline constexpr OperandList kObject = {kMaster,
                                        kSlave,
                                        wordNumber("Index", "index of the object"),
                                        byteNumber("Subindex", "its subindex"),
                                        stored("Val", "data"),
                                        kLength};
inline constexpr OperandList kObjectFrom = {kMaster, kSlave, kObject[2], kObject[3], taken("Val", "data"), kLength};
inline constexpr OperandList kIdentNumber = {kMaster,
                                             kSlave,
                                             byteNumber("DrNo", "number of the drive"),
                                             inout("ElemFl", kinds::kByteCell, "element flags"),
                                             wordNumber("IDN", "identification number"),
                                             stored("Val", "data"),
                                             kLength};
inline constexpr OperandList kIdentNumberFrom = {
    kMaster, kSlave, kIdentNumber[2], kIdentNumber[3], kIdentNumber[4], taken("Val", "data"), kLength};

constexpr ServiceShape ofCan(OperandList operands, ServiceCode code, uint16_t effects = 0) {
  return {.group = "CAN-BUS", .operands = operands, .code = code, .effects = effects};
}
constexpr ServiceShape ofSpindle(OperandList operands, LowerFn lower, uint16_t effects = 0) {
  return {.group = "spindle", .operands = operands, .code = {.lower = lower}, .effects = effects};
}
constexpr ServiceShape ofUnit(OperandList operands, ServiceCode code) {
  return {.group = "positioning unit", .operands = operands, .code = code};
}
constexpr ServiceShape ofTable(OperandList operands, DataForm form = DataForm::None) {
  return {.group = "PLC table", .operands = operands, .code = polled(form)};
}
constexpr ServiceShape ofEtherCat(OperandList operands, ServiceCode code = polled(DataForm::Bytes)) {
  return {.group = "EtherCAT", .operands = operands, .code = code};
}
constexpr ServiceShape ofCom(OperandList operands, ServiceCode code, uint16_t effects) {
  return {.group = "serial COM", .operands = operands, .code = code, .effects = effects};
}
constexpr Row regulatorRow(std::string_view mnemonic, std::string_view example) {
  return serviceRow(mnemonic, {.group = "servo", .operands = {kRegulatorSet}, .code = kPlain},
                    "set of parameters of an axis", "13.1, l.8452",
                    "The axis is controlled by this set of parameters from now on; after power-up by the first.",
                    example);
}
constexpr Row endOfOrderRow(std::string_view mnemonic, std::string_view ref, std::string_view example) {
  return serviceRow(mnemonic, ofCan({in("handle", kinds::kDwordCell, "handle of the order")}, kPlain, kSetsRlo),
                    "ends an order of packets", ref, "RLO becomes 1, or 0 if the order is unknown.", example);
}

inline constexpr Row kServiceRows[] = {
    // ---- CAN bus (man. ch. 9, 13.14) ----
    serviceRow(
        "CAN_SEND", ofCan({kCan, kPacket}, {checkPacket, lowerCanSend}, kSetsDr), "sends a packet", "9.4, l.3709",
        "DR becomes 0, or 1 where the queue is full, the bus is off or the channel is not active.", "CAN_SEND 2,TABLE"),
    serviceRow("CAN_RECV",
               ofCan({kCan, out("pmsg", kinds::kAddress, "place of 12 bytes for a packet")},
                     {checkPacket, lowerCanReceive}, kSetsDr),
               "takes a packet that was received", "9.4, l.3743",
               "The oldest packet that no order has taken; DR becomes 0, or 2 where there is none.",
               "CAN_RECV 2,TABLE"),
    serviceRow(
        "CAN_RECV_REQ", ofCan(kReceiveRequest, {checkPacket, lowerCanOrder}, kSetsRlo | kSetsDr),
        "orders packets for a procedure", "9.4, l.3779",
        "Each packet whose object and NODE-ID are in the ranges is put at `pmsg`, and the procedure is called with the "
        "channel in DR. RLO becomes 1 and DR the handle where the order is accepted, else both become 0.",
        "CAN_RECV_REQ 2,180h,-,21h,-,TOGGLE,TABLE"),
    endOfOrderRow("CAN_RECV_DEL", "9.4, l.3848", "CAN_RECV_DEL POS"),
    endOfOrderRow("CAN_RECV_END", "9.4, l.3850", "CAN_RECV_END POS"),
    serviceRow("CAN_SYSIO_READ", ofCan(kSystemUnit, {checkUnitItem, lowerUnitRead}, kSetsRlo | kSetsDr | kKeepsDr),
               "reads an item of a unit", "9.5, l.4276",
               "DR becomes the item. If the unit does not exist, RLO becomes 1 and DR keeps its value.",
               "CAN_SYSIO_READ 2,1,1,ERROR"),
    serviceRow("CAN_SYSIO_WRITE", ofCan(kSystemUnit, {checkUnitItem, lowerUnitWrite}, kReadsDr | kSetsRlo),
               "writes an item of a unit", "9.5, l.4317",
               "The item takes as many bytes of DR as it has. If the unit does not exist, RLO becomes 1.",
               "LOD  1\nCAN_SYSIO_WRITE 2,1,1,MODE"),
    serviceRow("CAN_AX_SEND", ofCan({kAxis}, {nullptr, lowerDriveSend}), "sends service data to a drive",
               "13.14.4, l.9474",
               "Sends CAN_AX_SEND_PACKET, of which the program fills in CAN_DATA alone. CAN_AX_BUSY is 0FFh until the "
               "answer is in "
               "CAN_AX_RECV_PACKET.",
               "CAN_AX_SEND 3"),
    // ---- spindles and servo drives (man. ch. 12, 13) ----
    serviceRow("ANALOG_PORT", ofSpindle({ranged(in("port", kinds::kNumber, "port"), 1, 16)}, lowerAnalogPort),
               "port of ANALOG", "12.2, l.7722", "ANALOG without an axis goes to this port until the next ANALOG_PORT.",
               "ANALOG_PORT 6"),
    serviceRow("ANALOG", ofSpindle(kAnalog, lowerAnalog, kReadsDr | kDrIfNotGiven), "analogue output", "12.2, l.7770",
               "Sets the output of the port, or with an axis that of a spindle: with `spi` the one that is main or "
               "assistant now, "
               "else the one that AX_SPI has switched last. 7FFFh is 10 V. Without a value it is in DR, of 16 bits.",
               "ANALOG SPEED,4,1"),
    serviceRow(
        "SPI_AX", ofSpindle(kSpindleToAxis, lowerToAxis), "positions a spindle", "12.3, l.7821",
        "The spindle becomes an axis, goes to its zero pulse with `feed1` and turns on by `angle` with `feed2` (1/1000 "
        "degree a minute, 1/1000 degree). POLOHV_x is 1 until then; 0 written there ends it.",
        "SPI_AX -,-,-,-,4"),
    serviceRow(
        "AX_SPI",
        ofSpindle({kAxis, optional(ranged(in("spi", kinds::kSpindle, "what it becomes"), 0, 2))}, lowerToSpindle),
        "an axis becomes a spindle", "12.3, l.7975",
        "With 1 the main spindle, with 2 the assistant, with S what SPI_MAIN has made it; 0 switches it off.",
        "AX_SPI 4,1"),
    serviceRow("SPI_MAIN", {.group = "spindle", .operands = {kAxis}, .code = kPlain}, "makes a spindle the main one",
               "12.3, l.7999", "The main spindle leads G95, G33 and G96.", "SPI_MAIN 4"),
    serviceRow("ANALOG_SPI",
               ofSpindle({in("val", kinds::kSignedOrDash, "value; without it DR"), kAxis}, lowerAnalogSpindle,
                         kReadsDr | kDrIfNotGiven),
               "analogue output of an axis", "12.3, l.8028",
               "As ANALOG, whether the spindle is main, assistant or neither.", "ANALOG_SPI SPEED,4"),
    serviceRow("RAMP",
               ofSpindle({inout("val", kinds::kIntegerCell, "moves towards DR"),
                          in("accel", kinds::kNumber, "most that it moves")},
                         lowerRamp, kReadsDr | kSetsDr),
               "one step of a ramp", "12.8, l.8274",
               "Moves a value towards DR by at most `accel`; DR becomes the value. Numbers have a sign.",
               "LOD  SPEED\nRAMP COUNT,100"),
    regulatorRow("REGUL_X", "REGUL_X 2"),
    regulatorRow("REGUL_Y", "REGUL_Y 2"),
    regulatorRow("REGUL_Z", "REGUL_Z 2"),
    regulatorRow("REGUL_4", "REGUL_4 2"),
    regulatorRow("REGUL_5", "REGUL_5 2"),
    regulatorRow("REGUL_6", "REGUL_6 2"),
    // ---- positioning units (man. ch. 19) ----
    serviceRow("POS_INIT",
               ofUnit({kAxis, optional(ranged(in("space", kinds::kNumber, "space of positions"), 0, 6))}, kPlain),
               "takes an axis for the PLC", "19.3, l.12136",
               "A motion that runs brakes and is lost. There are six units.", "POS_INIT 4"),
    serviceRow("POS_RESET", ofUnit({kAxis}, kPlain), "gives an axis back to the NC", "19.3, l.12191",
               "A motion that runs brakes and is lost.", "POS_RESET 4"),
    serviceRow("POS_MODE",
               ofUnit({in("control", kinds::kAddress, "control record of two bytes"),
                       in("len", kinds::kDistance, "distance, um"),
                       in("accel", kinds::kWordCell, "acceleration, mm/s2"), kAxis},
                      {checkRecord, lowerPositionMode}),
               "prepares a motion", "19.3, l.12205", "The motion begins when POS_CONTROL gives a speed and allows it.",
               "POS_MODE TABLE,POS,SPEED,4"),
    serviceRow(
        "POS_CONTROL",
        ofUnit({out("status", kinds::kAddress, "status record of two bytes"),
                in("feed", kinds::kDwordCell, "speed, 1/65536 mm/min"),
                in("mp", kinds::kBitOrNothing, "allows the motion; without it 1"), kAxis},
               {checkRecord, lowerPositionControl}),
        "controls a motion", "19.3, l.12240",
        "Gives speed and allowance, and reports the unit's state; to be called in every scan while the axis moves.",
        "POS_CONTROL TABLE,POS,GO,4"),
    // ---- shared area, tables (man. ch. 17, 18) ----
    pollingRow("SA_READ",
               {.group = "shared area", .operands = kShared, .code = {checkService, lowerShared, DataForm::Bytes}},
               "reads from a shared area", "18.3.1, l.15500",
               "RLO becomes 1 when it is done, 0 while the area is locked or where DR has an error.",
               "SA_READ 0,100,8,RATIO\nEX0"),
    pollingRow("SA_WRITE",
               {.group = "shared area", .operands = kSharedFrom, .code = {checkService, lowerShared, DataForm::Bytes}},
               "writes into a shared area", "18.3.1, l.15501",
               "RLO becomes 1 when it is done, 0 while the area is locked or where DR has an error.",
               "SA_WRITE 0,100,8,RATIO\nEX0"),
    pollingRow("PLCT_GET_INT", ofTable(elementIn(kinds::kCellOrText), DataForm::Integer), "reads an integer of a table",
               "17.4.1, l.18675", "A text becomes the four bytes of the number.", "PLCT_GET_INT 1,LIMIT,2,POS\nEX0"),
    pollingRow("PLCT_GET_REAL", ofTable(elementIn(kinds::kRealOrText), DataForm::Real), "reads a real of a table",
               "17.4.1, l.18676", "A text becomes the eight bytes of the number.",
               "PLCT_GET_REAL 1,LIMIT,2,RATIO\nEX0"),
    pollingRow("PLCT_GET_STR", ofTable(elementIn(kinds::kText), DataForm::Text), "reads a text of a table",
               "17.4.1, l.18677", "A text that does not fit is cut off.", "PLCT_GET_STR 1,LIMIT,2,TEXT1\nEX0"),
    pollingRow("PLCT_GET_BIN", ofTable(elementIn(kinds::kCellOrText), DataForm::Binary), "reads bytes of a table",
               "17.4.1, l.18678", "Bytes that do not fit are cut off; the rest of the variable keeps its value.",
               "PLCT_GET_BIN 1,LIMIT,2,TEXT1\nEX0"),
    pollingRow("PLCT_SET_INT", ofTable(elementFrom(kinds::kCellOrText), DataForm::Integer),
               "writes an integer of a table", "17.4.1, l.18679", "Of a text its first four bytes.",
               "PLCT_SET_INT 1,LIMIT,2,POS\nEX0"),
    pollingRow("PLCT_SET_REAL", ofTable(elementFrom(kinds::kRealOrText), DataForm::Real), "writes a real of a table",
               "17.4.1, l.18680", "Of a text its first eight bytes.", "PLCT_SET_REAL 1,LIMIT,2,RATIO\nEX0"),
    pollingRow("PLCT_SET_STR", ofTable(elementFrom(kinds::kText), DataForm::Text), "writes a text of a table",
               "17.4.1, l.18681", "The text up to its terminator.", "PLCT_SET_STR 1,LIMIT,2,TEXT1\nEX0"),
    pollingRow("PLCT_SET_BIN", ofTable(elementFrom(kinds::kCellOrText), DataForm::Binary), "writes bytes of a table",
               "17.4.1, l.18682", "All bytes of the variable.", "PLCT_SET_BIN 1,LIMIT,2,TEXT1\nEX0"),
    pollingRow("PLCT_COL_INDEX",
               ofTable({kTable, in("ID", kinds::kTextOrLiteral, "name of the column"),
                        out("Val", kinds::kIntegerCell, "its number")},
                       DataForm::Text),
               "finds the number of a column", "17.4.2, l.18785", "The name is compared as it is written.",
               "PLCT_COL_INDEX 1,'Feed',COUNT\nEX0"),
    pollingRow("PLCT_COL_ID",
               ofTable({kTable, inout("Poin", kinds::kText, "number of the column, then its name")}, DataForm::Text),
               "finds the name of a column", "17.4.2, l.18786",
               "The first word of the text is the number of the column.", "PLCT_COL_ID 1,TEXT1\nEX0"),
    pollingRow("PLCT_COL_TYPE", ofTable({kTable, kColumn, out("Val", kinds::kIntegerCell, "the type")}),
               "type of a column", "17.4.3, l.18880", "1 an integer, 2 a real, 3 a text, 4 bytes.",
               "PLCT_COL_TYPE 1,2,COUNT\nEX0"),
    pollingRow("PLCT_GET_SELLINE", ofTable({kTable, out("Val", kinds::kIntegerCell, "the line")}),
               "selected line of a table", "17.4.4, l.18941", "Lines count from 0.", "PLCT_GET_SELLINE 1,COUNT\nEX0"),
    pollingRow("PLCT_SET_SELLINE", ofTable({kTable, wordNumber("Val", "the line")}), "selects a line of a table",
               "17.4.4, l.18942", "Lines count from 0.", "PLCT_SET_SELLINE 1,COUNT\nEX0"),
    pollingRow(
        "PLCT_CHANGED", ofTable({kTable, out("Val", kinds::kIntegerCell, "what has changed")}),
        "what has changed in a table", "17.4.5, l.18997",
        "1: the operator has changed an element, 2: has selected another line, 0: neither. A change is reported once.",
        "PLCT_CHANGED 1,COUNT\nEX0"),
    pollingRow("PLCT_GET_LINESCOUNT", ofTable({kTable, out("Val", kinds::kIntegerCell, "number of lines")}),
               "number of lines of a table", "17.4.6, l.19042", "How many lines the table has now.",
               "PLCT_GET_LINESCOUNT 1,COUNT\nEX0"),
    // ---- EtherCAT, serial lines (man. ch. 23, 26) ----
    pollingRow("ECAT_COE_READ", ofEtherCat(kObject), "reads an object of a slave", "26.4.1, l.17996",
               "`Len` says how many bytes are wanted, and becomes how many have been read.",
               "ECAT_COE_READ 0,0,6041h,0,COUNT,POS\nEX0"),
    pollingRow("ECAT_COE_WRITE", ofEtherCat(kObjectFrom), "writes an object of a slave", "26.4.1, l.17997",
               "`Len` says how many bytes are written.", "ECAT_COE_WRITE 0,0,6040h,0,COUNT,POS\nEX0"),
    pollingRow("ECAT_SOE_READ", ofEtherCat(kIdentNumber), "reads an IDN of a slave", "26.4.2, l.18083",
               "`ElemFl` says which elements: 40h the value. `Len` becomes how many bytes have been read.",
               "ECAT_SOE_READ 0,0,0,CELL1,36,POS,POS\nEX0"),
    pollingRow("ECAT_SOE_WRITE", ofEtherCat(kIdentNumberFrom), "writes an IDN of a slave", "26.4.2, l.18084",
               "`ElemFl` says which element: 40h the value.", "ECAT_SOE_WRITE 0,0,0,CELL1,36,POS,POS\nEX0"),
    pollingRow(
        "ECAT_COMMAND",
        ofEtherCat({kMaster, kSlave, wordNumber("Cmd", "command, ECATCMD_..."), optional(stored("Val", "answer")),
                    optional(out("Len", kinds::kDwordCell, "becomes the length of the answer"))},
                   {checkEtherCatCommand, lowerPolled, DataForm::Binary}),
        "command to the EtherCAT master", "26.4.3, l.18168",
        "Brings the master or a slave into a state, or reads its state: 1 INIT, 2 PRE-OPERATIONAL, 3 BOOTSTRAP, 4 "
        "SAFE-OPERATIONAL, 8 OPERATIONAL.",
        "ECAT_COMMAND 0,0,8\nEX0"),
    serviceRow("COM_SEND",
               ofCom({kCom, optional(byteNumber("val", "character; without it DR"))}, {nullptr, lowerComSend},
                     kReadsDr | kDrIfNotGiven | kSetsRlo),
               "sends a character", "23.3.2, l.21063",
               "RLO becomes 1 if the queue is full or the channel does not exist.", "COM_SEND 1,COUNT"),
    serviceRow("COM_SEND_STR",
               ofCom({kCom, in("poin", kinds::kAddress, "the characters"), wordNumber("len", "how many")},
                     {checkService, lowerService, DataForm::Bytes}, kSetsRlo),
               "sends characters", "23.3.2, l.21088",
               "All are sent without a gap, or none: RLO becomes 1 if they do not fit in the queue or the channel does "
               "not exist.",
               "COM_SEND_STR 1,TEXT1,4"),
    serviceRow("COM_RECV",
               ofCom({kCom, optional(out("val", kinds::kIntegerCell, "becomes the character; else DR"))},
                     {nullptr, lowerComReceive}, kSetsRlo | kSetsDr | kKeepsDr),
               "takes a character that was received", "23.3.2, l.21138",
               "RLO becomes 0, or 1 where there is none; val and DR then stay.", "COM_RECV 1,COUNT"),
    serviceRow(
        "COM_CONTROL",
        ofCom({kCom, in("mode", kinds::kLineCommand, "what to do")}, {nullptr, lowerComControl}, kSetsRlo | kSetsDr),
        "queue and state of a serial line", "23.3.2, l.21165",
        "CLEAR empties the receive queue, RECEIVED counts it in DR, STATE reports in DR: 1 error, 2 not configured, 4 "
        "send "
        "overflow, 8 receive overflow. RLO becomes 1 for an error.",
        "COM_CONTROL 1,STATE"),
};

} // namespace rung::frontend::technol
