// Shared by the readers of a mapping file's tables: values of TOML, tables of keys, and errors with their places.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "machine/host/mapping_file.h"

namespace rung::host {

// A value as written in the file; for tables and lists their kind.
std::string shown(const toml::node& node);
// The text of a value; "" if it is not a text.
std::string textOf(const toml::node& node);
// The number of a value, which may be an integer; nothing if it is not a finite number.
std::optional<double> numberOf(const toml::node& node);
bool isPinName(std::string_view word);
// A path named in a file, relative to the folder of that file.
std::string beside(const std::string& path, const std::string& included);

// toml++ keeps the keys of a table sorted by name.
using Entry = std::pair<const toml::key*, const toml::node*>;
std::vector<Entry> inFileOrder(const toml::table& table);

struct Place { // of a value
  std::string text;
  Position at;
};

struct Number {
  double value = 0;
  PinType type = PinType::Float; // Bit: true or false; S32, U32: an integer
  std::string found;
  Position at;
};

// A key of a table that is read into a Row; `take`, a function of the reader, returns false if the value is not as
// expected.
template <class Reader, class Row>
struct Key {
  std::string_view name;
  bool needed = false;
  std::string_view expected;
  std::string_view example;
  bool (Reader::*take)(const toml::node&, Row&) = nullptr;
};

// The files of a map that are being read, and their errors.
class Reading {
public:
  explicit Reading(File& map) : map_(map) {}

  File& map() { return map_; }
  // The file that is being read, as an index of File::paths.
  uint32_t file() const { return file_; }
  void setFile(uint32_t file) { file_ = file; }

  Position positionOf(const toml::source_region& region) const {
    return {region.begin.line, region.begin.column, file_};
  }
  Position positionOf(const toml::node& node) const { return positionOf(node.source()); }
  // "line 5", with its file if that is another one.
  std::string lineOf(Position at) const;

  void fail(Position at, std::string what) { errors_.emplace_back(at, std::move(what)); }
  void wrong(Position at, const std::string& where, const std::string& found, std::string_view expected,
             std::string_view example);
  size_t mistakes() const { return errors_.size(); }
  // The errors, in the order of the files.
  std::vector<std::string> errors();

  // A number, of 32 bits if it is an integer; nothing if it is something else, or not finite.
  std::optional<Number> numberWithType(const toml::node& node) const;
  // Reports a value that does not fit the type: true or false for a bit, a number for the others, an integer if the
  // type has only integers.
  void checkNumber(const std::optional<Number>& number, PinType type, const std::string& where);

  // Reads a table by its keys; `where` is its name in messages, "" for the file. False: there were mistakes.
  template <class Reader, class Row, size_t N>
  bool readKeys(Reader& reader, const toml::table& table, std::string_view where, const Key<Reader, Row> (&keys)[N],
                Row& row) {
    const size_t before = mistakes();
    const std::string prefix = where.empty() ? "" : std::string(where) + ".";
    for (const auto& [key, node] : inFileOrder(table)) {
      const auto known = std::ranges::find(keys, key->str(), &Key<Reader, Row>::name);
      if (known == std::end(keys))
        unknownKey(*key, where, namesOf(keys));
      else if (!(reader.*known->take)(*node, row))
        wrong(positionOf(*node), prefix + std::string(known->name), shown(*node), known->expected, known->example);
    }
    for (const auto& key : keys)
      if (key.needed && !table.contains(key.name) && !isMisspelt(key.name, table, namesOf(keys)))
        wrong(positionOf(table), std::string(where), "no key " + std::string(key.name), key.expected, key.example);
    return mistakes() == before;
  }

private:
  template <class Keys>
  static std::vector<std::string_view> namesOf(const Keys& keys) {
    std::vector<std::string_view> names;
    for (const auto& key : keys) names.push_back(key.name);
    return names;
  }
  void unknownKey(const toml::key& key, std::string_view where, const std::vector<std::string_view>& known);
  // Whether an unknown key of the table is probably a misspelt `name`: that is reported once.
  static bool isMisspelt(std::string_view name, const toml::table& table, const std::vector<std::string_view>& known);

  File& map_;
  uint32_t file_ = 0;
  std::vector<std::pair<Position, std::string>> errors_;
};

} // namespace rung::host
