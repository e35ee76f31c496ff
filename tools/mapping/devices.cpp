// The table [devices] (see devices.h).
#include "tools/mapping/devices.h"

#include "rtlib/text/letters.h"

namespace rung::mapping {
namespace {

using Kind = DeviceSetting::Kind;

// A setting of the configuration is a text, a number, or true and false for 1 and 0; nothing: it is none of these.
std::optional<std::string> settingOf(const toml::node& node) {
  if (const auto truth = node.value_exact<bool>()) return *truth ? "1" : "0";
  if (node.is_string() || node.is_number()) return node.is_string() ? textOf(node) : shown(node);
  return std::nullopt;
}

// Those of the configuration that name a file: PlcTable3, PlcTableDef3.
bool namesFile(std::string_view key) {
  constexpr std::string_view kTables = "PlcTable";
  return key.size() > kTables.size() && text::equalsIgnoringCase(key.substr(0, kTables.size()), kTables);
}

class DeviceReader {
public:
  DeviceReader(Reading& reading, File& map) : reading_(reading), map_(map) {}

  void read(const toml::table& table) { reading_.readKeys(*this, table, "devices", kKeys, map_); }

private:
  static const Key<DeviceReader, File> kKeys[4];

  bool takeCan(const toml::node& node, File&) { return takeNames(node, Kind::Can, "devices.can", "2 = \"can0\""); }
  bool takeCom(const toml::node& node, File&) {
    return takeNames(node, Kind::Com, "devices.com", "1 = \"/dev/ttyUSB0\"");
  }
  bool takeNames(const toml::node& node, Kind kind, const std::string& where, std::string_view example) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    for (const auto& [key, value] : inFileOrder(*table)) {
      const std::string device = textOf(*value);
      if (device.empty())
        reading_.wrong(reading_.positionOf(*value), where + "." + std::string(key->str()), shown(*value),
                       "the name of a device", example);
      else
        add(kind, key->str(), device, *value);
    }
    return true;
  }
  bool takeSharedFile(const toml::node& node, File&) {
    if (textOf(node).empty()) return false;
    add(Kind::SharedFile, "", beside(textOf(node)), node);
    return true;
  }
  bool takeConfig(const toml::node& node, File&) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    for (const auto& [key, value] : inFileOrder(*table)) {
      const std::string name(key->str());
      const auto setting = settingOf(*value);
      if (!setting)
        reading_.wrong(reading_.positionOf(*value), "devices.config." + name, shown(*value), "a text or a number",
                       "\"COM[1].ComSpeed\" = 19200");
      else
        add(Kind::Config, name, namesFile(name) ? beside(*setting) : *setting, *value);
    }
    return true;
  }

  void add(Kind kind, std::string_view key, std::string value, const toml::node& node) {
    map_.devices.push_back({kind, std::string(key), std::move(value), reading_.positionOf(node)});
  }
  // A path in the file that is read, from its folder.
  std::string beside(const std::string& path) const { return mapping::beside(map_.paths[reading_.file()], path); }

  Reading& reading_;
  File& map_;
};

const Key<DeviceReader, File> DeviceReader::kKeys[] = {
    {"can", false, "a table of channels and interfaces", "can = { 2 = \"can0\" }", &DeviceReader::takeCan},
    {"com", false, "a table of ports and devices", "com = { 1 = \"/dev/ttyUSB0\" }", &DeviceReader::takeCom},
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

} // namespace rung::mapping
