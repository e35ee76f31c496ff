// Reads TOML files by tables of keys, and reports every error with its position. Hexadecimal numbers are written 0x20;
// 16#20, as in scenarios, is refused.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "rtlib/text/position.h"
#include "rtlib/text/similar.h"

namespace rung::text {

// A value as written in a file; for tables and lists their kind.
std::string textOf(const toml::node& node);
// "" if the value is not a text.
std::string stringOf(const toml::node& node);
// The value of a number or integer; nothing if it is not a finite number.
std::optional<double> numberOf(const toml::node& node);

// toml++ keeps the keys of a table sorted by name.
using TomlEntry = std::pair<const toml::key*, const toml::node*>;
std::vector<TomlEntry> inFileOrder(const toml::table& table);

// A key of a table that is read into a Row; the reader's `take` returns false if the value is not as expected.
template <class Reader, class Row>
struct TomlKey {
  std::string_view name;
  bool needed = false;
  std::string_view expected;
  std::string_view example;
  bool (Reader::*take)(const toml::node&, Row&) = nullptr;
};

struct TomlMistake {
  enum class Kind : uint8_t {
    Syntax,     // `found`: the text that is not TOML
    UnknownKey, // `found`: the key; `expected`: all keys
    MissingKey, // `found`: the key
    Value,
    Other, // `found`: the message
  };
  Kind kind = Kind::Other;
  Position at;
  Position end;
  std::string where = {}; // the key with the tables that it is in; "" for the file
  std::string found;
  std::string expected = {};
  std::string example = {};
  Likely meant = {}; // for an unknown key

  std::string text() const;
};

// The reading of one or several files, with the errors found so far.
class TomlReading {
public:
  // The index of the current file, for positions.
  uint32_t file() const { return file_; }
  void setFile(uint32_t file) { file_ = file; }

  // Nothing: the text is not TOML, which is recorded as a mistake. (The parser follows the parts of a key by recursion:
  // a key of a hundred thousand parts would overflow the stack, and is refused before.)
  std::optional<toml::table> parse(std::string_view text);

  Position positionOf(const toml::source_region& region) const {
    return {region.begin.line, region.begin.column, file_};
  }
  Position positionOf(const toml::node& node) const { return positionOf(node.source()); }

  void fail(Position at, std::string message) {
    mistakes_.push_back({.at = at, .end = at, .found = std::move(message)});
  }
  // Records that the value of a key is not as expected.
  void wrong(const toml::node& node, std::string_view where, std::string_view expected, std::string_view example) {
    wrong(node.source(), where, textOf(node), expected, example);
  }
  void wrong(const toml::source_region& at, std::string_view where, std::string found, std::string_view expected,
             std::string_view example);

  // In the order in which they were found.
  const std::vector<TomlMistake>& mistakes() const { return mistakes_; }

  // Reads a table by its keys; `where` is its name in messages, "" for the file. False: there were mistakes.
  template <class Reader, class Row, size_t N>
  bool readKeys(Reader& reader, const toml::table& table, std::string_view where, const TomlKey<Reader, Row> (&keys)[N],
                Row& row) {
    const size_t before = mistakes_.size();
    const std::string prefix = where.empty() ? "" : std::string(where) + ".";
    std::vector<std::string_view> names;
    for (const auto& key : keys) names.push_back(key.name);
    for (const auto& [key, node] : inFileOrder(table)) {
      const auto known = std::ranges::find(keys, key->str(), &TomlKey<Reader, Row>::name);
      if (known == std::end(keys))
        unknownKey(*key, where, names);
      else if (!(reader.*known->take)(*node, row))
        wrong(*node, prefix + std::string(known->name), known->expected, known->example);
    }
    for (const auto& key : keys)
      if (key.needed && !table.contains(key.name) && !isMisspelt(key.name, table, names))
        missingKey(key.name, table, where, key.expected, key.example);
    return mistakes_.size() == before;
  }

private:
  void add(TomlMistake::Kind kind, const toml::source_region& at, std::string_view where, std::string found,
           std::string_view expected, std::string_view example);
  void unknownKey(const toml::key& key, std::string_view where, const std::vector<std::string_view>& known);
  void missingKey(std::string_view name, const toml::table& table, std::string_view where, std::string_view expected,
                  std::string_view example);
  // Whether an unknown key of the table may mean `name`, so that only the unknown key is reported.
  static bool isMisspelt(std::string_view name, const toml::table& table, const std::vector<std::string_view>& known);

  uint32_t file_ = 0;
  std::vector<TomlMistake> mistakes_;
};

} // namespace rung::text
