// See file.h.
#include "tools/bind/file.h"

#include <fmt/format.h>

#include "rtlib/text/toml.h"

namespace rung::bind {
namespace {

class Reader : public text::TomlReading {
public:
  File read(std::string_view text) {
    File file;
    if (const std::optional<toml::table> table = parse(text)) readKeys(*this, *table, "", kFileKeys, file);
    return file;
  }

private:
  template <class Row>
  using Key = text::TomlKey<Reader, Row>;

  static const Key<File> kFileKeys[3];
  static const Key<Entry> kEntryKeys[3];
  static const Key<File> kCounterKeys[2];

  bool takeInputs(const toml::node& node, File& file) { return takeMembers(node, true, file); }
  bool takeOutputs(const toml::node& node, File& file) { return takeMembers(node, false, file); }
  bool takeMembers(const toml::node& node, bool input, File& file) {
    const toml::table* table = node.as_table();
    if (table != nullptr) readMembers(*table, input, "", file);
    return table != nullptr;
  }

  // axis.position = … is a key of a table `axis`; { … } gives further properties of one member.
  void readMembers(const toml::table& table, bool input, const std::string& before, File& file) {
    for (const auto& [key, node] : text::inFileOrder(table)) {
      const std::string member = before + std::string(key->str());
      const toml::table* inner = node->as_table();
      if (inner != nullptr && !inner->is_inline())
        readMembers(*inner, input, member + ".", file);
      else
        readMember({.input = input, .member = member, .name = {}, .at = positionOf(key->source())}, *node, file);
    }
  }

  void readMember(Entry entry, const toml::node& node, File& file) {
    const std::string where = (entry.input ? "in." : "out.") + entry.member;
    const toml::table* table = node.as_table();
    if (table != nullptr ? readKeys(*this, *table, where, kEntryKeys, entry) : takeName(node, entry))
      file.entries.push_back(std::move(entry));
    else if (table == nullptr)
      wrong(node, where, kEntryKeys[0].expected, fmt::format("{} = \"X0.0\"", entry.member));
  }

  bool takeName(const toml::node& node, Entry& entry) {
    entry.name = text::stringOf(node);
    return !entry.name.empty();
  }
  bool takeScale(const toml::node& node, Entry& entry) {
    entry.scale = text::numberOf(node).value_or(0);
    return entry.scale != 0;
  }
  bool takeCut(const toml::node& node, Entry& entry) {
    entry.cut = node.value_exact<bool>().value_or(false);
    return node.is_boolean();
  }

  bool takeCounters(const toml::node& node, File& file) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    readKeys(*this, *table, "counters", kCounterKeys, file);
    if (!table->contains("head") || !table->contains("tail"))
      fail(positionOf(*table),
           "counters: found one of head and tail, expected both: the writer counts head up before it "
           "writes, and sets tail to it afterwards");
    return true;
  }
  bool takeHead(const toml::node& node, File& file) { return takeCounter(node, file.head); }
  bool takeTail(const toml::node& node, File& file) { return takeCounter(node, file.tail); }
  bool takeCounter(const toml::node& node, std::optional<Counter>& counter) {
    if (!text::stringOf(node).empty()) counter = {text::stringOf(node), positionOf(node)};
    return counter.has_value();
  }
};

const Reader::Key<File> Reader::kFileKeys[] = {
    {"in", false, "a table", "[in]", &Reader::takeInputs},
    {"out", false, "a table", "[out]", &Reader::takeOutputs},
    {"counters", false, "a table", "[counters]", &Reader::takeCounters},
};

const Reader::Key<Entry> Reader::kEntryKeys[] = {
    {"name", true, "a name of the program", "name = \"X0.0\"", &Reader::takeName},
    {"scale", false, "a number other than 0", "scale = 1000", &Reader::takeScale},
    {"cut", false, "true or false", "cut = true", &Reader::takeCut},
};

const Reader::Key<File> Reader::kCounterKeys[] = {
    {"head", false, "a member of the struct", "head = \"head\"", &Reader::takeHead},
    {"tail", false, "a member of the struct", "tail = \"tail\"", &Reader::takeTail},
};

} // namespace

File parse(std::string_view text, std::vector<Error>& errors) {
  Reader reader;
  File file = reader.read(text);
  for (const text::TomlMistake& mistake : reader.mistakes()) errors.push_back({mistake.at, mistake.text()});
  return file;
}

} // namespace rung::bind
