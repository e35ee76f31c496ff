// The table [devices] (see mapping_devices.h).
#include "machine/host/mapping_devices.h"

#include "rtlib/nc/technol/services.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::host {
namespace {

using Kind = DeviceSetting::Kind;

// A configuration setting is a text, a number, or true and false for 1 and 0; nothing if it is none of these.
std::optional<std::string> settingOf(const toml::node& node) {
  if (const auto truth = node.value_exact<bool>()) return *truth ? "1" : "0";
  if (node.is_string() || node.is_number()) return node.is_string() ? text::stringOf(node) : text::textOf(node);
  return std::nullopt;
}

// Whether a key of the configuration names a file: PlcConfig, PlcTable3, PlcTableDef3.
bool namesFile(std::string_view key) {
  constexpr std::string_view kTables = "PlcTable";
  return text::equalsIgnoringCase(key, "PlcConfig") ||
         (key.size() > kTables.size() && text::startsWithIgnoringCase(key, kTables));
}

class DeviceReader {
public:
  DeviceReader(Reading& reading, File& map) : reading_(reading), map_(map) {}

  void read(const toml::table& table) { reading_.readKeys(*this, table, "devices", kKeys, map_); }

private:
  static const text::TomlKey<DeviceReader, File> kKeys[5];

  bool takeCan(const toml::node& node, File&) { return takeNames(node, Kind::Can, "devices.can", "2 = \"can0\""); }
  bool takeCom(const toml::node& node, File&) {
    return takeNames(node, Kind::Com, "devices.com", "1 = \"/dev/ttyUSB0\"");
  }
  bool takeNames(const toml::node& node, Kind kind, const std::string& where, std::string_view example) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    for (const auto& [key, value] : text::inFileOrder(*table)) {
      const std::string device = text::stringOf(*value);
      if (device.empty())
        reading_.wrong(*value, where + "." + std::string(key->str()), "the name of a device", example);
      else
        add(kind, key->str(), device, *value);
    }
    return true;
  }
  bool takeAxes(const toml::node& node, File&) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    for (const auto& [key, value] : text::inFileOrder(*table)) takeAxis(*key, *value);
    return true;
  }
  void takeAxis(const toml::key& key, const toml::node& node) {
    const uint32_t axis = text::numberIn<uint32_t>(key.str()).value_or(0);
    const std::string number = std::to_string(axis);
    const auto isSame = [&](const DeviceSetting& other) { return other.kind == Kind::Axis && other.key == number; };
    if (axis < 1 || axis > nc::kMaxAxes)
      return reading_.fail(reading_.positionOf(key.source()),
                           "devices.axes: found \"" + std::string(key.str()) +
                               "\", expected the number of an axis, 1 to 16; write for example 4 = \"table\"");
    if (std::ranges::any_of(map_.devices, isSame)) // 4 and 04 are different keys in TOML
      return reading_.fail(reading_.positionOf(key.source()),
                           "devices.axes: found axis " + number +
                               " again, expected each axis once; remove one of the lines");
    const toml::table* settings = node.as_table();
    takeAxisPins(number, settings == nullptr ? node : settings->contains("pins") ? *settings->get("pins") : node);
    if (settings != nullptr) takeAxisSettings(number, *settings);
  }
  void takeAxisPins(const std::string& axis, const toml::node& node) {
    if (isPinName(text::stringOf(node))) return add(Kind::Axis, axis, text::stringOf(node), node);
    reading_.wrong(node, "devices.axes." + axis,
                   "what the names of its pins begin with: letters, digits, '-', '_' and '.'",
                   axis + " = \"table\", or " + axis + " = { pins = \"table\", FeedRT = 6000 }");
  }
  void takeAxisSettings(const std::string& axis, const toml::table& table) {
    for (const auto& [key, value] : text::inFileOrder(table)) {
      const std::string name = axis + "." + std::string(key->str());
      if (key->str() != "pins") takeSetting("axis." + name, "devices.axes." + name, *value, "FeedRT = 6000");
    }
  }
  bool takeSharedFile(const toml::node& node, File&) {
    if (text::stringOf(node).empty()) return false;
    add(Kind::SharedFile, "", beside(text::stringOf(node)), node);
    return true;
  }
  bool takeConfig(const toml::node& node, File&) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    for (const auto& [key, value] : text::inFileOrder(*table))
      takeSetting(std::string(key->str()), "devices.config." + std::string(key->str()), *value,
                  "\"COM[1].ComSpeed\" = 19200");
    return true;
  }
  // Adds a key of the configuration; `where` is its place in the file, for messages.
  void takeSetting(const std::string& name, const std::string& where, const toml::node& value,
                   std::string_view example) {
    const auto setting = settingOf(value);
    if (!setting) return reading_.wrong(value, where, "a text or a number", example);
    add(Kind::Config, name, namesFile(name) ? beside(*setting) : *setting, value);
  }

  void add(Kind kind, std::string_view key, std::string value, const toml::node& node) {
    map_.devices.push_back({kind, std::string(key), std::move(value), reading_.positionOf(node)});
  }
  // A path relative to the folder of the file that is being read.
  std::string beside(const std::string& path) const { return host::beside(map_.paths[reading_.file()], path); }

  Reading& reading_;
  File& map_;
};

const text::TomlKey<DeviceReader, File> DeviceReader::kKeys[] = {
    {"can", false, "a table of channels and interfaces", "can = { 2 = \"can0\" }", &DeviceReader::takeCan},
    {"com", false, "a table of ports and devices", "com = { 1 = \"/dev/ttyUSB0\" }", &DeviceReader::takeCom},
    {"axes", false, "a table of axes and their pins", "axes = { 4 = \"table\" }", &DeviceReader::takeAxes},
    {"sa-file", false, "the path of a file", "sa-file = \"/dev/shm/areas\"", &DeviceReader::takeSharedFile},
    {"config", false, "a table of keys and values", "config = { \"COM[1].ComSpeed\" = 19200 }",
     &DeviceReader::takeConfig},
};

} // namespace

bool readDevices(Reading& reading, const toml::node& node, File& map) {
  const toml::table* table = node.as_table();
  if (table != nullptr) DeviceReader(reading, map).read(*table);
  return table != nullptr;
}

void refuseAxes(const File& map, std::string_view host, std::vector<std::string>& errors) {
  for (const DeviceSetting& setting : map.devices)
    if (setting.kind == Kind::Axis)
      errors.push_back(map.message(setting.at, "devices.axes: found axis " + setting.key + ", expected none in " +
                                                   std::string(host) + "; remove it"));
}

} // namespace rung::host
