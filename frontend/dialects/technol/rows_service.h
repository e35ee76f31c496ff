// Rows: services of the control (man. ch. 9, 11-13, 17-20, 23, 26). Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/instructions.h"

namespace rung::frontend::technol {

// What the control does on request; not built yet.
constexpr Row serviceRow(std::string_view mnemonic, std::string_view group, std::string_view title,
                         std::string_view ref) {
  return {.info = {.mnemonic = mnemonic, .title = title, .group = group, .ref = ref, .doc = title},
          .role = Role::NotBuiltService};
}
// Of EX kind: the program polls it (man. l.2090, l.15549).
constexpr Row pollingRow(std::string_view mnemonic, std::string_view group, std::string_view title,
                         std::string_view ref) {
  Row row = serviceRow(mnemonic, group, title, ref);
  row.info.terminating = true;
  row.effects = kWaits;
  return row;
}

inline constexpr Row kServiceRows[] = {
    serviceRow("CAN_SEND", "CAN-BUS", "packets of the CAN bus", "9.4, l.3709"),
    serviceRow("CAN_RECV", "CAN-BUS", "packets of the CAN bus", "9.4, l.3743"),
    serviceRow("CAN_RECV_REQ", "CAN-BUS", "packets of the CAN bus", "9.4, l.3779"),
    serviceRow("CAN_RECV_DEL", "CAN-BUS", "packets of the CAN bus", "9.4, l.3848"),
    serviceRow("CAN_RECV_END", "CAN-BUS", "packets of the CAN bus", "9.4, l.3850"),
    serviceRow("CAN_SYSIO_READ", "CAN-BUS", "packets of the CAN bus", "9.5, l.4276"),
    serviceRow("CAN_SYSIO_WRITE", "CAN-BUS", "packets of the CAN bus", "9.5, l.4317"),
    serviceRow("CAN_AX_SEND", "CAN-BUS", "a packet to a drive", "13.14.4, l.9474"),
    serviceRow("ANALOG_PORT", "spindle", "works on a spindle", "12.2, l.7722"),
    serviceRow("ANALOG", "spindle", "works on a spindle", "12.2, l.7770"),
    serviceRow("SPI_AX", "spindle", "works on a spindle", "12.3, l.7821"),
    serviceRow("AX_SPI", "spindle", "works on a spindle", "12.3, l.7975"),
    serviceRow("SPI_MAIN", "spindle", "works on a spindle", "12.3, l.7999"),
    serviceRow("ANALOG_SPI", "spindle", "works on a spindle", "12.3, l.8028"),
    serviceRow("RAMP", "spindle", "works on a spindle", "12.8, l.8274"),
    serviceRow("REGUL_X", "servo", "selects a set of servo parameters", "13.1, l.8452"),
    serviceRow("REGUL_Y", "servo", "selects a set of servo parameters", "13.1, l.8452"),
    serviceRow("REGUL_Z", "servo", "selects a set of servo parameters", "13.1, l.8452"),
    serviceRow("REGUL_4", "servo", "selects a set of servo parameters", "13.1, l.8452"),
    serviceRow("REGUL_5", "servo", "selects a set of servo parameters", "13.1, l.8452"),
    serviceRow("REGUL_6", "servo", "selects a set of servo parameters", "13.1, l.8452"),
    serviceRow("POS_INIT", "positioning unit", "works on a positioning unit", "19.3, l.12136"),
    serviceRow("POS_RESET", "positioning unit", "works on a positioning unit", "19.3, l.12191"),
    serviceRow("POS_MODE", "positioning unit", "works on a positioning unit", "19.3, l.12205"),
    serviceRow("POS_CONTROL", "positioning unit", "works on a positioning unit", "19.3, l.12240"),
    pollingRow("SA_READ", "shared area", "reads or writes a shared area", "18.3.1, l.15500"),
    pollingRow("SA_WRITE", "shared area", "reads or writes a shared area", "18.3.1, l.15501"),
    pollingRow("PLCT_GET_INT", "PLC table", "reads or writes a PLC table", "17.4.1, l.18675"),
    pollingRow("PLCT_GET_REAL", "PLC table", "reads or writes a PLC table", "17.4.1, l.18676"),
    pollingRow("PLCT_GET_STR", "PLC table", "reads or writes a PLC table", "17.4.1, l.18677"),
    pollingRow("PLCT_GET_BIN", "PLC table", "reads or writes a PLC table", "17.4.1, l.18678"),
    pollingRow("PLCT_SET_INT", "PLC table", "reads or writes a PLC table", "17.4.1, l.18679"),
    pollingRow("PLCT_SET_REAL", "PLC table", "reads or writes a PLC table", "17.4.1, l.18680"),
    pollingRow("PLCT_SET_STR", "PLC table", "reads or writes a PLC table", "17.4.1, l.18681"),
    pollingRow("PLCT_SET_BIN", "PLC table", "reads or writes a PLC table", "17.4.1, l.18682"),
    pollingRow("PLCT_COL_INDEX", "PLC table", "reads or writes a PLC table", "17.4.2, l.18785"),
    pollingRow("PLCT_COL_ID", "PLC table", "reads or writes a PLC table", "17.4.2, l.18786"),
    pollingRow("PLCT_COL_TYPE", "PLC table", "reads or writes a PLC table", "17.4.3, l.18880"),
    pollingRow("PLCT_GET_SELLINE", "PLC table", "reads or writes a PLC table", "17.4.4, l.18941"),
    pollingRow("PLCT_SET_SELLINE", "PLC table", "reads or writes a PLC table", "17.4.4, l.18942"),
    pollingRow("PLCT_CHANGED", "PLC table", "reads or writes a PLC table", "17.4.5, l.18997"),
    pollingRow("PLCT_GET_LINESCOUNT", "PLC table", "reads or writes a PLC table", "17.4.6, l.19042"),
    pollingRow("ECAT_COE_READ", "EtherCAT", "asks the EtherCAT master", "26.4.1, l.17996"),
    pollingRow("ECAT_COE_WRITE", "EtherCAT", "asks the EtherCAT master", "26.4.1, l.17997"),
    pollingRow("ECAT_SOE_READ", "EtherCAT", "asks the EtherCAT master", "26.4.2, l.18083"),
    pollingRow("ECAT_SOE_WRITE", "EtherCAT", "asks the EtherCAT master", "26.4.2, l.18084"),
    pollingRow("ECAT_COMMAND", "EtherCAT", "asks the EtherCAT master", "26.4.3, l.18168"),
    serviceRow("COM_SEND", "serial COM", "works on a serial line", "23.3.2, l.21063"),
    serviceRow("COM_SEND_STR", "serial COM", "works on a serial line", "23.3.2, l.21088"),
    serviceRow("COM_RECV", "serial COM", "works on a serial line", "23.3.2, l.21138"),
    serviceRow("COM_CONTROL", "serial COM", "works on a serial line", "23.3.2, l.21165"),
};

} // namespace rung::frontend::technol
