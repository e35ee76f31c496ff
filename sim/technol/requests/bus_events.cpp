// What a scenario does to the CAN bus, the serial ports and EtherCAT, and what has left them (see simulated_devices.h;
// inventory of the services, 15.2 to 15.4).
#include <algorithm>

#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/hex.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "sim/hex_bytes.h"
#include "sim/technol/requests/event_keys.h"
#include "sim/technol/requests/simulated_devices.h"

namespace rung::sim::technol {
namespace {

constexpr int64_t kMostCode16 = 0xFFFF, kMostCode32 = 0xFFFF'FFFF;
constexpr EventKey kCanKey{"can", 1, io::CanController::kChannels};
constexpr EventKey kPacketKeys[] = {
    required(kCanKey), required({"id", 0, io::kCanIds - 1}), {"rtr"}, textKey("data"), {"len", 0, io::kCanDataBytes}};
constexpr EventKey kUnitKeys[] = {required({"group", 1, io::kUnitGroups}),
                                  required({"board", 1, io::kMostUnits[0]}),
                                  {"error", 0, 0xFF},
                                  {"short0", 0, 0xFF},
                                  {"short1", 0, 0xFF},
                                  {"short2", 0, 0xFF},
                                  {"silent"}};
constexpr EventKey kDriveKeys[] = {required({"drive", 1, io::kMostDrives}),
                                   {"fault", 0, kMostCode16},
                                   {"hold"},
                                   {"mstat", 0, kMostCode16},
                                   {"silent"}};
constexpr EventKey kBusKeys[] = {required(kCanKey), {"off"}};
constexpr EventKey kLineKeys[] = {
    required({"com", 0, ComPorts::kMost - 1}), textKey("text"), textKey("data"), {"error"}};
constexpr EventKey kNetKeys[] = {{"device", 0, EthercatSlaves::kMost - 1},
                                 {"error", 0, kMostCode32},
                                 {"silent"},
                                 {"fault", 0, kMostCode16},
                                 {"link"}};
constexpr EventKey kSentPacketKeys[] = {
    {"id", 0, io::kCanIds - 1}, {"rtr"}, textKey("data"), {"len", 0, io::kCanDataBytes}};
constexpr EventKey kSentBytesKeys[] = {textKey("text"), textKey("data")};

// ---- bytes ---------------------------------------------------------------------------------------------------------

constexpr const char* kBadHex = "data is pairs of hexadecimal digits, as \"02 55\"";
constexpr const char* kBadText = "a text has \\r, \\n, \\t, \\\\ and \\x with two hexadecimal digits";

// \r, \n, \t, \\ and \xNN.
std::optional<std::vector<uint8_t>> bytesOfText(std::string_view utf8) {
  const std::string text = nc::memoryText(utf8);
  std::vector<uint8_t> bytes;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      bytes.push_back(static_cast<uint8_t>(text[i]));
      continue;
    }
    if (++i >= text.size()) return std::nullopt;
    constexpr std::string_view kLetters = "rnt\\", kMeant = "\r\n\t\\";
    if (const size_t at = kLetters.find(text[i]); at != std::string_view::npos) {
      bytes.push_back(static_cast<uint8_t>(kMeant[at]));
      continue;
    }
    const int high = i + 2 < text.size() && text[i] == 'x' ? text::hexDigit(text[i + 1]) : -1;
    const int low = high >= 0 ? text::hexDigit(text[i + 2]) : -1;
    if (low < 0) return std::nullopt;
    bytes.push_back(static_cast<uint8_t>(high * 16 + low));
    i += 2;
  }
  return bytes;
}

// What `data` or `text` says; "" or what is wrong.
std::string readBytes(const EventKeys& keys, std::vector<uint8_t>& bytes) {
  const bool isText = keys.has("text");
  if (isText == keys.has("data")) return isText ? "either text or data" : "text or data is missing";
  auto read = isText ? bytesOfText(keys.text("text")) : bytesOfHex<std::vector<uint8_t>>(keys.text("data"));
  if (!read) return isText ? kBadText : kBadHex;
  bytes = std::move(*read);
  return {};
}

// `len` counts where there is less data, and without it: of a request for data (RTR).
std::string readPacket(const EventKeys& keys, io::CanPacket& packet) {
  const auto bytes = bytesOfHex<std::vector<uint8_t>>(keys.text("data"));
  if (!bytes) return kBadHex;
  if (bytes->size() > io::kCanDataBytes) return "a packet has at most 8 bytes of data";
  packet.id = keys.number<uint16_t>("id").value_or(0);
  packet.remote = keys.number<uint8_t>("rtr").value_or(0);
  packet.length = keys.number<uint8_t>("len").value_or(static_cast<uint8_t>(bytes->size()));
  if (packet.length < bytes->size()) return "data has more bytes than len says";
  std::ranges::copy(*bytes, packet.data);
  return {};
}

std::string textOf(const io::CanPacket& packet) {
  return "id=0x" + text::hexOfNumber(packet.id, 2) + " rtr=" + std::to_string(packet.remote) +
         " len=" + std::to_string(packet.length) + " data=\"" +
         text::hexOf(std::span(packet.data).first(packet.length)) + "\"";
}

// Keys that are not given do not count, nor does the data of a request for data.
bool isAsWanted(const io::CanPacket& sent, const io::CanPacket& wanted, const EventKeys& keys) {
  const bool hasData = keys.has("data") && sent.remote == 0;
  const bool sameLength = sent.length == wanted.length;
  return (!keys.has("id") || sent.id == wanted.id) && (!keys.has("rtr") || sent.remote == wanted.remote) &&
         (!(hasData || keys.has("len")) || sameLength) &&
         (!hasData || std::equal(sent.data, sent.data + sent.length, wanted.data));
}

bool hasAny(const EventKeys& keys, std::span<const EventKey> known) {
  return std::ranges::any_of(known, [&](const EventKey& key) { return !key.isRequired && keys.has(key.name); });
}

} // namespace

// ---- events --------------------------------------------------------------------------------------------------------

std::string SimulatedDevices::canEvent(const EventKeys& keys) {
  io::CanPacket packet;
  if (std::string wrong = readPacket(keys, packet); !wrong.empty()) return wrong;
  const uint32_t channel = *keys.number<uint32_t>("can");
  if (simulated_) return can_.packetEvent(channel, packet);
  can_.scriptedPacket(channel, packet);
  return {};
}

std::string SimulatedDevices::unitEvent(const EventKeys& keys) {
  if (!hasAny(keys, kUnitKeys)) return "it changes nothing: error, short0, short1, short2 or silent is missing";
  CanUnitEvent event{.error = keys.number<uint8_t>("error"), .shorts = {}, .silent = keys.number<bool>("silent")};
  for (size_t i = 0; i < event.shorts.size(); ++i) event.shorts[i] = keys.number<uint8_t>("short" + std::to_string(i));
  return can_.unitEvent(*keys.number<uint32_t>("group"), *keys.number<uint32_t>("board"), event);
}

std::string SimulatedDevices::driveEvent(const EventKeys& keys) {
  if (!hasAny(keys, kDriveKeys)) return "it changes nothing: fault, mstat or silent is missing";
  if (keys.has("hold") && !keys.has("fault")) return "'hold' says how long a fault lasts: 'fault' is missing";
  return can_.driveEvent(*keys.number<uint32_t>("drive"), {.fault = keys.number<uint16_t>("fault"),
                                                           .hold = keys.number<bool>("hold").value_or(false),
                                                           .mstat = keys.number<uint16_t>("mstat"),
                                                           .silent = keys.number<bool>("silent")});
}

std::string SimulatedDevices::busEvent(const EventKeys& keys) {
  return can_.busEvent(*keys.number<uint32_t>("can"), keys.number<bool>("off").value_or(true));
}

std::string SimulatedDevices::lineEvent(const EventKeys& keys) {
  const uint32_t number = *keys.number<uint32_t>("com");
  const auto isWrong = keys.number<bool>("error");
  if (isWrong && (keys.has("text") || keys.has("data"))) return "either error or bytes";
  if (isWrong) return com_.setError(number, *isWrong);
  std::vector<uint8_t> bytes;
  const std::string wrong = readBytes(keys, bytes);
  return wrong.empty() ? com_.receive(number, bytes) : wrong;
}

std::string SimulatedDevices::netEvent(const EventKeys& keys) {
  const auto device = keys.number<uint32_t>("device");
  const auto error = keys.number<uint32_t>("error"), fault = keys.number<uint32_t>("fault");
  const auto link = keys.number<bool>("link"), silent = keys.number<bool>("silent");
  const bool ofDevice = error || fault || silent;
  if (!link && !ofDevice) return "it changes nothing: link, or error, silent or fault of a device is missing";
  if (ofDevice != device.has_value()) return "'device' comes with error, silent and fault, and not with link alone";
  if (link) ethercat_.setLink(*link);
  std::string wrong;
  if (silent) wrong = ethercat_.setSilent(*device, *silent);
  if (fault && wrong.empty()) wrong = ethercat_.fault(*device, *fault);
  if (error && wrong.empty()) wrong = ethercat_.setError(*device, *error);
  return wrong;
}

std::span<const SimulatedDevices::Event> SimulatedDevices::portEvents() {
  static constexpr Event kEvents[] = {
      {"CAN", kPacketKeys, &SimulatedDevices::canEvent, true},  {"CAN_UNIT", kUnitKeys, &SimulatedDevices::unitEvent},
      {"CAN_DRIVE", kDriveKeys, &SimulatedDevices::driveEvent}, {"CAN_BUS", kBusKeys, &SimulatedDevices::busEvent},
      {"COM", kLineKeys, &SimulatedDevices::lineEvent},         {"ethercat", kNetKeys, &SimulatedDevices::netEvent}};
  return kEvents;
}

// ---- what has been sent --------------------------------------------------------------------------------------------

std::string SimulatedDevices::expectSent(std::string_view port, std::span<const NcArgument> keys) {
  std::string_view rest = port;
  const bool com = text::takePrefixIgnoringCase(rest, "COM[");
  if (!com && !text::takePrefixIgnoringCase(rest, "CAN["))
    return "ports are COM[n] and CAN[n], not '" + std::string(port) + "'";
  const bool isClosed = rest.ends_with(']');
  const auto number = text::numberIn<uint32_t>(rest.substr(0, rest.size() - (isClosed ? 1 : 0)));
  const uint32_t count = com ? ComPorts::kMost : io::CanController::kChannels;
  if (!isClosed || !number || *number >= count) return "there is no port '" + std::string(port) + "'";
  const bool none = keys.size() == 1 && text::equalsIgnoringCase(keys[0].key, "none");
  if (keys.empty()) return "what is expected is missing: keys, or none";
  const std::span<const EventKey> known = com ? std::span<const EventKey>(kSentBytesKeys) : kSentPacketKeys;
  if (std::string wrong = none ? "" : wrongKeys(port, keys, known); !wrong.empty()) return wrong;
  return com ? bytesSent(*number, EventKeys(keys), none) : packetSent(*number + 1, EventKeys(keys), none);
}

std::string SimulatedDevices::bytesSent(uint32_t number, const EventKeys& keys, bool none) {
  ComLine& line = com_.line(number);
  if (none) return line.sent() == 0 ? std::string() : std::to_string(line.sent()) + " bytes have been sent";
  std::vector<uint8_t> wanted;
  if (std::string wrong = readBytes(keys, wanted); !wrong.empty()) return wrong;
  if (line.takeSent(wanted)) return {};
  constexpr size_t kMore = 8; // bytes that are shown beyond those that are wanted
  std::vector<uint8_t> found;
  for (uint32_t i = 0; i < line.sent() && i < wanted.size() + kMore; ++i) found.push_back(line.sentByte(i));
  return "sent is " + (found.empty() ? std::string("nothing") : text::hexOf(found));
}

std::string SimulatedDevices::packetSent(uint32_t channel, const EventKeys& keys, bool none) {
  io::CanPacket wanted, sent;
  if (std::string wrong = none ? "" : readPacket(keys, wanted); !wrong.empty()) return wrong;
  const bool any = can_.control().takeSent(channel, sent);
  if (none && any) return "a packet has been sent: " + textOf(sent);
  if (none) return {};
  if (!any) return "no packet has been sent";
  return isAsWanted(sent, wanted, keys) ? std::string() : "the packet that was sent is " + textOf(sent);
}

} // namespace rung::sim::technol
