// Events and quantities of the devices in scenarios (see simulated_devices.h; inventory of the services, 15).
#include "sim/technol/requests/device_events.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "machine/io/device_call.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/hex.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "sim/hex_bytes.h"
#include "sim/technol/requests/simulated_devices.h"

namespace rung::sim::technol {

namespace {

constexpr std::string_view kKey = "KEY";
constexpr EventKey kAreaKeys[] = {required({"area", 0, io::SharedAreas::kAreas - 1}), {"on"}};
constexpr EventKey kTableKeys[] = {
    required({"table", 0, io::PlcTables::kTables - 1}), {"add"}, {"remove", 0, io::PlcTables::kMostLines - 1}};
constexpr EventKey kStopKeys[] = {{"emergency"}};
constexpr EventKey kReferenceKeys[] = {{"axis", 1, kMaxAxes}, {"axes", 0, (1u << kMaxAxes) - 1}, textKey("type")};
constexpr EventKey kManualKeys[] = {{"on"}};
constexpr EventKey kCommandKeys[] = {required(textKey("command")), {"state"}};
constexpr EventKey kHandwheelKeys[] = {required({"pulses", INT32_MIN, INT32_MAX}), {"wheel", 1, 2}};

// Takes the number and the dot from the beginning of "2.0x6041.0"; UINT32_MAX if there is no number.
uint32_t takePart(std::string_view& rest) {
  return text::wholeIn<uint32_t>(io::takeUntil(rest, '.')).value_or(UINT32_MAX);
}

} // namespace

// ---- events --------------------------------------------------------------------------------------------------------

std::string SimulatedDevices::areaEvent(const EventKeys& keys) {
  const bool held = areas_.hold(*keys.number<uint32_t>("area"), keys.number<bool>("on").value_or(true));
  return held ? "" : "there is no such shared area";
}

std::string SimulatedDevices::tableEvent(const EventKeys& keys) {
  const auto table = *keys.number<uint32_t>("table");
  const auto removed = keys.number<uint32_t>("remove");
  const bool adds = keys.number<bool>("add").value_or(false);
  if (adds == removed.has_value()) return "either add=1, or remove with the number of a line, as in table=0 remove=2";
  return adds ? tables_.addLine(table) : tables_.removeLine(table, *removed);
}

std::string SimulatedDevices::stopEvent(const EventKeys& keys) {
  axes_.stop(keys.number<bool>("emergency").value_or(false));
  return {};
}

std::string SimulatedDevices::referenceEvent(const EventKeys& keys) {
  const auto axis = keys.number<uint32_t>("axis");
  const AxisMask axes = axis ? bitOf(*axis - 1) : keys.number<AxisMask>("axes").value_or(0);
  return axes_.reference(keys.text("type"), axes);
}

std::string SimulatedDevices::manualEvent(const EventKeys& keys) {
  axes_.autman(keys.number<bool>("on").value_or(true));
  return {};
}

std::string SimulatedDevices::commandEvent(const EventKeys& keys) {
  return axes_.rtm(keys.text("command"), keys.number<bool>("state").value_or(true));
}

// Both wheels move the selected axis, unless they are disabled.
std::string SimulatedDevices::handwheelEvent(const EventKeys& keys) {
  axes_.handwheel(*keys.number<int64_t>("pulses"), keys.number<uint32_t>("wheel").value_or(1));
  return {};
}

std::span<const SimulatedDevices::Event> SimulatedDevices::deviceEvents() {
  static constexpr Event kEvents[] = {{"SA_LOCK", kAreaKeys, &SimulatedDevices::areaEvent, true},
                                      {"PLCT", kTableKeys, &SimulatedDevices::tableEvent, true},
                                      {"STOP", kStopKeys, &SimulatedDevices::stopEvent},
                                      {"REFERENCE", kReferenceKeys, &SimulatedDevices::referenceEvent},
                                      {"AUTMAN", kManualKeys, &SimulatedDevices::manualEvent},
                                      {"RTM", kCommandKeys, &SimulatedDevices::commandEvent},
                                      {"handwheel", kHandwheelKeys, &SimulatedDevices::handwheelEvent}};
  return kEvents;
}

std::vector<std::string_view> SimulatedDevices::events() const {
  std::vector<std::string_view> names{kKey};
  for (const std::span<const Event> events : {deviceEvents(), portEvents()})
    for (const Event& event : events) names.push_back(event.name);
  return names;
}

std::optional<std::string> SimulatedDevices::event(runtime::Instance& instance, std::string_view name,
                                                   std::span<const NcArgument> given) {
  if (simulated_ && text::equalsIgnoringCase(name, kKey)) return keyEvent(instance, given);
  if (const auto done = oneOf(deviceEvents(), name, given)) return done;
  return oneOf(portEvents(), name, given);
}

std::optional<std::string> SimulatedDevices::oneOf(std::span<const Event> events, std::string_view name,
                                                   std::span<const NcArgument> given) {
  const auto event =
      std::ranges::find_if(events, [&](const Event& known) { return text::equalsIgnoringCase(known.name, name); });
  if (event == events.end()) return std::nullopt;
  if (!simulated_ && !event->isScripted)
    return std::string(event->name) + " is of simulated devices: `config nc simulated` is missing";
  if (std::string wrong = wrongKeys(event->name, given, event->keys); !wrong.empty()) return wrong;
  const std::string wrong = (this->*event->act)(EventKeys(given));
  return wrong.empty() ? wrong : std::string(event->name) + ": " + wrong;
}

// ---- quantities ----------------------------------------------------------------------------------------------------

std::optional<double> SimulatedDevices::quantity(std::string_view name) const {
  if (!simulated_) return std::nullopt;
  if (text::equalsIgnoringCase(name, "MAINSPINDLE")) return axes_.mainSpindle();
  if (text::equalsIgnoringCase(name, "ECSTATE")) return static_cast<double>(ethercat_.state());
  const auto ofAxis = [&](std::string_view prefix, auto value) -> std::optional<double> {
    std::string_view rest = name;
    if (!text::takePrefixIgnoringCase(rest, prefix)) return std::nullopt;
    const uint32_t axis = takePart(rest);
    return axes_.exists(axis) && rest.empty() ? std::optional<double>(value(axis)) : std::nullopt;
  };
  if (auto v = ofAxis("MPOS.", [&](uint32_t axis) { return axes_.measured(axis); })) return v;
  if (auto v = ofAxis("TRUE.", [&](uint32_t axis) { return axes_.physical(axis); })) return v;
  if (auto v = ofAxis("SPEED.", [&](uint32_t axis) { return axes_.speedPerMinute(axis); })) return v;
  if (auto v = ofAxis("SPINDLE.", [&](uint32_t axis) { return axes_.spindleRole(axis); })) return v;
  if (auto v = ofAxis("REGUL.", [&](uint32_t axis) { return axes_.regulator(axis); })) return v;
  std::string_view rest = name;
  const auto asReal = [](auto value) { return value ? std::optional(static_cast<double>(*value)) : std::nullopt; };
  if (text::takePrefixIgnoringCase(rest, "ECSTATE.")) return asReal(ethercat_.slaveState(takePart(rest)));
  const auto three = [&](auto act) {
    const uint32_t a = takePart(rest), b = takePart(rest), c = takePart(rest);
    return act(a, b, c);
  };
  if (text::takePrefixIgnoringCase(rest, "DRIVE."))
    return asReal(three([&](auto a, auto b, auto c) { return can_.driveObject(a, b, c); }));
  if (text::takePrefixIgnoringCase(rest, "ETHERCAT."))
    return asReal(three([&](auto a, auto b, auto c) { return ethercat_.object(a, b, c); }));
  if (text::takePrefixIgnoringCase(rest, "IDN."))
    return asReal(three([&](auto a, auto b, auto c) { return ethercat_.idn(a, b, c); }));
  return std::nullopt;
}

std::optional<std::string> SimulatedDevices::setQuantity(std::string_view name, double value) {
  if (!simulated_) return std::nullopt;
  std::string_view rest = name;
  const bool measured = text::takePrefixIgnoringCase(rest, "MPOS.");
  if (measured || text::takePrefixIgnoringCase(rest, "TRUE.")) {
    const uint32_t axis = takePart(rest);
    if (!axes_.exists(axis)) return "there is no axis of this number";
    if (!(std::fabs(value) <= kFarthest)) return "a place is a number of -1e9 to 1e9";
    measured ? axes_.setMeasured(axis, value) : axes_.setPhysical(axis, value);
    return std::string();
  }
  const bool object = text::takePrefixIgnoringCase(rest, "ETHERCAT.");
  if (!object && !text::takePrefixIgnoringCase(rest, "IDN.")) {
    if (!quantity(name)) return std::nullopt;
    return "it is what a device does; set are NC.MPOS, NC.TRUE, NC.ETHERCAT and NC.IDN";
  }
  const uint32_t a = takePart(rest), b = takePart(rest), c = takePart(rest);
  const auto bits = static_cast<uint64_t>(static_cast<int64_t>(std::llround(value)));
  const bool done = object ? ethercat_.setObject(a, b, c, bits) : ethercat_.setIdn(a, b, c, bits);
  return std::string(done ? "" : "there is no such object");
}

// Events of the CAN bus, the serial ports and EtherCAT in scenarios, and the data that they have sent (see
// simulated_devices.h; inventory of the services, 15.2 to 15.4).

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

// The bytes of a text with the escapes \r, \n, \t, \\ and \xNN.
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

// Reads the bytes of `data` or `text`. Returns "", or the error.
std::string readBytes(const EventKeys& keys, std::vector<uint8_t>& bytes) {
  const bool isText = keys.has("text");
  if (isText == keys.has("data")) return isText ? "either text or data" : "text or data is missing";
  auto read = isText ? bytesOfText(keys.text("text")) : bytesOfHex<std::vector<uint8_t>>(keys.text("data"));
  if (!read) return isText ? kBadText : kBadHex;
  bytes = std::move(*read);
  return {};
}

// `len` may exceed the data given; a request for data (RTR) has a length but no data.
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

// Compares the given keys only, and not the data of a request for data.
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

// ---- sent data ------------------------------------------------------------------------------------------------------

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
  constexpr size_t kMore = 8; // bytes that are shown beyond the expected ones
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

// Keys, which are pressed and released by an event or by a bit that is connected to the virtual keyboard (see
// simulated_devices.h; man. ch. 11, l.12493-12503).

namespace {

constexpr EventKey kKeys[] = {required({"keyboard", 0, Keyboards::kKeyboards - 1}),
                              required({"scan", 0, Keyboards::kKeys - 1}), required({"state"})};

} // namespace

std::string SimulatedDevices::keyEvent(runtime::Instance& instance, std::span<const NcArgument> given) {
  if (std::string wrong = wrongKeys("KEY", given, kKeys); !wrong.empty()) return wrong;
  const EventKeys keys(given);
  const uint32_t keyboard = *keys.number<uint32_t>("keyboard");
  const std::string number = std::to_string(keyboard);
  if (!keyboards_.exists(keyboard))
    return "keyboard " + number + " has no keys; `config KbdConfig" + number + " FILE` gives it some";
  pressKey(instance, keyboard, *keys.number<uint32_t>("scan"), *keys.number<uint32_t>("state") != 0);
  return {};
}

void SimulatedDevices::pressKey(runtime::Instance& instance, uint32_t keyboard, uint32_t scan, bool pressed) {
  const KeyActions actions = keyboards_.key(keyboard, scan, pressed);
  keyboardPlaces_.write(instance.memory(), keyboards_);
  axes_.key(actions.rtmCommand, pressed);
  if (actions.plcCommand) keyboardPlaces_.runCommand(instance, *actions.plcCommand, pressed);
}

void SimulatedDevices::takeVirtualKeys(runtime::Instance& instance, const ModuleCells& cells) {
  for (const ModuleCells::PointCell& point : cells.points()) {
    if (point.point.kind != ModulePoint::Kind::Key) continue;
    const bool pressed = cells.at(point.cell).bits != 0;
    if (pressed != keyboards_.isPressed(Keyboards::kVirtual, point.point.number))
      pressKey(instance, Keyboards::kVirtual, point.point.number, pressed);
  }
}

// Keys of events.

namespace {

std::string namesOf(std::span<const EventKey> known) {
  std::string names;
  for (const EventKey& key : known) names.append(names.empty() ? "" : " ").append(key.name);
  return names;
}

// A number as written in scenarios: identifiers and error codes in hexadecimal.
std::string shown(int64_t number) {
  constexpr int64_t kLastDecimal = 0xFF;
  if (number <= kLastDecimal) return std::to_string(number);
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (int64_t left = number; left != 0; left /= 16) text.insert(text.begin(), kDigits[left % 16]);
  return "0x" + text;
}

std::string wrongValue(const NcArgument& given, const EventKey& known) {
  const std::string name = "'" + std::string(known.name) + "' takes ";
  if (known.isText) return given.isText ? "" : name + "a text in quotes";
  const bool fits = !given.isText && !given.isReal && given.integer >= known.least && given.integer <= known.most;
  return fits ? "" : name + shown(known.least) + " to " + shown(known.most);
}

} // namespace

std::string wrongKeys(std::string_view event, std::span<const NcArgument> keys, std::span<const EventKey> known) {
  const std::string before = std::string(event) + ": ";
  for (const NcArgument& given : keys) {
    const auto found =
        std::ranges::find_if(known, [&](const EventKey& key) { return text::equalsIgnoringCase(key.name, given.key); });
    if (found == known.end()) return std::string(event) + " has no '" + given.key + "': it has " + namesOf(known);
    if (std::string wrong = wrongValue(given, *found); !wrong.empty()) return before + wrong;
    if (std::ranges::count_if(keys,
                              [&](const NcArgument& key) { return text::equalsIgnoringCase(key.key, given.key); }) > 1)
      return before + "'" + std::string(found->name) + "' is given twice";
  }
  for (const EventKey& key : known)
    if (key.isRequired && !EventKeys(keys).has(key.name)) return before + "'" + std::string(key.name) + "' is missing";
  return {};
}

} // namespace rung::sim::technol
