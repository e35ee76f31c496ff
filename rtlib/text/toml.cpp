// See toml.h.
#include "rtlib/text/toml.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "rtlib/text/controls.h"
#include "rtlib/text/end_of_file.h"
#include "rtlib/text/utf8.h"

namespace rung::text {
namespace {

constexpr size_t kMostParts = 64; // of a key

// The position after the string that begins at `at`.
size_t endOfString(std::string_view text, size_t at) {
  const std::string_view quote = text.substr(at, 1), longQuote = text.substr(at, 3);
  const bool isLong = longQuote.size() == 3 && longQuote[1] == quote[0] && longQuote[2] == quote[0];
  const std::string_view end = isLong ? longQuote : quote;
  for (at += end.size(); at < text.size() && text.substr(at, end.size()) != end; ++at) {
    if (!isLong && text[at] == '\n') return at; // it is not terminated, which the parser reports
    if (quote == "\"" && text[at] == '\\') ++at;
  }
  return at + end.size();
}

// Text that the parser must not get, or would accept although it is wrong; null text: none.
struct Refused {
  size_t at = 0;
  const char* text = nullptr;
};

// Finds such text; the parser would read 16#20 as 16 and a comment.
Refused findRefused(std::string_view text) {
  static_assert(kMostParts == 64, "as the sentence says");
  size_t parts = 1;
  for (size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = endOfString(text, at);
      continue;
    }
    const bool afterDigit = at > 0 && text[at - 1] >= '0' && text[at - 1] <= '9';
    if (c == '#' && afterDigit) return {at, "# begins a comment: write 0x20 for 16#20, or a blank before the comment"};
    if (c == '#') at = std::min(text.find('\n', at), text.size() - 1);
    if (std::string_view("=,{}[]\n#").find(c) != std::string_view::npos) parts = 1;
    if (c == '.' && ++parts > kMostParts) return {at, "a key has more than 64 parts"};
    ++at;
  }
  return {};
}

constexpr const char* kControl = "a key or a text holds a control character, which names, paths and messages cannot";

bool isRefused(char c) { return isControl(c) && c != '\t' && c != '\n' && c != '\r'; }

// The first key or text, in the order of the tables, that has a control character by an escape such as \u0000; null:
// none.
const toml::source_region* findControl(const toml::node& node) {
  if (const auto* text = node.as_string())
    return std::ranges::any_of(text->get(), isRefused) ? &node.source() : nullptr;
  if (const toml::array* list = node.as_array())
    for (const toml::node& element : *list)
      if (const toml::source_region* found = findControl(element)) return found;
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table) {
      if (std::ranges::any_of(key.str(), isRefused)) return &key.source();
      if (const toml::source_region* found = findControl(value)) return found;
    }
  return nullptr;
}

toml::source_region regionAt(std::string_view text, size_t offset) {
  toml::source_position place{1, 1};
  for (const char c : text.substr(0, offset)) {
    if (!isUtf8Continuation(c)) ++place.column;
    if (c == '\n') place = {place.line + 1, 1};
  }
  return {place, place, nullptr};
}

} // namespace

std::string textOf(const toml::node& node) {
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

std::string stringOf(const toml::node& node) { return node.value_exact<std::string>().value_or(""); }

std::optional<double> numberOf(const toml::node& node) {
  if (const auto integer = node.value_exact<int64_t>()) return static_cast<double>(*integer);
  if (const auto real = node.value_exact<double>(); real && std::isfinite(*real)) return real;
  return std::nullopt;
}

std::vector<TomlEntry> inFileOrder(const toml::table& table) {
  std::vector<TomlEntry> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::ranges::sort(entries, {}, [](const TomlEntry& entry) {
    const toml::source_position& begin = entry.first->source().begin;
    return std::pair(begin.line, begin.column);
  });
  return entries;
}

std::string TomlMistake::text() const {
  const std::string what = (where.empty() ? "the file" : where) + ": found ";
  const std::string wanted = ", expected " + expected;
  switch (kind) {
  case Kind::Syntax: return found + "; the file must be TOML; the rest is checked once this is corrected";
  case Kind::UnknownKey: return what + "an unknown key " + found + wanted + didYouMean(meant.word);
  case Kind::MissingKey: return what + "no key " + found + wanted + "; write for example " + example;
  case Kind::Value: return what + found + wanted + "; write for example " + example;
  case Kind::Other: break;
  }
  return found;
}

std::optional<toml::table> TomlReading::parse(std::string_view text) {
  text = upToEndOfFile(text);
  const auto notToml = [this](const toml::source_region& at, std::string_view why) {
    add(TomlMistake::Kind::Syntax, at, "", std::string(why), "", "");
  };
  if (const Refused refused = findRefused(text); refused.text != nullptr) {
    notToml(regionAt(text, refused.at), refused.text);
    return std::nullopt;
  }
  try {
    toml::table table = toml::parse(text);
    const toml::source_region* control = findControl(table);
    if (control == nullptr) return table;
    notToml(*control, kControl);
    return std::nullopt;
  } catch (const toml::parse_error& error) {
    notToml(error.source(), error.description());
    return std::nullopt;
  }
}

void TomlReading::add(TomlMistake::Kind kind, const toml::source_region& at, std::string_view where, std::string found,
                      std::string_view expected, std::string_view example) {
  mistakes_.push_back({.kind = kind,
                       .at = positionOf(at),
                       .end = {at.end.line, at.end.column, file_},
                       .where = std::string(where),
                       .found = std::move(found),
                       .expected = std::string(expected),
                       .example = std::string(example)});
}

void TomlReading::wrong(const toml::source_region& at, std::string_view where, std::string found,
                        std::string_view expected, std::string_view example) {
  add(TomlMistake::Kind::Value, at, where, std::move(found), expected, example);
}

void TomlReading::unknownKey(const toml::key& key, std::string_view where, const std::vector<std::string_view>& known) {
  std::string all;
  for (const std::string_view name : known) all += (all.empty() ? "" : ", ") + std::string(name);
  add(TomlMistake::Kind::UnknownKey, key.source(), where, std::string(key.str()), all, "");
  mistakes_.back().meant = likeliest(key.str(), known);
}

void TomlReading::missingKey(std::string_view name, const toml::table& table, std::string_view where,
                             std::string_view expected, std::string_view example) {
  add(TomlMistake::Kind::MissingKey, table.source(), where, std::string(name), expected, example);
}

bool TomlReading::isMisspelt(std::string_view name, const toml::table& table,
                             const std::vector<std::string_view>& known) {
  return std::ranges::any_of(table, [&](const auto& entry) {
    const std::string_view key = entry.first.str();
    return std::ranges::find(known, key) == known.end() && mostSimilar(key, known) == name;
  });
}

} // namespace rung::text
