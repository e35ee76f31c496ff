// See file.h.
#include "tools/bind/file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <toml++/toml.h>

#include "rtlib/text/similar.h"
#include "rtlib/text/toml.h"

namespace rung::bind {
namespace {

Position positionOf(const toml::source_region& region) { return {region.begin.line, region.begin.column}; }

std::string shown(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return "\"" + *text + "\"";
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  if (const auto number = node.value<double>()) return fmt::format("{}", *number);
  return "another value";
}

using KeyAndNode = std::pair<const toml::key*, const toml::node*>;

// toml++ keeps the keys of a table sorted by name.
std::vector<KeyAndNode> inFileOrder(const toml::table& table) {
  std::vector<KeyAndNode> all;
  for (const auto& [key, node] : table) all.emplace_back(&key, &node);
  std::ranges::sort(all, {}, [](const KeyAndNode& one) {
    const Position at = positionOf(one.first->source());
    return std::pair(at.line, at.column);
  });
  return all;
}

class Reader {
public:
  Reader(File& file, std::vector<Error>& errors) : file_(file), errors_(errors) {}

  void read(const toml::table& all) {
    for (const auto& [key, node] : inFileOrder(all)) {
      const toml::table* table = node->as_table();
      const bool known = key->str() == "in" || key->str() == "out" || key->str() == "counters";
      if (!known)
        unknown(*key, "the file", {"in", "out", "counters"});
      else if (table == nullptr)
        wrong(*node, std::string(key->str()), "a table", fmt::format("[{}]", key->str()));
      else if (key->str() == "counters")
        readCounters(*table);
      else
        readMembers(*table, key->str() == "in", "");
    }
  }

private:
  void fail(Position at, std::string text) { errors_.push_back({at, std::move(text)}); }
  void wrong(const toml::node& node, const std::string& where, std::string_view expected, std::string_view example) {
    fail(positionOf(node.source()),
         fmt::format("{}: found {}, expected {}; write for example {}", where, shown(node), expected, example));
  }
  void unknown(const toml::key& key, std::string_view where, std::initializer_list<std::string_view> known) {
    fail(positionOf(key.source()),
         fmt::format("{}: found an unknown key {}, expected {}{}", where, key.str(), fmt::join(known, ", "),
                     text::didYouMean(text::mostSimilar(key.str(), known))));
  }

  // axis.position = … is a key of a table `axis`; { … } says more of one member.
  void readMembers(const toml::table& table, bool input, const std::string& before) {
    for (const auto& [key, node] : inFileOrder(table)) {
      const std::string member = before + std::string(key->str());
      const toml::table* inner = node->as_table();
      if (inner != nullptr && !inner->is_inline())
        readMembers(*inner, input, member + ".");
      else
        readMember({.input = input, .member = member, .name = {}, .at = positionOf(key->source())}, *node);
    }
  }

  void readMember(Entry entry, const toml::node& node) {
    const std::string where = (entry.input ? "in." : "out.") + entry.member;
    const size_t before = errors_.size();
    if (const toml::table* table = node.as_table())
      readKeys(*table, where, entry);
    else
      entry.name = node.value_exact<std::string>().value_or("");
    if (errors_.size() != before) return;
    if (entry.name.empty())
      return wrong(node, where, "a name of the program", fmt::format("{} = \"X0.0\"", entry.member));
    file_.entries.push_back(std::move(entry));
  }

  void readKeys(const toml::table& table, const std::string& where, Entry& entry) {
    for (const auto& [key, node] : inFileOrder(table)) {
      if (key->str() == "name") {
        entry.name = node->value_exact<std::string>().value_or("");
      } else if (key->str() == "scale") {
        entry.scale = node->value<double>().value_or(0);
        if (entry.scale == 0 || !std::isfinite(entry.scale))
          wrong(*node, where + ".scale", "a number other than 0", "scale = 1000");
      } else if (key->str() == "cut") {
        entry.cut = node->value_exact<bool>().value_or(false);
        if (!node->is_boolean()) wrong(*node, where + ".cut", "true or false", "cut = true");
      } else {
        unknown(*key, where, {"name", "scale", "cut"});
      }
    }
  }

  void readCounters(const toml::table& table) {
    for (const auto& [key, node] : inFileOrder(table)) {
      if (key->str() != "head" && key->str() != "tail") {
        unknown(*key, "counters", {"head", "tail"});
        continue;
      }
      Counter counter{node->value_exact<std::string>().value_or(""), positionOf(node->source())};
      if (counter.member.empty())
        wrong(*node, fmt::format("counters.{}", key->str()), "a member of the struct", "head = \"head\"");
      else
        (key->str() == "head" ? file_.head : file_.tail) = std::move(counter);
    }
    if (!table.contains("head") || !table.contains("tail"))
      fail(positionOf(table.source()), "counters: found one of head and tail, expected both: the writer counts head up "
                                       "before it writes, and sets tail to it afterwards");
  }

  File& file_;
  std::vector<Error>& errors_;
};

} // namespace

File parse(std::string_view text, std::vector<Error>& errors) {
  File file;
  try {
    Reader(file, errors).read(text::parse(text));
  } catch (const toml::parse_error& error) {
    errors.push_back({positionOf(error.source()), fmt::format("{}; the file must be TOML; the rest is checked once "
                                                              "this is corrected",
                                                              error.description())});
  }
  return file;
}

} // namespace rung::bind
