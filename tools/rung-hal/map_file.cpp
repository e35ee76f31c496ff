// Reader of the mapping file: a table is a list of keys, and a key is one row, with what it takes and what takes it.
#include "tools/rung-hal/map_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <toml++/toml.h>

#include "ir/support/similar.h"
#include "rtlib/text/number.h"

namespace rung::hal {
namespace {

constexpr PinType kPinTypes[] = {PinType::Bit, PinType::S32, PinType::U32, PinType::Float};
constexpr int64_t kLeast = std::numeric_limits<int32_t>::min(); // of the integers of a constant
constexpr int64_t kMost = std::numeric_limits<uint32_t>::max();
constexpr double kLongestTimeout = 1e6; // seconds
constexpr double kShortestTimeout = 1e-9;

MapPosition positionOf(const toml::source_region& region) { return {region.begin.line, region.begin.column}; }
MapPosition positionOf(const toml::node& node) { return positionOf(node.source()); }

// False: no constant has such a value.
bool takeValue(const toml::node& node, MapConst& constant) {
  if (const auto bit = node.value_exact<bool>()) {
    constant.value = *bit ? 1 : 0;
    return true;
  }
  if (const auto integer = node.value_exact<int64_t>()) {
    constant.type = *integer < 0 ? PinType::S32 : PinType::U32;
    constant.value = static_cast<double>(*integer);
    return *integer >= kLeast && *integer <= kMost;
  }
  const auto real = node.value_exact<double>();
  constant.type = PinType::Float;
  constant.value = real.value_or(0);
  return real && std::isfinite(*real);
}

// A value as a file has it; of tables and lists the kind.
std::string shown(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  if (const auto text = node.value_exact<std::string>()) return "\"" + *text + "\"";
  if (const auto integer = node.value_exact<int64_t>()) return std::to_string(*integer);
  if (const auto boolean = node.value_exact<bool>()) return *boolean ? "true" : "false";
  if (const auto real = node.value_exact<double>()) {
    char text[32];
    return {text, std::to_chars(std::begin(text), std::end(text), *real).ptr};
  }
  return "a date or a time";
}

// "" where the value is not a text.
std::string textOf(const toml::node& node) { return node.value_exact<std::string>().value_or(""); }

std::optional<double> numberOf(const toml::node& node) {
  if (const auto integer = node.value_exact<int64_t>()) return static_cast<double>(*integer);
  if (const auto real = node.value_exact<double>(); real && std::isfinite(*real)) return real;
  return std::nullopt;
}

// NAME.REST = … is the key REST of a table NAME.
bool isUnquotedName(const toml::node& node) {
  const toml::table* table = node.as_table();
  return table != nullptr && !table->empty() &&
         std::ranges::all_of(*table, [](const auto& entry) { return entry.second.is_table(); });
}

bool isPinName(std::string_view word) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  return !word.empty() && word.find_first_not_of(kAllowed) == std::string_view::npos;
}

using Entry = std::pair<const toml::key*, const toml::node*>;

// toml++ keeps the keys of a table sorted by name.
std::vector<Entry> inFileOrder(const toml::table& table) {
  std::vector<Entry> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::ranges::sort(entries, {}, [](const Entry& entry) { return positionOf(entry.first->source()); });
  return entries;
}

struct Place { // of a value
  std::string text;
  MapPosition at;
};

// An entry of [in] or [out].
struct PinRow {
  std::optional<PinType> type;
  std::vector<Place> names;
  std::optional<double> scale;
  MapPosition scaleAt;
};

struct EdgeRow {
  std::string pin;
  MapPosition pinAt;
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

class Reader {
public:
  explicit Reader(MapFile& map) : map_(map) {}

  void read(const toml::table& file);
  void syntax(const toml::parse_error& error) {
    fail(positionOf(error.source()),
         std::string(error.description()) + "; the file must be TOML, and further mistakes are found once this is");
  }

  std::vector<std::string> errors() {
    std::ranges::stable_sort(errors_, {}, &std::pair<MapPosition, std::string>::first);
    std::vector<std::string> texts;
    for (const auto& [at, what] : errors_) texts.push_back(map_.message(at, what));
    return texts;
  }

private:
  // A key of a table that is read into a Row.
  template <class Row>
  struct Key {
    std::string_view name;
    bool needed = false;
    std::string_view expected;
    std::string_view example;
    bool (Reader::*take)(const toml::node&, Row&) = nullptr; // false: it is not what is expected
  };

  static const Key<MapFile> kFileKeys[8];
  static const Key<PinRow> kPinKeys[3];
  static const Key<SendRow> kSendKeys[6];
  static const Key<EdgeRow> kAbortKeys[2];

  void fail(MapPosition at, std::string what) { errors_.emplace_back(at, std::move(what)); }
  void wrong(MapPosition at, const std::string& where, const std::string& found, std::string_view expected,
             std::string_view example) {
    fail(at, where + ": found " + found + ", expected " + std::string(expected) + "; write for example " +
                 std::string(example));
  }

  // Reads a table by its keys; `where` is its name in messages, "" for the file. False: there were mistakes.
  template <class Row, size_t N>
  bool readKeys(const toml::table& table, std::string_view where, const Key<Row> (&keys)[N], Row& row) {
    const size_t before = errors_.size();
    const std::string prefix = where.empty() ? "" : std::string(where) + ".";
    for (const auto& [key, node] : inFileOrder(table)) {
      const auto known = std::ranges::find(keys, key->str(), &Key<Row>::name);
      if (known == std::end(keys))
        unknownKey(*key, where, keys);
      else if (!(this->*known->take)(*node, row))
        wrong(positionOf(*node), prefix + std::string(known->name), shown(*node), known->expected, known->example);
    }
    for (const Key<Row>& key : keys)
      if (key.needed && !table.contains(key.name))
        fail(positionOf(table), std::string(where) + ": found no key " + std::string(key.name) + ", expected " +
                                    std::string(key.expected) + "; write for example " + std::string(key.example));
    return errors_.size() == before;
  }

  template <class Row, size_t N>
  void unknownKey(const toml::key& key, std::string_view where, const Key<Row> (&keys)[N]) {
    Similar similar(key.str());
    std::string all;
    for (const Key<Row>& known : keys) {
      similar.offer(known.name);
      all += (all.empty() ? "" : ", ") + std::string(known.name);
    }
    std::string text = (where.empty() ? "the file" : std::string(where)) + ": found an unknown key " +
                       std::string(key.str()) + ", expected " + all;
    if (!similar.best().empty()) text += "; did you mean " + std::string(similar.best()) + "?";
    fail(positionOf(key.source()), std::move(text));
  }

  // The file's keys.
  bool takeTimeout(const toml::node& node, MapFile& map) {
    const std::optional<double> seconds = numberOf(node);
    if (!seconds || !(*seconds >= kShortestTimeout && *seconds <= kLongestTimeout)) return false;
    map.timeoutNs = static_cast<int64_t>(*seconds * 1e9);
    return true;
  }
  bool takeHighSpeed(const toml::node& node, MapFile& map) {
    const auto wanted = node.value_exact<bool>();
    if (wanted.value_or(false)) map.highSpeed = positionOf(node);
    return wanted.has_value();
  }
  bool takeInputs(const toml::node& node, MapFile& map) { return takePins(node, false, map.inputs); }
  bool takeOutputs(const toml::node& node, MapFile& map) { return takePins(node, true, map.outputs); }
  bool takeConstants(const toml::node& node, MapFile& map);
  bool takeSends(const toml::node& node, MapFile& map);
  bool takeGroups(const toml::node& node, MapFile& map);
  bool takeAborts(const toml::node& node, MapFile& map);

  bool takePins(const toml::node& node, bool output, std::vector<MapLink>& links);
  void readPin(const toml::key& key, const toml::node& node, bool output, std::vector<MapLink>& links);
  template <class Row, size_t N, class Add>
  bool takeList(const toml::node& node, std::string_view name, const Key<Row> (&keys)[N], Add add);

  // Keys of a pin.
  bool takeType(const toml::node& node, PinRow& row) {
    const auto found = std::ranges::find(kPinTypes, textOf(node), pinTypeName);
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
    row.names.push_back({textOf(node), positionOf(node)});
    return !row.names.back().text.empty();
  }
  bool takeScale(const toml::node& node, PinRow& row) {
    row.scale = numberOf(node);
    row.scaleAt = positionOf(node);
    return row.scale.value_or(0) != 0;
  }

  // Keys of a function and of an abort.
  std::optional<Place> pinNameOf(const toml::node& node) {
    Place name{textOf(node), positionOf(node)};
    return isPinName(name.text) ? std::optional(std::move(name)) : std::nullopt;
  }
  bool takeEdgePin(const toml::node& node, EdgeRow& row) {
    const std::optional<Place> name = pinNameOf(node);
    if (name) row = {name->text, name->at, row.rising};
    return name.has_value();
  }
  bool takeEdge(const toml::node& node, EdgeRow& row) {
    const std::string direction = textOf(node);
    row.rising = direction == "rise";
    return row.rising || direction == "fall";
  }
  bool takeSendPin(const toml::node& node, SendRow& row) { return takeEdgePin(node, row.edge); }
  bool takeSendEdge(const toml::node& node, SendRow& row) { return takeEdge(node, row.edge); }
  bool takeFunction(const toml::node& node, SendRow& row) {
    const auto kind = std::ranges::find(kFunctionKinds, textOf(node));
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

  // The pin of that name, made when it is new. Nothing: the name has another use, which is reported.
  std::optional<uint32_t> pin(const Place& name, PinType type, bool output);
  std::optional<MapEdge> edge(const EdgeRow& row) {
    const std::optional<uint32_t> index = pin({row.pin, row.pinAt}, PinType::Bit, false);
    if (!index) return std::nullopt;
    return MapEdge{*index, row.rising};
  }
  void addSend(const SendRow& row, MapPosition at);

  MapFile& map_;
  std::vector<std::pair<MapPosition, std::string>> errors_;
};

const Reader::Key<MapFile> Reader::kFileKeys[] = {
    {"timeout", false, "seconds, above 0 and at most 1000000", "timeout = 30", &Reader::takeTimeout},
    {"high-speed", false, "true or false", "high-speed = true", &Reader::takeHighSpeed},
    {"in", false, "a table", "[in] and its pins in the lines after it", &Reader::takeInputs},
    {"out", false, "a table", "[out] and its pins in the lines after it", &Reader::takeOutputs},
    {"const", false, "a table", "[const] and NAME = VALUE in the lines after it", &Reader::takeConstants},
    {"send", false, "a list of tables", "[[send]] and its keys in the lines after it", &Reader::takeSends},
    {"m-groups", false, "a table", "[m-groups] and CODE = GROUP in the lines after it", &Reader::takeGroups},
    {"abort", false, "a list of tables", "[[abort]] and its keys in the lines after it", &Reader::takeAborts},
};

const Reader::Key<PinRow> Reader::kPinKeys[] = {
    {"type", true, "\"bit\", \"s32\", \"u32\" or \"float\"", "type = \"bit\"", &Reader::takeType},
    {"name", true, "a name of the program, or a list of names", "name = \"X0.0\"", &Reader::takeNames},
    {"scale", false, "a number other than 0", "scale = 1000", &Reader::takeScale},
};

const Reader::Key<SendRow> Reader::kSendKeys[] = {
    {"pin", true, "the name of a pin", "pin = \"spindle-forward\"", &Reader::takeSendPin},
    {"edge", true, "\"rise\" or \"fall\"", "edge = \"rise\"", &Reader::takeSendEdge},
    {"function", true, "\"M\", \"S\", \"T\" or \"B\"", "function = \"M\"", &Reader::takeFunction},
    {"code", true, "an integer of 32 bits with a sign, or the name of an s32 pin", "code = 3", &Reader::takeCode},
    {"done", false, "the name of a pin", "done = \"tool-changed\"", &Reader::takeDone},
    {"channel", false, "the number of a channel of the control, from 1", "channel = 2", &Reader::takeChannel},
};

const Reader::Key<EdgeRow> Reader::kAbortKeys[] = {
    {"pin", true, "the name of a pin", "pin = \"estop\"", &Reader::takeEdgePin},
    {"edge", true, "\"rise\" or \"fall\"", "edge = \"rise\"", &Reader::takeEdge},
};

void Reader::read(const toml::table& file) { readKeys(file, "", kFileKeys, map_); }

bool Reader::takePins(const toml::node& node, bool output, std::vector<MapLink>& links) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  for (const auto& [key, pinNode] : inFileOrder(*table)) readPin(*key, *pinNode, output, links);
  return true;
}

void Reader::readPin(const toml::key& key, const toml::node& node, bool output, std::vector<MapLink>& links) {
  const Place name{std::string(key.str()), positionOf(key.source())};
  const std::string where = (output ? "out." : "in.") + name.text;
  if (!isPinName(name.text))
    return fail(name.at,
                where + ": found \"" + name.text + "\", expected the name of a pin: letters, digits, '-', '_' and '.'");
  const toml::table* table = node.as_table();
  if (table == nullptr)
    return wrong(positionOf(node), where, shown(node), "a table", name.text + " = { type = \"bit\", name = \"X0.0\" }");
  if (isUnquotedName(node))
    return fail(name.at, where + ": found a name with a dot, expected quotes around it; write for example \"" +
                             name.text + ".1\" = { … }");
  PinRow row;
  if (!readKeys(*table, where, kPinKeys, row) || !row.type) return; // which is needed
  if (row.scale && row.type != PinType::Float)
    return fail(row.scaleAt, where + ".scale: found a scale of type " + std::string(pinTypeName(*row.type)) +
                                 ", expected one of type float only; remove it, or write type = \"float\"");
  if (output && row.names.size() > 1)
    return fail(row.names[1].at, where + ".name: found several names, expected one, because an output pin has one "
                                         "source; give the other names pins of their own");
  const std::optional<uint32_t> index = pin(name, *row.type, output);
  if (!index) return;
  for (Place& place : row.names) links.push_back({*index, std::move(place.text), row.scale.value_or(1), place.at});
}

bool Reader::takeConstants(const toml::node& node, MapFile& map) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  for (const auto& [key, value] : inFileOrder(*table)) {
    MapConst constant{PinType::Bit, std::string(key->str()), 0, positionOf(key->source())};
    const std::string where = "const." + constant.name;
    if (constant.name.empty())
      fail(constant.at, "const: found \"\", expected a name of the program; write for example \"X0.0\" = true");
    else if (takeValue(*value, constant))
      map.constants.push_back(std::move(constant));
    else if (value->is_table())
      fail(constant.at, where + ": found a name with a dot, expected quotes around it; write for example \"" +
                            constant.name + ".1\" = true");
    else
      wrong(positionOf(*value), where, shown(*value),
            "true, false, an integer from -2147483648 to 4294967295, or a real number",
            "\"" + constant.name + "\" = 1");
  }
  return true;
}

// [[name]] tables: calls add(row, position) for each without mistakes.
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

bool Reader::takeSends(const toml::node& node, MapFile&) {
  return takeList(node, "send", kSendKeys, [this](const SendRow& row, MapPosition at) { addSend(row, at); });
}

bool Reader::takeGroups(const toml::node& node, MapFile& map) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  for (const auto& [key, value] : inFileOrder(*table)) {
    const std::string_view name = key->str();
    const MapPosition at = positionOf(key->source());
    const std::optional<uint32_t> code = text::numberIn<uint32_t>(name);
    const auto group = value->value_exact<int64_t>();
    // 70 and 070 are two keys.
    const auto first = std::ranges::find(map.groups, code, &MapGroup::code);
    if (!code)
      fail(at, "m-groups: found \"" + std::string(name) +
                   "\", expected the number of an M function; write for example 70 = 10");
    else if (first != map.groups.end())
      fail(at, "m-groups: found M" + std::to_string(*code) + ", which is in line " + std::to_string(first->at.line) +
                   " already, expected one group for each function; remove one of the lines");
    else if (!group || !std::in_range<uint32_t>(*group))
      wrong(positionOf(*value), "m-groups." + std::string(name), shown(*value), "the number of a group", "70 = 10");
    else
      map.groups.push_back({*code, static_cast<uint32_t>(*group), at});
  }
  return true;
}

bool Reader::takeAborts(const toml::node& node, MapFile& map) {
  return takeList(node, "abort", kAbortKeys, [&](const EdgeRow& row, MapPosition) {
    if (const std::optional<MapEdge> cause = edge(row)) map.aborts.push_back(*cause);
  });
}

void Reader::addSend(const SendRow& row, MapPosition at) {
  const size_t before = errors_.size();
  MapSend sent{.kind = row.kind, .channel = row.channel - 1, .code = row.code, .at = at};
  sent.edge = edge(row.edge).value_or(MapEdge{});
  if (row.codePin) sent.codePin = pin(*row.codePin, PinType::S32, false);
  if (row.donePin) sent.donePin = pin(*row.donePin, PinType::Bit, true);
  if (errors_.size() == before) map_.sends.push_back(sent);
}

std::optional<uint32_t> Reader::pin(const Place& name, PinType type, bool output) {
  const auto old = std::ranges::find(map_.pins, name.text, &MapPin::name);
  if (old == map_.pins.end()) {
    map_.pins.push_back({name.text, type, output, name.at});
    return static_cast<uint32_t>(map_.pins.size() - 1);
  }
  // One input may feed several names and functions, but an output has one source.
  if (!output && !old->output && old->type == type) return static_cast<uint32_t>(old - map_.pins.begin());
  const auto kind = [](bool isOutput, PinType itsType) {
    return std::string(isOutput ? "an output" : "an input") + " pin of type " + std::string(pinTypeName(itsType));
  };
  fail(name.at, "pin " + name.text + ": found " + kind(old->output, old->type) + " with this name in line " +
                    std::to_string(old->at.line) + ", expected " + kind(output, type) +
                    (output && old->output ? " that has no other source" : "") + "; give one of them another name");
  return std::nullopt;
}

} // namespace

std::string_view pinTypeName(PinType type) {
  switch (type) {
  case PinType::Bit: return "bit";
  case PinType::S32: return "s32";
  case PinType::U32: return "u32";
  case PinType::Float: return "float";
  }
  return "?";
}

std::string MapFile::message(MapPosition at, std::string_view what) const {
  return path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " + std::string(what);
}

MapFile parseMap(std::string_view text, std::string path, std::vector<std::string>& errors) {
  MapFile map;
  map.path = std::move(path);
  Reader reader(map);
  try {
    reader.read(toml::parse(text));
  } catch (const toml::parse_error& error) {
    reader.syntax(error);
  }
  for (std::string& error : reader.errors()) errors.push_back(std::move(error));
  return map;
}

} // namespace rung::hal
