// The services of devices.
#include "rtlib/nc/technol/services.h"

#include <algorithm>
#include <iterator>

#include "rtlib/text/letters.h"

namespace rung::nc::technol {

namespace {

constexpr bool kWaits = true;
// "There is no such table, area, master" (inventory of the services, 2, 3, 12).
constexpr int64_t kNone = 1;

constexpr DeviceService polled(std::string_view name, std::string_view results) {
  return {.name = name, .results = results, .waits = kWaits, .refused = {kNone}};
}

constexpr DeviceService kServices[] = {
    {.name = "CAN_SEND", .results = "DR", .refused = {1}},
    {.name = "CAN_RECV", .results = "DR id rtr data:b", .unanswered = {2}, .refused = {2}},
    {.name = "CAN_RECV_REQ", .results = "RLO DR"},
    {.name = "CAN_RECV_DEL", .results = "RLO"},
    {.name = "CAN_RECV_END", .results = "RLO"},
    {.name = "CAN_SYSIO_READ", .results = "RLO DR", .refused = {1}},
    {.name = "CAN_SYSIO_WRITE", .results = "RLO", .refused = {1}},
    {.name = "CAN_AX_SEND", .results = "data:b", .lasts = true},
    {.name = "ANALOG_PORT"},
    {.name = "ANALOG", .results = "port out:f"},
    {.name = "SPI_AX", .results = "done", .lasts = true},
    {.name = "AX_SPI", .results = "port out:f"},
    {.name = "SPI_MAIN"},
    {.name = "ANALOG_SPI", .results = "port out:f"},
    {.name = "REGUL_X"},
    {.name = "REGUL_Y"},
    {.name = "REGUL_Z"},
    {.name = "REGUL_4"},
    {.name = "REGUL_5"},
    {.name = "REGUL_6"},
    {.name = "POS_INIT"},
    {.name = "POS_RESET"},
    // Bits of the control record; not given: it stays (man. l.12101-12133).
    {.name = "POS_MODE", .results = "control", .unanswered = {4}, .refused = {kNotGiven}},
    // The two bytes of the record as a word; refused, bit ERR (man. l.12093).
    {.name = "POS_CONTROL",
     .results = "status control",
     .unanswered = {kNotGiven, kNotGiven},
     .refused = {0x0400, kNotGiven}},
    {.name = "SA_READ", .results = "RLO DR Val:b", .waits = kWaits, .refused = {0, kNone}},
    {.name = "SA_WRITE", .results = "RLO DR", .waits = kWaits, .refused = {0, kNone}},
    polled("PLCT_GET_INT", "DR Val"),
    polled("PLCT_GET_REAL", "DR Val:f"),
    polled("PLCT_GET_STR", "DR Val:s"),
    polled("PLCT_GET_BIN", "DR Val:b"),
    polled("PLCT_SET_INT", "DR"),
    polled("PLCT_SET_REAL", "DR"),
    polled("PLCT_SET_STR", "DR"),
    polled("PLCT_SET_BIN", "DR"),
    polled("PLCT_COL_INDEX", "DR Val"),
    polled("PLCT_COL_ID", "DR Poin:s"),
    polled("PLCT_COL_TYPE", "DR Val"),
    polled("PLCT_GET_SELLINE", "DR Val"),
    polled("PLCT_SET_SELLINE", "DR"),
    polled("PLCT_CHANGED", "DR Val"),
    polled("PLCT_GET_LINESCOUNT", "DR Val"),
    polled("ECAT_COE_READ", "DR Len Val:b"),
    polled("ECAT_COE_WRITE", "DR Len"),
    polled("ECAT_SOE_READ", "DR Len Val:b ElemFl"),
    polled("ECAT_SOE_WRITE", "DR Len ElemFl"),
    polled("ECAT_COMMAND", "DR Len Val:b"),
    {.name = "COM_SEND", .results = "RLO", .refused = {1}},
    {.name = "COM_SEND_STR", .results = "RLO", .refused = {1}},
    {.name = "COM_RECV", .results = "RLO DR", .unanswered = {1}, .refused = {1}},
    {.name = "COM_CONTROL", .results = "RLO DR", .refused = {1, 2}},
};

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

const DeviceService* findDeviceService(std::string_view signature) {
  const std::string_view name = signature.substr(0, signature.find(' '));
  const auto* found = std::ranges::find(kServices, name, &DeviceService::name);
  return found == std::end(kServices) ? nullptr : found;
}

} // namespace rung::nc::technol
