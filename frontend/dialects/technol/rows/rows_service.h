// Rows: services of the control (man. ch. 9, 11-13, 17-20, 23, 26). Their operands are checked; they are not built yet.
// Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

constexpr Row serviceRow(std::string_view mnemonic, std::string_view group, OperandList operands, std::string_view ref,
                         std::string_view doc, uint16_t effects = 0) {
  return {.info = {.mnemonic = mnemonic,
                   .title = doc.substr(0, doc.find_first_of(".;")),
                   .group = group,
                   .operands = operands,
                   .ref = ref,
                   .doc = doc},
          .role = Role::NotBuiltService,
          .effects = effects};
}
// Of EX kind: the program polls it, its state is in RLO and DR (man. l.2090, l.15549, l.18043, l.18736).
constexpr Row pollingRow(std::string_view mnemonic, std::string_view group, OperandList operands, std::string_view ref,
                         std::string_view title) {
  Row row = serviceRow(mnemonic, group, operands, ref, title, kWaits | kSetsRlo | kSetsDr);
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
inline constexpr OperandInfo kCom = in("com", kinds::kNumber, "logical COM channel");
inline constexpr OperandInfo kTable = byteNumber("TabIdx", "number of the table, from 0");
inline constexpr OperandInfo kLine = wordNumber("Line", "line, from 0");
inline constexpr OperandInfo kColumn = wordNumber("Col", "column, from 0");
inline constexpr OperandInfo kMaster = byteNumber("Master", "number of the EtherCAT master, from 0");
inline constexpr OperandInfo kSlave = wordNumber("Slave", "number of the slave in the order on the net, from 0");
inline constexpr OperandInfo kLength = inout("Len", kinds::kDwordCell, "length wanted, then the real one");
constexpr OperandInfo stored(std::string_view name, std::string_view doc) { return out(name, kinds::kCellOrText, doc); }
constexpr OperandInfo taken(std::string_view name, std::string_view doc) { return in(name, kinds::kCellOrText, doc); }

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
    optional(in("val", kinds::kNumberOrDash, "value; without it DR")), optional(kAxis),
    optional(ranged(in("spi", kinds::kNumber, "0 none, 1 main, 2 assistant"), 0, 2))};
inline constexpr OperandList kSpindleToAxis = {in("feed1", kinds::kNumberOrNothing, "first speed"),
                                               in("feed2", kinds::kNumberOrNothing, "speed of the additional turn"),
                                               in("angle", kinds::kNumberOrNothing, "additional turn"),
                                               in("accel", kinds::kNumberOrNothing, "acceleration"), kAxis};
inline constexpr OperandList kShared = {wordNumber("SAIdx", "number of the area, from 0"),
                                        wordNumber("Offset", "first byte"), wordNumber("Size", "number of bytes"),
                                        stored("Val", "cell or text")};
inline constexpr OperandList kSharedFrom = {kShared[0], kShared[1], kShared[2], taken("Val", "cell or text")};
inline constexpr OperandList kElement = {kTable, kLine, kColumn, stored("Val", "becomes the element")};
inline constexpr OperandList kElementFrom = {kTable, kLine, kColumn, taken("Val", "what the element becomes")};
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

inline constexpr Row kServiceRows[] = {
    // ---- CAN bus (man. ch. 9, 13.14) ----
    serviceRow("CAN_SEND", "CAN-BUS", {kCan, kPacket}, "9.4, l.3709",
               "Sends a packet; DR shows whether it was accepted.", kSetsDr),
    serviceRow("CAN_RECV", "CAN-BUS", {kCan, out("pmsg", kinds::kAddress, "place of 12 bytes for a packet")},
               "9.4, l.3743", "Takes a packet that was received; DR shows whether there was one.", kSetsDr),
    serviceRow("CAN_RECV_REQ", "CAN-BUS", kReceiveRequest, "9.4, l.3779",
               "Orders packets for an event procedure; RLO shows whether it was accepted, DR holds the handle.",
               kSetsRlo | kSetsDr),
    serviceRow("CAN_RECV_DEL", "CAN-BUS", {in("handle", kinds::kDwordCell, "handle of the order")}, "9.4, l.3848",
               "Ends an order of packets.", kSetsRlo),
    serviceRow("CAN_RECV_END", "CAN-BUS", {in("handle", kinds::kDwordCell, "handle of the order")}, "9.4, l.3850",
               "Ends an order of packets, as CAN_RECV_DEL.", kSetsRlo),
    serviceRow("CAN_SYSIO_READ", "CAN-BUS", kSystemUnit, "9.5, l.4276",
               "DR becomes an item of a unit; RLO 1 is an error.", kSetsRlo | kSetsDr),
    serviceRow("CAN_SYSIO_WRITE", "CAN-BUS", kSystemUnit, "9.5, l.4317",
               "An item of a unit becomes DR; RLO 1 is an error.", kReadsDr | kSetsRlo),
    serviceRow("CAN_AX_SEND", "CAN-BUS", {kAxis}, "13.14.4, l.9474", "Sends CAN_AX_SEND_PACKET to a drive."),
    // ---- spindles and servo drives (man. ch. 12, 13) ----
    serviceRow("ANALOG_PORT", "spindle", {ranged(in("port", kinds::kNumber, "port"), 1, 16)}, "12.2, l.7722",
               "Selects the port of ANALOG."),
    serviceRow("ANALOG", "spindle", kAnalog, "12.2, l.7770", "Sets the analogue output of the port or of an axis."),
    serviceRow("SPI_AX", "spindle", kSpindleToAxis, "12.3, l.7821", "A spindle becomes an axis and is positioned."),
    serviceRow("AX_SPI", "spindle", {kAxis, optional(ranged(in("spi", kinds::kSpindle, "what it becomes"), 0, 2))},
               "12.3, l.7975", "An axis becomes a spindle."),
    serviceRow("SPI_MAIN", "spindle", {kAxis}, "12.3, l.7999", "Makes a spindle the main one."),
    serviceRow("ANALOG_SPI", "spindle", {in("val", kinds::kNumberOrDash, "value; without it DR"), kAxis},
               "12.3, l.8028", "Sets the analogue output of an axis."),
    serviceRow("RAMP", "spindle",
               {inout("val", kinds::kIntegerCell, "moves towards DR"), in("accel", kinds::kNumber, "step")},
               "12.8, l.8274", "Moves a value towards DR by one step; DR becomes the value.", kReadsDr | kSetsDr),
    serviceRow("REGUL_X", "servo", {kRegulatorSet}, "13.1, l.8452", "Selects a set of parameters of the axis."),
    serviceRow("REGUL_Y", "servo", {kRegulatorSet}, "13.1, l.8452", "Selects a set of parameters of the axis."),
    serviceRow("REGUL_Z", "servo", {kRegulatorSet}, "13.1, l.8452", "Selects a set of parameters of the axis."),
    serviceRow("REGUL_4", "servo", {kRegulatorSet}, "13.1, l.8452", "Selects a set of parameters of the axis."),
    serviceRow("REGUL_5", "servo", {kRegulatorSet}, "13.1, l.8452", "Selects a set of parameters of the axis."),
    serviceRow("REGUL_6", "servo", {kRegulatorSet}, "13.1, l.8452", "Selects a set of parameters of the axis."),
    // ---- positioning units (man. ch. 19) ----
    serviceRow("POS_INIT", "positioning unit",
               {kAxis, optional(ranged(in("space", kinds::kNumber, "space of positions"), 0, 6))}, "19.3, l.12136",
               "Takes an axis for the PLC."),
    serviceRow("POS_RESET", "positioning unit", {kAxis}, "19.3, l.12191", "Gives an axis back to the NC."),
    serviceRow("POS_MODE", "positioning unit",
               {in("control", kinds::kAddress, "control record of two bytes"),
                in("len", kinds::kDwordCell, "distance, um"), in("accel", kinds::kWordCell, "acceleration, mm/s2"),
                kAxis},
               "19.3, l.12205", "Prepares a motion."),
    serviceRow("POS_CONTROL", "positioning unit",
               {out("status", kinds::kAddress, "status record of two bytes"),
                in("feed", kinds::kDwordCell, "speed, 1/64000 mm/min"),
                in("mp", kinds::kBitOrNothing, "allows the motion"), kAxis},
               "19.3, l.12240", "Controls a motion and reports its state."),
    // ---- shared area, tables (man. ch. 17, 18) ----
    pollingRow("SA_READ", "shared area", kShared, "18.3.1, l.15500", "Reads from a shared area."),
    pollingRow("SA_WRITE", "shared area", kSharedFrom, "18.3.1, l.15501", "Writes into a shared area."),
    pollingRow("PLCT_GET_INT", "PLC table", kElement, "17.4.1, l.18675", "Reads an integer of a table."),
    pollingRow("PLCT_GET_REAL", "PLC table", kElement, "17.4.1, l.18676", "Reads a real of a table."),
    pollingRow("PLCT_GET_STR", "PLC table", kElement, "17.4.1, l.18677", "Reads a text of a table."),
    pollingRow("PLCT_GET_BIN", "PLC table", kElement, "17.4.1, l.18678", "Reads bytes of a table."),
    pollingRow("PLCT_SET_INT", "PLC table", kElementFrom, "17.4.1, l.18679", "Writes an integer of a table."),
    pollingRow("PLCT_SET_REAL", "PLC table", kElementFrom, "17.4.1, l.18680", "Writes a real of a table."),
    pollingRow("PLCT_SET_STR", "PLC table", kElementFrom, "17.4.1, l.18681", "Writes a text of a table."),
    pollingRow("PLCT_SET_BIN", "PLC table", kElementFrom, "17.4.1, l.18682", "Writes bytes of a table."),
    pollingRow(
        "PLCT_COL_INDEX", "PLC table",
        {kTable, in("ID", kinds::kTextOrLiteral, "name of the column"), out("Val", kinds::kIntegerCell, "its number")},
        "17.4.2, l.18785", "Finds the number of a column."),
    pollingRow("PLCT_COL_ID", "PLC table",
               {kTable, inout("Poin", kinds::kAddress, "number of the column, then its name")}, "17.4.2, l.18786",
               "Finds the name of a column."),
    pollingRow("PLCT_COL_TYPE", "PLC table", {kTable, kColumn, out("Val", kinds::kIntegerCell, "the type")},
               "17.4.3, l.18880", "Reports the type of a column."),
    pollingRow("PLCT_GET_SELLINE", "PLC table", {kTable, out("Val", kinds::kIntegerCell, "the line")},
               "17.4.4, l.18941", "Reports the selected line."),
    pollingRow("PLCT_SET_SELLINE", "PLC table", {kTable, wordNumber("Val", "the line")}, "17.4.4, l.18942",
               "Selects a line."),
    pollingRow("PLCT_CHANGED", "PLC table", {kTable, out("Val", kinds::kIntegerCell, "what has changed")},
               "17.4.5, l.18997", "Reports what has changed in a table."),
    pollingRow("PLCT_GET_LINESCOUNT", "PLC table", {kTable, out("Val", kinds::kIntegerCell, "number of lines")},
               "17.4.6, l.19042", "Reports how many lines a table has."),
    // ---- EtherCAT, serial lines (man. ch. 23, 26) ----
    pollingRow("ECAT_COE_READ", "EtherCAT", kObject, "26.4.1, l.17996", "Reads an object of a slave."),
    pollingRow("ECAT_COE_WRITE", "EtherCAT", kObjectFrom, "26.4.1, l.17997", "Writes an object of a slave."),
    pollingRow("ECAT_SOE_READ", "EtherCAT", kIdentNumber, "26.4.2, l.18083", "Reads an IDN of a slave."),
    pollingRow("ECAT_SOE_WRITE", "EtherCAT", kIdentNumberFrom, "26.4.2, l.18084", "Writes an IDN of a slave."),
    pollingRow("ECAT_COMMAND", "EtherCAT",
               {kMaster, kSlave, wordNumber("Cmd", "command, ECATCMD_..."), optional(stored("Val", "answer")),
                optional(kLength)},
               "26.4.3, l.18168", "Gives a command to the master."),
    serviceRow("COM_SEND", "serial COM", {kCom, optional(byteNumber("val", "character; without it DR"))},
               "23.3.2, l.21063", "Sends a character; RLO 1 is an error.", kSetsRlo),
    serviceRow("COM_SEND_STR", "serial COM",
               {kCom, in("poin", kinds::kAddress, "the characters"), wordNumber("len", "how many")}, "23.3.2, l.21088",
               "Sends characters; RLO 1 is an error.", kSetsRlo),
    serviceRow("COM_RECV", "serial COM",
               {kCom, optional(out("val", kinds::kIntegerCell, "becomes the character; else DR"))}, "23.3.2, l.21138",
               "Takes a character that was received; RLO 1: there was none.", kSetsRlo | kSetsDr),
    serviceRow("COM_CONTROL", "serial COM", {kCom, in("mode", kinds::kLineCommand, "what to do")}, "23.3.2, l.21165",
               "Empties the queue of a line, counts it, or reports the line's state in DR.", kSetsDr),
};

} // namespace rung::frontend::technol
