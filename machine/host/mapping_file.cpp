// Reader of the mapping file: each table is a list of keys, each key a row with its expected value and its function.
#include "machine/host/mapping_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "machine/host/mapping_connections.h"
#include "machine/host/mapping_devices.h"
#include "machine/host/mapping_reading.h"
#include "rtlib/text/number.h"
#include "rtlib/text/regular_file.h"
#include "rtlib/text/similar.h"

namespace rung::host {

namespace {

constexpr PinType kPinTypes[] = {PinType::Bit, PinType::S32, PinType::U32, PinType::Float};
constexpr double kLongestTimeout = 1e6; // seconds
constexpr double kShortestTimeout = 1e-9;

constexpr std::string_view kPermissions = "a list of \"set\", \"force\", \"reload\", \"start\", \"stop\", \"reset\", "
                                          "\"profile\", \"serve\" and \"acknowledge\"";

constexpr double kMegabyte = 1 << 20;
constexpr double kLeastLog = 0.1; // megabytes
constexpr double kMostLog = 1000;

constexpr int64_t kMostBits = 32;
constexpr size_t kMostFiles = 64; // including nested files
constexpr size_t kMostBytes = size_t{1} << 20;

// TOML reads NAME.REST = … as the key REST of a table NAME.
bool isUnquotedName(const toml::node& node) {
  const toml::table* table = node.as_table();
  return table != nullptr && !table->empty() &&
         std::ranges::all_of(*table, [](const auto& entry) { return entry.second.is_table(); });
}

// An entry of [in], [out], [io] or [param].
struct PinRow {
  std::optional<PinType> type;
  std::vector<Place> names;
  std::optional<double> scale;
  text::Position scaleAt;
  int64_t bits = 0;
  text::Position bitsAt;
  std::optional<Number> value;
  std::optional<Number> safe;
  bool holds = false;
};

std::string_view pinKind(Direction direction) {
  switch (direction) {
  case Direction::In: return "an input pin";
  case Direction::Out: return "an output pin";
  case Direction::Io: return "an io pin";
  case Direction::Parameter: return "a parameter";
  }
  return "?";
}

// "lamp-07" for 16 pins, "lamp-7" for 8.
std::string bitName(const std::string& name, int64_t bit, int64_t bits) {
  return name + (bits > 10 && bit < 10 ? "-0" : "-") + std::to_string(bit);
}

struct EdgeRow {
  std::string pin;
  text::Position pinAt;
  bool rising = true;
};

// An entry of [[send]].
struct SendRow {
  EdgeRow edge;
  rung_function_kind kind = RUNG_FUNCTION_M;
  int32_t code = 0;
  std::optional<Place> codePin;
  std::optional<Place> donePin;
  uint32_t channel = 1;
};

class Reader : public Reading {
public:
  Reader(File& map, const ReadFile& read) : Reading(map), read_(read) {}

  // Reads the text of a file that is not in File::paths yet.
  void read(std::string_view text, const std::string& path);
  // To be called when all files have been read.
  void resolve() { connections_.resolve(); }

private:
  template <class Row>
  using Key = text::TomlKey<Reader, Row>;

  static const Key<File> kFileKeys[19];
  static const Key<File> kLogKeys[1];
  static const Key<File> kRemoteKeys[2];
  static const Key<PinRow> kType, kName, kScale, kBits, kValue, kSafe;
  static const Key<PinRow> kInputKeys[4], kOutputKeys[5], kParameterKeys[4];
  static const Key<SendRow> kSendKeys[6];
  static const Key<EdgeRow> kAbortKeys[2];

  template <class Row, size_t N>
  bool readKeys(const toml::table& table, std::string_view where, const Key<Row> (&keys)[N], Row& row) {
    return Reading::readKeys(*this, table, where, keys, row);
  }

  // Top-level keys.
  bool takeIncludes(const toml::node& node, File&) {
    return takePaths(node, [this](const toml::node& path) { include(path); });
  }
  void include(const toml::node& node);
  bool takeMessageFiles(const toml::node& node, File& map) {
    return takePaths(node, [&](const toml::node& path) {
      map.messageFiles.push_back({beside(map.paths[file()], text::stringOf(path)), positionOf(path)});
    });
  }
  // Reads a path, or a list of paths.
  template <class Take>
  static bool takePaths(const toml::node& node, Take take) {
    const auto isText = [](const toml::node& element) { return !text::stringOf(element).empty(); };
    const toml::array* list = node.as_array();
    if (list == nullptr ? !isText(node) : list->empty() || !std::ranges::all_of(*list, isText)) return false;
    if (list == nullptr)
      take(node);
    else
      for (const toml::node& element : *list) take(element);
    return true;
  }
  bool takeTimeout(const toml::node& node, File& map) {
    const std::optional<double> seconds = text::numberOf(node);
    if (!seconds || !(*seconds >= kShortestTimeout && *seconds <= kLongestTimeout)) return false;
    if (timeoutAt_)
      fail(positionOf(node),
           "timeout: found a second one, expected only that of " + lineOf(*timeoutAt_) + "; remove one of them");
    timeoutAt_ = positionOf(node);
    map.timeoutNs = static_cast<int64_t>(*seconds * 1e9);
    return true;
  }
  bool takeHighSpeed(const toml::node& node, File& map) {
    const auto wanted = node.value_exact<bool>();
    if (wanted.value_or(false)) map.highSpeed = positionOf(node);
    return wanted.has_value();
  }
  bool takeInputs(const toml::node& node, File&) { return takePins(node, Direction::In, kInputKeys); }
  bool takeOutputs(const toml::node& node, File&) { return takePins(node, Direction::Out, kOutputKeys); }
  bool takeIos(const toml::node& node, File&) { return takePins(node, Direction::Io, kOutputKeys); }
  bool takeParameters(const toml::node& node, File&) { return takePins(node, Direction::Parameter, kParameterKeys); }
  bool takeConstants(const toml::node& node, File& map);
  bool takeSends(const toml::node& node, File& map);
  bool takeGroups(const toml::node& node, File& map);
  bool takeAxisGroups(const toml::node& node, File& map);
  bool takeAborts(const toml::node& node, File& map);
  bool takeClients(const toml::node& node, File&) { return connections_.read(node, Connection::Kind::ModbusClient); }
  bool takeServers(const toml::node& node, File&) { return connections_.read(node, Connection::Kind::ModbusServer); }
  bool takeMemories(const toml::node& node, File&) { return connections_.read(node, Connection::Kind::SharedMemory); }
  bool takeDevices(const toml::node& node, File& map) { return readDevices(*this, node, map); }
  bool takeRemote(const toml::node& node, File& map) {
    const toml::table* table = node.as_table();
    if (table != nullptr) readKeys(*table, "rungctl", kRemoteKeys, map);
    return table != nullptr;
  }
  bool takeLog(const toml::node& node, File& map) {
    const toml::table* table = node.as_table();
    if (table != nullptr) readKeys(*table, "log", kLogKeys, map);
    return table != nullptr;
  }
  bool takeLogSize(const toml::node& node, File& map) {
    const std::optional<double> size = text::numberOf(node);
    if (!size || !(*size >= kLeastLog && *size <= kMostLog)) return false;
    if (logAt_)
      fail(positionOf(node),
           "log.size: found a second one, expected only that of " + lineOf(*logAt_) + "; remove one of them");
    logAt_ = positionOf(node);
    map.logBytes = static_cast<uint64_t>(*size * kMegabyte);
    return true;
  }
  bool takePermissions(const toml::node& node, File& map) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return false;
    for (const toml::node& element : *list) {
      const auto known = std::ranges::find(kRemoteNames, text::stringOf(element));
      if (known != std::end(kRemoteNames))
        map.permissions[known - std::begin(kRemoteNames)] = true;
      else
        fail(positionOf(element), "rungctl.permissions: found " + text::textOf(element) + " in the list, expected " +
                                      std::string(kPermissions) +
                                      text::didYouMean(text::mostSimilar(text::stringOf(element), kRemoteNames)));
    }
    return true;
  }
  bool takeProtected(const toml::node& node, File& map) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return false;
    for (const toml::node& element : *list) {
      const std::string name = text::stringOf(element);
      if (!name.empty())
        map.protectedCells.push_back({name, positionOf(element)});
      else
        fail(positionOf(element), "rungctl.protected: found " + text::textOf(element) +
                                      " in the list, expected a name of the program; write for example \"X0.0\"");
    }
    return true;
  }

  template <size_t N>
  bool takePins(const toml::node& node, Direction direction, const Key<PinRow> (&keys)[N]);
  template <size_t N>
  void readPin(const toml::key& key, const toml::node& node, Direction direction, const Key<PinRow> (&keys)[N]);
  void checkRow(const PinRow& row, Direction direction, const std::string& where);
  bool makePins(const Place& name, const PinRow& row, Direction direction, Link& link);
  template <class Row, size_t N, class Add>
  bool takeList(const toml::node& node, std::string_view name, const Key<Row> (&keys)[N], Add add);

  // Keys of a pin.
  bool takeType(const toml::node& node, PinRow& row) {
    const auto found = std::ranges::find(kPinTypes, text::stringOf(node), pinTypeName);
    if (found == std::end(kPinTypes)) return false;
    row.type = *found;
    return true;
  }
  bool takeNames(const toml::node& node, PinRow& row) {
    if (const toml::array* list = node.as_array())
      return !list->empty() &&
             std::ranges::all_of(*list, [&](const toml::node& element) { return takeOneName(element, row); });
    return takeOneName(node, row);
  }
  bool takeOneName(const toml::node& node, PinRow& row) {
    row.names.push_back({text::stringOf(node), positionOf(node)});
    return !row.names.back().text.empty();
  }
  bool takeScale(const toml::node& node, PinRow& row) {
    row.scale = text::numberOf(node);
    row.scaleAt = positionOf(node);
    return row.scale.value_or(0) != 0;
  }
  bool takeBits(const toml::node& node, PinRow& row) {
    row.bits = node.value_exact<int64_t>().value_or(0);
    row.bitsAt = positionOf(node);
    return row.bits >= 1 && row.bits <= kMostBits;
  }
  bool takeNumber(const toml::node& node, std::optional<Number>& number) {
    number = numberWithType(node);
    return number.has_value();
  }
  bool takeParameterValue(const toml::node& node, PinRow& row) { return takeNumber(node, row.value); }
  bool takeSafe(const toml::node& node, PinRow& row) {
    row.holds = text::stringOf(node) == "hold";
    return row.holds || takeNumber(node, row.safe);
  }

  // Keys of a function and of an abort.
  std::optional<Place> pinNameOf(const toml::node& node) {
    Place name{text::stringOf(node), positionOf(node)};
    return isPinName(name.text) ? std::optional(std::move(name)) : std::nullopt;
  }
  bool takeEdgePin(const toml::node& node, EdgeRow& row) {
    const std::optional<Place> name = pinNameOf(node);
    if (name) row = {name->text, name->at, row.rising};
    return name.has_value();
  }
  bool takeEdge(const toml::node& node, EdgeRow& row) {
    const std::string direction = text::stringOf(node);
    row.rising = direction == "rise";
    return row.rising || direction == "fall";
  }
  bool takeSendPin(const toml::node& node, SendRow& row) { return takeEdgePin(node, row.edge); }
  bool takeSendEdge(const toml::node& node, SendRow& row) { return takeEdge(node, row.edge); }
  bool takeFunction(const toml::node& node, SendRow& row) {
    const auto kind = std::ranges::find(kFunctionKinds, text::stringOf(node));
    row.kind = static_cast<rung_function_kind>(kind - std::begin(kFunctionKinds));
    return kind != std::end(kFunctionKinds);
  }
  bool takeCode(const toml::node& node, SendRow& row) {
    row.codePin = pinNameOf(node);
    const auto number = node.value_exact<int64_t>();
    if (number && std::in_range<int32_t>(*number)) row.code = static_cast<int32_t>(*number);
    return row.codePin || (number && std::in_range<int32_t>(*number));
  }
  bool takeChannel(const toml::node& node, SendRow& row) {
    const auto number = node.value_exact<int64_t>();
    if (number && std::in_range<uint32_t>(*number)) row.channel = static_cast<uint32_t>(*number);
    return number && std::in_range<uint32_t>(*number) && *number != 0;
  }
  bool takeDone(const toml::node& node, SendRow& row) {
    row.donePin = pinNameOf(node);
    return row.donePin.has_value();
  }

  // Returns the pin with this name; creates it if it is new. Nothing: the name has another use, which is reported.
  std::optional<uint32_t> pin(const Place& name, PinType type, Direction direction);
  std::optional<Edge> edge(const EdgeRow& row) {
    const std::optional<uint32_t> index = pin({row.pin, row.pinAt}, PinType::Bit, Direction::In);
    if (!index) return std::nullopt;
    return Edge{*index, row.rising};
  }
  void addSend(const SendRow& row, text::Position at);

  const ReadFile& read_;
  ConnectionReader connections_{*this};
  std::optional<text::Position> timeoutAt_, logAt_;
};

const Reader::Key<File> Reader::kFileKeys[] = {
    {"include", false, "the path of a file, or a list of paths", "include = \"panel.map\"", &Reader::takeIncludes},
    {"timeout", false, "seconds, above 0 and at most 1000000", "timeout = 30", &Reader::takeTimeout},
    {"high-speed", false, "true or false", "high-speed = true", &Reader::takeHighSpeed},
    {"in", false, "a table", "[in] and its pins in the lines after it", &Reader::takeInputs},
    {"out", false, "a table", "[out] and its pins in the lines after it", &Reader::takeOutputs},
    {"io", false, "a table", "[io] and its pins in the lines after it", &Reader::takeIos},
    {"param", false, "a table", "[param] and its parameters in the lines after it", &Reader::takeParameters},
    {"const", false, "a table", "[const] and NAME = VALUE in the lines after it", &Reader::takeConstants},
    {"send", false, "a list of tables", "[[send]] and its keys in the lines after it", &Reader::takeSends},
    {"m-groups", false, "a table", "[m-groups] and CODE = GROUP in the lines after it", &Reader::takeGroups},
    {"PlcErrors", false, "the path of a file, or a list of paths", "PlcErrors = \"Plc0.PlcErrors\"",
     &Reader::takeMessageFiles},
    {"axis-groups", false, "a table", "[axis-groups] and AXIS = \"GROUP\" in the lines after it",
     &Reader::takeAxisGroups},
    {"abort", false, "a list of tables", "[[abort]] and its keys in the lines after it", &Reader::takeAborts},
    {"rungctl", false, "a table", "[rungctl] and permissions = [ … ] in the lines after it", &Reader::takeRemote},
    {"log", false, "a table", "[log] and size = 4 in the lines after it", &Reader::takeLog},
    {"modbus-client", false, "a list of tables", "[[modbus-client]] and its keys in the lines after it",
     &Reader::takeClients},
    {"devices", false, "a table", "[devices] and com = { 1 = \"/dev/ttyUSB0\" } in the lines after it",
     &Reader::takeDevices},
    {"modbus-server", false, "a table", "[modbus-server] and its keys in the lines after it", &Reader::takeServers},
    {"shared-memory", false, "a table", "[shared-memory] and its keys in the lines after it", &Reader::takeMemories},
};

const Reader::Key<File> Reader::kRemoteKeys[] = {
    {"permissions", false, kPermissions, "permissions = [\"set\"]", &Reader::takePermissions},
    {"protected", false, "a list of names of the program", "protected = [\"X0.0\"]", &Reader::takeProtected},
};

const Reader::Key<File> Reader::kLogKeys[] = {
    {"size", false, "megabytes on disk, 0.1 to 1000", "size = 4", &Reader::takeLogSize},
};

const Reader::Key<PinRow> Reader::kType = {"type", true, "\"bit\", \"s32\", \"u32\" or \"float\"", "type = \"bit\"",
                                           &Reader::takeType};
const Reader::Key<PinRow> Reader::kName = {"name", true, "a name of the program, or a list of names", "name = \"X0.0\"",
                                           &Reader::takeNames};
const Reader::Key<PinRow> Reader::kScale = {"scale", false, "a number other than 0", "scale = 1000",
                                            &Reader::takeScale};
const Reader::Key<PinRow> Reader::kBits = {"bits", false, "how many bits of a cell have a pin, 1 to 32", "bits = 8",
                                           &Reader::takeBits};
const Reader::Key<PinRow> Reader::kValue = {"value", false, "true, false or a number", "value = 500",
                                            &Reader::takeParameterValue};
const Reader::Key<PinRow> Reader::kSafe = {"safe", false, "true, false, a number or \"hold\"", "safe = true",
                                           &Reader::takeSafe};
const Reader::Key<PinRow> Reader::kInputKeys[] = {kType, kName, kScale, kBits};
const Reader::Key<PinRow> Reader::kOutputKeys[] = {kType, kName, kScale, kBits, kSafe};
const Reader::Key<PinRow> Reader::kParameterKeys[] = {kType, kName, kScale, kValue};

const Reader::Key<SendRow> Reader::kSendKeys[] = {
    {"pin", true, "the name of a pin", "pin = \"spindle-forward\"", &Reader::takeSendPin},
    {"edge", true, "\"rise\" or \"fall\"", "edge = \"rise\"", &Reader::takeSendEdge},
    {"function", true, "\"M\", \"S\", \"T\", \"B\", \"H\" or \"key\"", "function = \"M\"", &Reader::takeFunction},
    {"code", true, "an integer of 32 bits with a sign, or the name of an s32 pin", "code = 3", &Reader::takeCode},
    {"done", false, "the name of a pin", "done = \"tool-changed\"", &Reader::takeDone},
    {"channel", false, "the number of a channel of the control, from 1", "channel = 2", &Reader::takeChannel},
};

const Reader::Key<EdgeRow> Reader::kAbortKeys[] = {
    {"pin", true, "the name of a pin", "pin = \"estop\"", &Reader::takeEdgePin},
    {"edge", true, "\"rise\" or \"fall\"", "edge = \"rise\"", &Reader::takeEdge},
};

void Reader::read(std::string_view text, const std::string& path) {
  const uint32_t before = file();
  setFile(static_cast<uint32_t>(map().paths.size()));
  map().paths.push_back(path);
  if (const std::optional<toml::table> table = parse(text)) readKeys(*table, "", kFileKeys, map());
  setFile(before);
}

void Reader::include(const toml::node& node) {
  const std::string path = beside(map().paths[file()], text::stringOf(node));
  const auto wrongFile = [&](const std::string& found, const std::string& expectedAndFix) {
    fail(positionOf(node), "include: found " + found + ", expected " + expectedAndFix);
  };
  if (std::ranges::find(map().paths, path) != map().paths.end())
    return wrongFile(path + " again", "each file once; remove it here");
  if (map().paths.size() == kMostFiles)
    return wrongFile("one more file", "at most " + std::to_string(kMostFiles) + "; write several into one");
  std::string text;
  try {
    text = read_(path);
  } catch (const std::exception& error) {
    return wrongFile(text::stringOf(node),
                     std::string("a file (") + error.what() + "); write its path, from the folder of this file");
  }
  read(text, path);
}

template <size_t N>
bool Reader::takePins(const toml::node& node, Direction direction, const Key<PinRow> (&keys)[N]) {
  const toml::table* entries = node.as_table();
  if (entries == nullptr) return false;
  for (const auto& [key, pinNode] : text::inFileOrder(*entries)) readPin(*key, *pinNode, direction, keys);
  return true;
}

template <size_t N>
void Reader::readPin(const toml::key& key, const toml::node& node, Direction direction, const Key<PinRow> (&keys)[N]) {
  const size_t before = mistakes().size();
  const Place name{std::string(key.str()), positionOf(key.source())};
  const std::string where = std::string(tableName(direction)) + "." + name.text;
  if (!isPinName(name.text))
    fail(name.at,
         where + ": found \"" + name.text + "\", expected the name of a pin: letters, digits, '-', '_' and '.'");
  const toml::table* entry = node.as_table();
  if (entry == nullptr) return wrong(node, where, "a table", name.text + " = { type = \"bit\", name = \"X0.0\" }");
  if (isUnquotedName(node))
    return fail(name.at, where + ": found a name with a dot, expected quotes around it; write for example \"" +
                             name.text + ".1\" = { … }");
  PinRow row;
  readKeys(*entry, where, keys, row);
  if (row.type) checkRow(row, direction, where);
  Link link{.scale = row.scale.value_or(1)};
  const bool good = mistakes().size() == before && makePins(name, row, direction, link);
  if (row.value) link.value = row.value->value;
  for (Place& place : row.names) {
    link.name = std::move(place.text);
    link.at = place.at;
    if (good)
      map().links.push_back(link);
    else if (!link.name.empty())
      map().namedOnly.push_back({where + ".name", link.name, link.at, direction});
  }
}

// Checks the combination of a pin's keys.
void Reader::checkRow(const PinRow& row, Direction direction, const std::string& where) {
  if (row.scale && row.type != PinType::Float)
    fail(row.scaleAt, where + ".scale: found a scale of type " + std::string(pinTypeName(*row.type)) +
                          ", expected one of type float only; remove it, or write type = \"float\"");
  if (row.bits != 0 && row.type != PinType::Bit)
    fail(row.bitsAt, where + ".bits: found pins of type " + std::string(pinTypeName(*row.type)) +
                         ", expected type bit, one for each bit of the cell; write type = \"bit\", or remove it");
  if (fromProgram(direction) && row.names.size() > 1)
    fail(row.names[1].at, where + ".name: found several names, expected one, because " +
                              std::string(pinKind(direction)) +
                              " has one source; give the other names pins of their own");
  checkNumber(row.value, *row.type, where + ".value");
  checkNumber(row.safe, *row.type, where + ".safe");
}

// Creates the pin of a row, or one for each of its bits.
bool Reader::makePins(const Place& name, const PinRow& row, Direction direction, Link& link) {
  const auto make = [&](const std::string& text) {
    const std::optional<uint32_t> index = pin({text, name.at}, *row.type, direction);
    if (!index || !fromProgram(direction)) return index;
    map().pins[*index].holds = row.holds;
    map().pins[*index].safe = row.safe ? row.safe->value : 0;
    return index;
  };
  for (int64_t bit = 0; bit < row.bits; ++bit) {
    const std::optional<uint32_t> index = make(bitName(name.text, bit, row.bits));
    if (!index) return false;
    link.bits.push_back(*index);
  }
  const std::optional<uint32_t> index = row.bits != 0 ? link.bits.front() : make(name.text);
  link.pin = index.value_or(0);
  return index.has_value();
}

bool Reader::takeConstants(const toml::node& node, File& map) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  for (const auto& [key, value] : text::inFileOrder(*table)) {
    Constant constant{PinType::Bit, std::string(key->str()), 0, positionOf(key->source())};
    const std::string where = "const." + constant.name;
    if (constant.name.empty())
      fail(constant.at, "const: found \"\", expected a name of the program; write for example \"X0.0\" = true");
    else if (const std::optional<Number> number = numberWithType(*value))
      map.constants.push_back({number->type, constant.name, number->value, constant.at});
    else if (value->is_table())
      fail(constant.at, where + ": found a name with a dot, expected quotes around it; write for example \"" +
                            constant.name + ".1\" = true");
    else
      wrong(*value, where, "true, false, an integer from -2147483648 to 4294967295, or a real number",
            "\"" + constant.name + "\" = 1");
  }
  return true;
}

// Reads [[name]] tables: calls add(row, position) for each without errors.
template <class Row, size_t N, class Add>
bool Reader::takeList(const toml::node& node, std::string_view name, const Key<Row> (&keys)[N], Add add) {
  const toml::array* list = node.as_array();
  if (list == nullptr || !std::ranges::all_of(*list, &toml::node::is_table)) return false;
  for (const toml::node& element : *list) {
    Row row;
    if (readKeys(*element.as_table(), name, keys, row)) add(row, positionOf(element));
  }
  return true;
}

bool Reader::takeSends(const toml::node& node, File&) {
  return takeList(node, "send", kSendKeys, [this](const SendRow& row, text::Position at) { addSend(row, at); });
}

bool Reader::takeGroups(const toml::node& node, File& map) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  for (const auto& [key, value] : text::inFileOrder(*table)) {
    const std::string_view name = key->str();
    const text::Position at = positionOf(key->source());
    const std::optional<uint32_t> code = text::numberIn<uint32_t>(name);
    const auto group = value->value_exact<int64_t>();
    // 70 and 070 are different keys in TOML.
    const auto first = std::ranges::find(map.groups, code, &Group::code);
    if (!code)
      fail(at, "m-groups: found \"" + std::string(name) +
                   "\", expected the number of an M function; write for example 70 = 10");
    else if (first != map.groups.end())
      fail(at, "m-groups: found M" + std::to_string(*code) + ", which is in " + lineOf(first->at) +
                   " already, expected one group for each function; remove one of the lines");
    else if (!group || !std::in_range<uint32_t>(*group))
      wrong(*value, "m-groups." + std::string(name), "the number of a group", "70 = 10");
    else
      map.groups.push_back({*code, static_cast<uint32_t>(*group), at});
  }
  return true;
}

bool Reader::takeAxisGroups(const toml::node& node, File& map) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  for (const auto& [key, value] : text::inFileOrder(*table)) {
    const std::string_view name = key->str();
    const text::Position at = positionOf(key->source());
    const std::optional<uint32_t> axis = text::numberIn<uint32_t>(name);
    const std::string group = text::stringOf(*value);
    const auto first = std::ranges::find(map.axisGroups, axis.value_or(0) - 1, &AxisGroup::axis);
    if (axis.value_or(0) == 0)
      fail(at, "axis-groups: found \"" + std::string(name) +
                   "\", expected the number of an axis, from 1; write for example 4 = \"A\"");
    else if (first != map.axisGroups.end())
      fail(at, "axis-groups: found axis " + std::to_string(*axis) + ", which is in " + lineOf(first->at) +
                   " already, expected one group for each axis; remove one of the lines");
    else if (group.size() != 1 || group[0] < 'A' || group[0] > 'Z')
      wrong(*value, "axis-groups." + std::string(name), "the letter of a group", "4 = \"A\"");
    else
      map.axisGroups.push_back({*axis - 1, static_cast<uint32_t>(group[0] - 'A'), at});
  }
  return true;
}

bool Reader::takeAborts(const toml::node& node, File& map) {
  return takeList(node, "abort", kAbortKeys, [&](const EdgeRow& row, text::Position) {
    if (const std::optional<Edge> cause = edge(row)) map.aborts.push_back(*cause);
  });
}

void Reader::addSend(const SendRow& row, text::Position at) {
  const size_t before = mistakes().size();
  Send sent{.kind = row.kind, .channel = row.channel - 1, .code = row.code, .at = at};
  sent.edge = edge(row.edge).value_or(Edge{});
  if (row.codePin) sent.codePin = pin(*row.codePin, PinType::S32, Direction::In);
  if (row.donePin) sent.donePin = pin(*row.donePin, PinType::Bit, Direction::Out);
  if (mistakes().size() == before) map().sends.push_back(sent);
}

std::optional<uint32_t> Reader::pin(const Place& name, PinType type, Direction direction) {
  const auto old = std::ranges::find(map().pins, name.text, &Pin::name);
  if (old == map().pins.end()) {
    map().pins.push_back({.name = name.text, .type = type, .direction = direction, .at = name.at});
    return static_cast<uint32_t>(map().pins.size() - 1);
  }
  // One input may feed several names and functions; every other pin has one name.
  const bool same = old->direction == direction && old->type == type;
  if (same && direction == Direction::In) return static_cast<uint32_t>(old - map().pins.begin());
  const auto kind = [](Direction which, PinType itsType) {
    return std::string(pinKind(which)) + " of type " + std::string(pinTypeName(itsType));
  };
  fail(name.at, "pin " + name.text + ": found " + kind(old->direction, old->type) + " with this name in " +
                    lineOf(old->at) + ", expected " + kind(direction, type) +
                    (fromProgram(direction) && fromProgram(old->direction) ? " that has no other source" : "") +
                    "; give one of them another name");
  return std::nullopt;
}

} // namespace

std::string_view tableName(Direction direction) {
  switch (direction) {
  case Direction::In: return "in";
  case Direction::Out: return "out";
  case Direction::Io: return "io";
  case Direction::Parameter: return "param";
  }
  return "?";
}

std::string_view pinTypeName(PinType type) {
  switch (type) {
  case PinType::Bit: return "bit";
  case PinType::S32: return "s32";
  case PinType::U32: return "u32";
  case PinType::Float: return "float";
  }
  return "?";
}

std::string File::message(text::Position at, std::string_view what) const {
  return paths[at.file] + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " + std::string(what);
}

bool isNamedAsMap(std::string_view path) { return path.ends_with(".map"); }

std::string readFromDisk(const std::string& path) {
  std::string contents;
  const std::string problem = text::readRegular(path, kMostBytes, contents);
  if (!problem.empty()) throw std::runtime_error("cannot read " + path + ": " + problem);
  return contents;
}

File parseMap(std::string_view text, const std::string& path, std::vector<std::string>& errors, const ReadFile& read) {
  File map;
  Reader reader(map, read);
  reader.read(text, path);
  reader.resolve();
  std::ranges::move(reader.errors(), std::back_inserter(errors));
  return map;
}

File loadMap(const std::string& path, std::vector<std::string>& errors, const ReadFile& read) {
  std::string text;
  try {
    text = read(path);
  } catch (const std::exception& error) {
    errors.emplace_back(error.what());
    return {};
  }
  return parseMap(text, path, errors, read);
}

} // namespace rung::host
