// See mapping_connections.h.
#include "machine/host/mapping_connections.h"

#include <arpa/inet.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "rtlib/text/similar.h"

namespace rung::host {
namespace {

constexpr double kShortestTime = 0.001; // seconds
constexpr double kLongestTime = 3600;
constexpr int64_t kMostPlaces = 65536; // in one Modbus area
constexpr int64_t kMostMemory = 65536; // bytes in each direction
constexpr int64_t kLastUnit = 247;
constexpr int64_t kNoUnit = 255; // addresses the Modbus TCP device itself
constexpr int64_t kMostConnections = 64;
constexpr int64_t kMostRequests = 100'000;
constexpr size_t kLongestName = 64;

constexpr std::string_view kAreaNames[] = {"coils", "discrete-inputs", "holding-registers", "input-registers",
                                           "pins"};                                  // indexed by Area
constexpr std::string_view kFormatNames[] = {"", "s16", "u16", "s32", "u32", "f32"}; // indexed by Format, for registers

std::string_view areaName(Area area) { return kAreaNames[static_cast<size_t>(area)]; }
bool isRegister(Area area) { return area == Area::HoldingRegister || area == Area::InputRegister; }
// Whether a Modbus client can write the area.
bool isWritable(Area area) { return area == Area::Coil || area == Area::HoldingRegister; }

bool isAddress(const std::string& text) {
  in6_addr room{};
  return inet_pton(AF_INET, text.c_str(), &room) == 1 || inet_pton(AF_INET6, text.c_str(), &room) == 1;
}

std::optional<int64_t> integerIn(const toml::node& node, int64_t least, int64_t most) {
  const auto number = node.value_exact<int64_t>();
  return number && *number >= least && *number <= most ? number : std::nullopt;
}

std::optional<int64_t> nanosecondsOf(const toml::node& node) {
  const std::optional<double> seconds = text::numberOf(node);
  if (!seconds || !(*seconds >= kShortestTime && *seconds <= kLongestTime)) return std::nullopt;
  return static_cast<int64_t>(*seconds * 1e9);
}

// The default format.
Format usualFormat(Area area, PinType type) {
  const bool isMemory = area == Area::Memory;
  switch (type) {
  case PinType::Bit: return Format::Bit;
  case PinType::S32: return isMemory ? Format::S32 : Format::S16;
  case PinType::U32: return isMemory ? Format::U32 : Format::U16;
  case PinType::Float: return isMemory ? Format::F64 : Format::S16;
  }
  return Format::Bit;
}

// Number of addresses that a value occupies.
uint32_t lengthOf(const ConnectedPin& pin) {
  if (pin.area == Area::Memory) return bytesOf(pin.format);
  return isRegister(pin.area) ? registersOf(pin.format) : 1;
}

} // namespace

// ---- the text ------------------------------------------------------------------------------------------------------

const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kHost = {
    "host", false, "an IP address, because a name would have to be looked up while the program runs",
    "host = \"127.0.0.1\"", &ConnectionReader::takeHost};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kPort = {
    "port", false, "the number of a port, 1 to 65535", "port = 502", &ConnectionReader::takePort};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kPeriod = {
    "period", false, "seconds, 0.001 to 3600", "period = 0.01", &ConnectionReader::takePeriod};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kTimeout = {
    "timeout", false, "seconds, 0.001 to 3600", "timeout = 0.5", &ConnectionReader::takeTimeout};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kStatus = {
    "status", false, "the name of a pin", "status = \"panel-ok\"", &ConnectionReader::takeStatus};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kCoils = {
    "coils", false, "a table", "coils = { start = 0 }", &ConnectionReader::takeCoils};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kDiscreteInputs = {
    "discrete-inputs", false, "a table", "discrete-inputs = { lamp = 0 }", &ConnectionReader::takeDiscreteInputs};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kHoldingRegisters = {
    "holding-registers", false, "a table", "holding-registers = { speed = 0 }",
    &ConnectionReader::takeHoldingRegisters};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kInputRegisters = {
    "input-registers", false, "a table", "input-registers = { load = 0 }", &ConnectionReader::takeInputRegisters};

const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kClientKeys[] = {
    {"host", true, kHost.expected, "host = \"192.168.0.10\"", &ConnectionReader::takeHost},
    kPort,
    {"unit", false, "the number of a unit, 0 to 247, or 255", "unit = 1", &ConnectionReader::takeUnit},
    kPeriod,
    kTimeout,
    kStatus,
    kCoils,
    kDiscreteInputs,
    kHoldingRegisters,
    kInputRegisters,
};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kServerKeys[] = {
    kHost,
    kPort,
    kTimeout,
    {"connections", false, "how many clients are served at a time, 1 to 64", "connections = 8",
     &ConnectionReader::takeConnections},
    {"requests", false, "how many requests of a client are answered in a second, 1 to 100000", "requests = 1000",
     &ConnectionReader::takeRequests},
    kStatus,
    kCoils,
    kDiscreteInputs,
    kHoldingRegisters,
    kInputRegisters,
};
const ConnectionReader::Key<ConnectionReader::Row> ConnectionReader::kMemoryKeys[] = {
    {"name", true, "a name of letters, digits, '-', '_' and '.', at most 64", "name = \"mill\"",
     &ConnectionReader::takeName},
    kPeriod,
    kTimeout,
    kStatus,
    {"pins", false, "a table", "pins = { start = 0 }", &ConnectionReader::takeMemory},
};

const ConnectionReader::Key<ConnectionReader::PinRow> ConnectionReader::kAt = {"at", true, "a number from 0 to 65535",
                                                                               "at = 10", &ConnectionReader::takeAt};
const ConnectionReader::Key<ConnectionReader::PinRow> ConnectionReader::kSafe = {
    "safe", false, "true, false, a number or \"hold\"", "safe = true", &ConnectionReader::takeSafe};
const ConnectionReader::Key<ConnectionReader::PinRow> ConnectionReader::kBitKeys[] = {kAt, kSafe};
const ConnectionReader::Key<ConnectionReader::PinRow> ConnectionReader::kRegisterKeys[] = {
    kAt,
    {"format", false, "\"s16\", \"u16\", \"s32\", \"u32\" or \"f32\"", "format = \"s32\"",
     &ConnectionReader::takeFormat},
    {"order", false, "\"high-first\" or \"low-first\"", "order = \"high-first\"", &ConnectionReader::takeOrder},
    kSafe,
};

bool ConnectionReader::read(const toml::node& node, Connection::Kind kind) {
  if (const toml::table* table = node.as_table()) {
    readTable(*table, kind);
    return true;
  }
  const toml::array* list = node.as_array();
  if (list == nullptr || !std::ranges::all_of(*list, &toml::node::is_table)) return false;
  for (const toml::node& element : *list) readTable(*element.as_table(), kind);
  return true;
}

void ConnectionReader::readTable(const toml::table& table, Connection::Kind kind) {
  Row row;
  row.connection.kind = kind;
  row.connection.at = row.timeoutAt = reading_.positionOf(table);
  const std::string_view name = kindName(kind);
  bool good = false;
  switch (kind) {
  case Connection::Kind::ModbusClient: good = reading_.readKeys(*this, table, name, kClientKeys, row); break;
  case Connection::Kind::ModbusServer: good = reading_.readKeys(*this, table, name, kServerKeys, row); break;
  case Connection::Kind::SharedMemory: good = reading_.readKeys(*this, table, name, kMemoryKeys, row); break;
  }
  const Connection& made = row.connection;
  if (good && kind != Connection::Kind::ModbusServer && made.timeoutNs <= made.periodNs)
    reading_.fail(row.timeoutAt, std::string(name) + ".timeout: found no more than the period, expected a longer time; "
                                                     "write for example twice the period");
  rows_.push_back(std::move(row));
}

bool ConnectionReader::takeHost(const toml::node& node, Row& row) {
  row.connection.host = text::stringOf(node);
  return isAddress(row.connection.host);
}

bool ConnectionReader::takePort(const toml::node& node, Row& row) {
  const std::optional<int64_t> port = integerIn(node, 1, 65535);
  row.connection.port = static_cast<uint16_t>(port.value_or(0));
  return port.has_value();
}

bool ConnectionReader::takeUnit(const toml::node& node, Row& row) {
  std::optional<int64_t> unit = integerIn(node, 0, 255);
  if (unit > kLastUnit && unit != kNoUnit) unit.reset();
  row.connection.unit = static_cast<uint8_t>(unit.value_or(0));
  return unit.has_value();
}

bool ConnectionReader::takeName(const toml::node& node, Row& row) {
  row.connection.name = text::stringOf(node);
  return isPinName(row.connection.name) && row.connection.name.size() <= kLongestName;
}

bool ConnectionReader::takePeriod(const toml::node& node, Row& row) {
  const std::optional<int64_t> time = nanosecondsOf(node);
  row.connection.periodNs = time.value_or(row.connection.periodNs);
  return time.has_value();
}

bool ConnectionReader::takeTimeout(const toml::node& node, Row& row) {
  const std::optional<int64_t> time = nanosecondsOf(node);
  row.connection.timeoutNs = time.value_or(row.connection.timeoutNs);
  row.timeoutAt = reading_.positionOf(node);
  return time.has_value();
}

bool ConnectionReader::takeConnections(const toml::node& node, Row& row) {
  const std::optional<int64_t> count = integerIn(node, 1, kMostConnections);
  row.connection.connections = static_cast<uint32_t>(count.value_or(row.connection.connections));
  return count.has_value();
}

bool ConnectionReader::takeRequests(const toml::node& node, Row& row) {
  const std::optional<int64_t> count = integerIn(node, 1, kMostRequests);
  row.connection.requests = static_cast<uint32_t>(count.value_or(row.connection.requests));
  return count.has_value();
}

bool ConnectionReader::takeStatus(const toml::node& node, Row& row) {
  if (!isPinName(text::stringOf(node))) return false;
  row.status = Place{text::stringOf(node), reading_.positionOf(node)};
  return true;
}

bool ConnectionReader::takePins(const toml::node& node, Area area, Row& row) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  for (const auto& [key, value] : text::inFileOrder(*table)) {
    PinRow pin{.pin = {std::string(key->str()), reading_.positionOf(key->source())}, .area = area};
    const std::string where =
        std::string(kindName(row.connection.kind)) + "." + std::string(areaName(area)) + "." + pin.pin.text;
    if (readPin(*value, where, pin)) row.pins.push_back(std::move(pin));
  }
  return true;
}

// PIN = 5, or PIN = { at = 5 }.
bool ConnectionReader::readPin(const toml::node& node, const std::string& where, PinRow& pin) {
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    if (takeAt(node, pin)) return true;
    reading_.wrong(node, where, "a number from 0 to 65535, or a table", pin.pin.text + " = 10");
    return false;
  }
  return isRegister(pin.area) ? reading_.readKeys(*this, *table, where, kRegisterKeys, pin)
                              : reading_.readKeys(*this, *table, where, kBitKeys, pin);
}

bool ConnectionReader::takeAt(const toml::node& node, PinRow& pin) {
  const std::optional<int64_t> place = integerIn(node, 0, kMostPlaces - 1);
  pin.place = static_cast<uint32_t>(place.value_or(0));
  pin.placeAt = reading_.positionOf(node);
  return place.has_value();
}

bool ConnectionReader::takeFormat(const toml::node& node, PinRow& pin) {
  const auto* const found = std::ranges::find(kFormatNames, text::stringOf(node));
  pin.formatAt = reading_.positionOf(node);
  if (found == std::end(kFormatNames) || found->empty()) return false;
  pin.format = static_cast<Format>(found - std::begin(kFormatNames));
  return true;
}

bool ConnectionReader::takeOrder(const toml::node& node, PinRow& pin) {
  const std::string order = text::stringOf(node);
  pin.lowFirst = order == "low-first";
  pin.orderAt = reading_.positionOf(node);
  return *pin.lowFirst || order == "high-first";
}

bool ConnectionReader::takeSafe(const toml::node& node, PinRow& pin) {
  pin.safeAt = reading_.positionOf(node);
  pin.holds = text::stringOf(node) == "hold";
  if (!pin.holds) pin.safe = reading_.numberWithType(node);
  return pin.holds || pin.safe;
}

// ---- with the pins -------------------------------------------------------------------------------------------------

void ConnectionReader::resolve() {
  sources_.resize(reading_.map().pins.size());
  for (Row& row : rows_) {
    reading_.setFile(row.connection.at.file);
    resolve(row);
  }
  rows_.clear();
}

void ConnectionReader::resolve(Row& row) {
  if (row.status) resolveStatus(*row.status, row.connection);
  for (const PinRow& pin : row.pins) resolvePin(pin, row.connection);
  reading_.map().connections.push_back(std::move(row.connection));
}

void ConnectionReader::resolveStatus(const Place& status, Connection& connection) {
  const std::string where = std::string(kindName(connection.kind)) + ".status";
  const std::optional<uint32_t> pin = find(status, where);
  if (!pin) return;
  const Pin& found = reading_.map().pins[*pin];
  if (found.direction != Direction::In || found.type != PinType::Bit)
    reading_.fail(status.at, where + ": found pin " + found.name + " of type " + std::string(pinTypeName(found.type)) +
                                 " in [" + std::string(tableName(found.direction)) +
                                 "], expected a bit in [in]; write such a pin for it");
  else if (reserve(*pin, status.at, where))
    connection.statusPin = pin;
}

void ConnectionReader::resolvePin(const PinRow& row, Connection& connection) {
  const std::string where =
      std::string(kindName(connection.kind)) + "." + std::string(areaName(row.area)) + "." + row.pin.text;
  const std::optional<uint32_t> index = find(row.pin, where);
  if (!index) return;
  const Pin& pin = reading_.map().pins[*index];
  if (!checkDirection(row, connection, pin, where)) return;
  const std::optional<Format> format = formatFor(row, pin, where);
  if (!format || !checkOrder(row, *format, where) || !checkSafe(row, pin, where)) return;
  const ConnectedPin made{.pin = *index,
                          .area = row.area,
                          .place = row.place,
                          .format = *format,
                          .lowFirst = row.lowFirst.value_or(false),
                          .safe = row.safe ? row.safe->value : 0,
                          .holds = row.holds,
                          .at = row.placeAt};
  if (!checkPlace(made, connection, where)) return;
  if (pin.direction != Direction::In || reserve(*index, row.pin.at, where)) connection.pins.push_back(made);
}

std::optional<uint32_t> ConnectionReader::find(const Place& name, const std::string& where) {
  const std::vector<Pin>& pins = reading_.map().pins;
  const auto found = std::ranges::find(pins, name.text, &Pin::name);
  if (found != pins.end()) return static_cast<uint32_t>(found - pins.begin());
  const std::string_view meant = text::mostSimilar(name.text, pins, &Pin::name);
  reading_.fail(name.at, where + ": found no pin " + name.text + ", expected a pin of this map" +
                             (meant.empty() ? "; write one into [in] or [out]" : text::didYouMean(meant)));
  return std::nullopt;
}

bool ConnectionReader::checkDirection(const PinRow& row, const Connection& connection, const Pin& pin,
                                      const std::string& where) {
  const bool isInput = pin.direction == Direction::In;
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    reading_.fail(row.pin.at, where + ": found " + found + ", expected " + expected);
    return false;
  };
  if (!isInput && pin.direction != Direction::Out)
    return refuse("a pin of [" + std::string(tableName(pin.direction)) + "]",
                  "one of [in] or [out], which have one source; write two pins, one each way");
  const std::string here(areaName(row.area));
  const std::string writable = isRegister(row.area) ? "holding-registers" : "coils";
  if (isWritable(row.area) || row.area == Area::Memory) return true;
  if (connection.kind == Connection::Kind::ModbusServer && isInput)
    return refuse("an input pin in " + here,
                  "one in " + writable + ", because clients cannot write " + here + "; move it there");
  if (connection.kind == Connection::Kind::ModbusClient && !isInput)
    return refuse("an output pin in " + here,
                  "one in " + writable + ", because the " + here + " of a device cannot be written; move it there");
  return true;
}

std::optional<Format> ConnectionReader::formatFor(const PinRow& row, const Pin& pin, const std::string& where) {
  const bool isBitArea = row.area == Area::Coil || row.area == Area::DiscreteInput;
  const bool isBit = pin.type == PinType::Bit;
  if (row.area != Area::Memory && isBit != isBitArea) {
    reading_.fail(
        row.pin.at,
        where + ": found a pin of type " + std::string(pinTypeName(pin.type)) + ", expected " +
            (isBitArea ? "type bit in " : "type s32, u32 or float in ") + std::string(areaName(row.area)) +
            (isBitArea ? "; move it to the registers" : "; name the cell of the bits, and write type = \"u32\""));
    return std::nullopt;
  }
  const Format format = row.format.value_or(usualFormat(row.area, pin.type));
  if (format == Format::F32 && pin.type != PinType::Float) {
    reading_.fail(row.formatAt, where + ".format: found \"f32\" for a pin of type " +
                                    std::string(pinTypeName(pin.type)) +
                                    ", expected a pin of type float; write another format");
    return std::nullopt;
  }
  return format;
}

bool ConnectionReader::checkOrder(const PinRow& row, Format format, const std::string& where) {
  const bool isTwo = isRegister(row.area) && registersOf(format) == 2;
  if (isTwo == row.lowFirst.has_value()) return true;
  if (isTwo)
    reading_.fail(row.formatAt, where + ": found two registers without an order, expected \"high-first\" or "
                                        "\"low-first\"; write for example order = \"high-first\"");
  else
    reading_.fail(row.orderAt, where + ".order: found an order of one register, expected a format of 32 bits; remove "
                                       "it, or write for example format = \"s32\"");
  return false;
}

bool ConnectionReader::checkSafe(const PinRow& row, const Pin& pin, const std::string& where) {
  const size_t before = reading_.mistakes().size();
  if ((row.safe || row.holds) && pin.direction != Direction::In)
    reading_.fail(row.safeAt, where +
                                  ".safe: found one for an output pin, expected one only for an input pin; write it "
                                  "where the pin is, in [out]");
  else
    reading_.checkNumber(row.safe, pin.type, where + ".safe");
  return reading_.mistakes().size() == before;
}

bool ConnectionReader::checkPlace(const ConnectedPin& pin, const Connection& connection, const std::string& where) {
  const uint32_t length = lengthOf(pin);
  const bool isMemory = pin.area == Area::Memory;
  const auto refuse = [&](const std::string& what) { return reading_.fail(pin.at, where + ": found " + what), false; };
  const std::string place = std::to_string(pin.place);
  if (pin.place + length > (isMemory ? kMostMemory : kMostPlaces))
    return refuse(place + ", expected room for " + std::to_string(length) + (isMemory ? " bytes" : " registers") +
                  " below 65536; write a lower number");
  if (isMemory && pin.place % length != 0)
    return refuse(place + ", expected a multiple of " + std::to_string(length) + ", the length of its type; write " +
                  std::to_string(pin.place / length * length));
  const std::vector<Pin>& pins = reading_.map().pins;
  for (const ConnectedPin& other : connection.pins) {
    const bool sameSide = !isMemory || pins[other.pin].direction == pins[pin.pin].direction;
    const bool overlaps = pin.place < other.place + lengthOf(other) && other.place < pin.place + length;
    if (other.area == pin.area && sameSide && overlaps)
      return refuse(place + ", which is taken by pin " + pins[other.pin].name + " in " + reading_.lineOf(other.at) +
                    ", expected a place of its own; write another number");
  }
  return true;
}

// Reserves an input, which may have only one source.
bool ConnectionReader::reserve(uint32_t pin, text::Position at, const std::string& where) {
  std::optional<text::Position>& source = sources_[pin];
  if (source)
    reading_.fail(at, where + ": found an input pin that is connected in " + reading_.lineOf(*source) +
                          " already, expected one source for it; remove one of them");
  else
    source = at;
  return source == at;
}

uint32_t registersOf(Format format) { return format == Format::S16 || format == Format::U16 ? 1 : 2; }

uint32_t bytesOf(Format format) {
  switch (format) {
  case Format::Bit: return 1;
  case Format::S32:
  case Format::U32: return 4;
  case Format::F64: return 8;
  case Format::S16:
  case Format::U16:
  case Format::F32: break;
  }
  return 0;
}

std::string_view kindName(Connection::Kind kind) {
  switch (kind) {
  case Connection::Kind::ModbusClient: return "modbus-client";
  case Connection::Kind::ModbusServer: return "modbus-server";
  case Connection::Kind::SharedMemory: return "shared-memory";
  }
  return "?";
}

std::string Connection::title() const {
  const std::string kindText(kindName(kind));
  if (kind == Kind::SharedMemory) return kindText + " " + name;
  const bool isSix = host.find(':') != std::string::npos;
  return kindText + " " + (isSix ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

void refuseConnections(const File& map, std::string_view host, std::vector<std::string>& errors) {
  for (const Connection& connection : map.connections) {
    const std::string table(kindName(connection.kind));
    errors.push_back(
        map.message(connection.at, table + ": found a connection that only rung-run serves, expected none in " +
                                       std::string(host) + "; remove the table [" + table + "]"));
  }
}

} // namespace rung::host
