// The table of services.
#include "rtlib/nc/technol/services.h"

#include <algorithm>
#include <iterator>

#include "rtlib/text/letters.h"

namespace rung::nc::technol {

namespace {

using enum ServiceKind;

// "There is no such table, area, master" (inventory of the services, 2, 3, 12).
constexpr int64_t kNone = 1;
constexpr DeviceAnswer kPolled = {.waits = true, .refused = {kNone}};
constexpr DeviceAnswer kOfArea = {.waits = true, .refused = {0, kNone}};

constexpr DeviceService kServices[] = {
    {{FetchBytes, "@DATA ticket part -> w0 w1 w2 w3 w4 w5 w6 w7 w8 w9 w10 w11 w12 w13 w14 w15"}, Device::Bytes},
    {{Configuration,
      "@CNF_GET kind part id0 id1 id2 id3 id4 id5 id6 id7 id8 id9 id10 id11 id12 id13 -> found length v0 v1 v2 v3 v4 "
      "v5 v6 v7 v8 v9 v10 v11 v12 v13"}},
    {{Define, "@DEFINE what place min max id0 id1 id2 id3 id4 id5 id6 id7 id8 id9 id10 id11 -> done configured value"}},
    {{UpdateInput, "@UPDATE_IN place -> found value"}},
    {{CanSend, "CAN_SEND can id rtr len data:b -> DR"}, Device::Can, {.refused = {1}}},
    {{CanReceive, "CAN_RECV can -> DR id rtr data:b"}, Device::Can, {.unanswered = {2}, .refused = {2}}},
    {{CanOrder, "CAN_RECV_REQ can objl objh idl idh proc pmsg:b -> RLO DR"}, Device::Can},
    {{CanDeleteOrder, "CAN_RECV_DEL handle -> RLO"}, Device::Can},
    {{CanEndOrder, "CAN_RECV_END handle -> RLO"}, Device::Can},
    {{CanReadItem, "CAN_SYSIO_READ can group board item -> RLO DR"}, Device::Can, {.refused = {1}}},
    {{CanWriteItem, "CAN_SYSIO_WRITE can group board item val -> RLO"}, Device::Can, {.refused = {1}}},
    {{CanDrive, "CAN_AX_SEND axis data:b -> data:b"}, Device::Can, {.lasts = true}},
    {{AnalogPort, "ANALOG_PORT port"}, Device::Axes},
    {{Analog, "ANALOG val port -> port out:f"}, Device::Axes},
    {{AnalogOfAxis, "ANALOG val axis spi -> port out:f"}, Device::Axes},
    {{AnalogSpindle, "ANALOG_SPI val axis -> port out:f"}, Device::Axes},
    {{ToSpindle, "AX_SPI axis spi -> port out:f"}, Device::Axes},
    {{MainSpindle, "SPI_MAIN axis"}, Device::Axes},
    {{ToAxis, "SPI_AX feed1 feed2 angle accel axis -> done"}, Device::Axes, {.lasts = true}},
    {{RegulatorX, "REGUL_X set"}, Device::Axes},
    {{RegulatorY, "REGUL_Y set"}, Device::Axes},
    {{RegulatorZ, "REGUL_Z set"}, Device::Axes},
    {{Regulator4, "REGUL_4 set"}, Device::Axes},
    {{Regulator5, "REGUL_5 set"}, Device::Axes},
    {{Regulator6, "REGUL_6 set"}, Device::Axes},
    {{PositionInit, "POS_INIT axis space"}, Device::Axes},
    {{PositionReset, "POS_RESET axis"}, Device::Axes},
    // Bits of the control record; kNotGiven leaves it unchanged (man. l.12101-12133).
    {{PositionMode, "POS_MODE len accel axis -> control"}, Device::Axes, {.unanswered = {4}, .refused = {kNotGiven}}},
    // The two bytes of the record as a word; refused, bit ERR (man. l.12093).
    {{PositionControl, "POS_CONTROL feed mp axis -> status control"},
     Device::Axes,
     {.unanswered = {kNotGiven, kNotGiven}, .refused = {0x0400, kNotGiven}}},
    {{AreaRead, "SA_READ SAIdx Offset Size -> RLO DR Val:b"}, Device::Areas, kOfArea},
    {{AreaWrite, "SA_WRITE SAIdx Offset Size Val:b -> RLO DR"}, Device::Areas, kOfArea},
    {{TableGetInt, "PLCT_GET_INT TabIdx Line Col -> DR Val"}, Device::Tables, kPolled},
    {{TableGetReal, "PLCT_GET_REAL TabIdx Line Col -> DR Val:f"}, Device::Tables, kPolled},
    {{TableGetText, "PLCT_GET_STR TabIdx Line Col -> DR Val:s"}, Device::Tables, kPolled},
    {{TableGetBinary, "PLCT_GET_BIN TabIdx Line Col -> DR Val:b"}, Device::Tables, kPolled},
    {{TableSetInt, "PLCT_SET_INT TabIdx Line Col Val -> DR"}, Device::Tables, kPolled},
    {{TableSetReal, "PLCT_SET_REAL TabIdx Line Col Val:f -> DR"}, Device::Tables, kPolled},
    {{TableSetText, "PLCT_SET_STR TabIdx Line Col Val:s -> DR"}, Device::Tables, kPolled},
    {{TableSetBinary, "PLCT_SET_BIN TabIdx Line Col Val:b -> DR"}, Device::Tables, kPolled},
    {{TableColumnIndex, "PLCT_COL_INDEX TabIdx ID:s -> DR Val"}, Device::Tables, kPolled},
    {{TableColumnId, "PLCT_COL_ID TabIdx Poin -> DR Poin:s"}, Device::Tables, kPolled},
    {{TableColumnType, "PLCT_COL_TYPE TabIdx Col -> DR Val"}, Device::Tables, kPolled},
    {{TableSelectedLine, "PLCT_GET_SELLINE TabIdx -> DR Val"}, Device::Tables, kPolled},
    {{TableSelect, "PLCT_SET_SELLINE TabIdx Val -> DR"}, Device::Tables, kPolled},
    {{TableChanged, "PLCT_CHANGED TabIdx -> DR Val"}, Device::Tables, kPolled},
    {{TableLineCount, "PLCT_GET_LINESCOUNT TabIdx -> DR Val"}, Device::Tables, kPolled},
    {{EthercatReadObject, "ECAT_COE_READ Master Slave Index Subindex Len -> DR Len Val:b"}, Device::Ethercat, kPolled},
    {{EthercatWriteObject, "ECAT_COE_WRITE Master Slave Index Subindex Val:b Len -> DR Len"},
     Device::Ethercat,
     kPolled},
    {{EthercatReadIdn, "ECAT_SOE_READ Master Slave DrNo ElemFl IDN Len -> DR Len Val:b ElemFl"},
     Device::Ethercat,
     kPolled},
    {{EthercatWriteIdn, "ECAT_SOE_WRITE Master Slave DrNo ElemFl IDN Val:b Len -> DR Len ElemFl"},
     Device::Ethercat,
     kPolled},
    {{EthercatCommand, "ECAT_COMMAND Master Slave Cmd -> DR Len Val:b"}, Device::Ethercat, kPolled},
    {{ComSend, "COM_SEND com val -> RLO"}, Device::Com, {.refused = {1}}},
    {{ComSendText, "COM_SEND_STR com poin:b len -> RLO"}, Device::Com, {.refused = {1}}},
    {{ComReceive, "COM_RECV com -> RLO DR"}, Device::Com, {.unanswered = {1}, .refused = {1}}},
    {{ComControl, "COM_CONTROL com mode -> RLO DR"}, Device::Com, {.refused = {1, 2}}},
};
static_assert(isServiceTable(kServices, &DeviceService::service));

} // namespace

std::span<const DeviceService> deviceServices() { return kServices; }

std::optional<int64_t> deviceWord(std::string_view word) {
  const auto numberIn = [&](std::string_view words, int64_t number) -> std::optional<int64_t> {
    for (; !words.empty(); ++number) {
      const size_t end = std::min(words.find(' '), words.size());
      if (text::equalsIgnoringCase(word, words.substr(0, end))) return number;
      words.remove_prefix(std::min(end + 1, words.size()));
    }
    return std::nullopt;
  };
  const auto found = numberIn(kLineCommandWords, kFirstLineCommand);
  return found ? found : numberIn(kSpindleWords, kFirstSpindleWord);
}

const DeviceService* findDeviceService(std::string_view mnemonic) {
  const auto* found =
      std::ranges::find(kServices, mnemonic, [](const DeviceService& device) { return device.service.name; });
  return found == std::end(kServices) ? nullptr : found;
}

} // namespace rung::nc::technol
