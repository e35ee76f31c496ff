// See mapping_reading.h.
#include "machine/host/mapping_reading.h"

#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "rtlib/text/similar.h"

namespace rung::host {
namespace {

constexpr int64_t kLeast = std::numeric_limits<int32_t>::min(); // of integers
constexpr int64_t kMost = std::numeric_limits<uint32_t>::max();

} // namespace

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

std::string textOf(const toml::node& node) { return node.value_exact<std::string>().value_or(""); }

std::optional<double> numberOf(const toml::node& node) {
  if (const auto integer = node.value_exact<int64_t>()) return static_cast<double>(*integer);
  if (const auto real = node.value_exact<double>(); real && std::isfinite(*real)) return real;
  return std::nullopt;
}

std::string beside(const std::string& path, const std::string& included) {
  const size_t slash = path.rfind('/');
  return included.starts_with('/') || slash == std::string::npos ? included : path.substr(0, slash + 1) + included;
}

bool isPinName(std::string_view word) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  return !word.empty() && word.find_first_not_of(kAllowed) == std::string_view::npos;
}

std::vector<Entry> inFileOrder(const toml::table& table) {
  std::vector<Entry> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::ranges::sort(entries, {}, [](const Entry& entry) {
    const toml::source_position& begin = entry.first->source().begin;
    return std::pair(begin.line, begin.column);
  });
  return entries;
}

std::string Reading::lineOf(Position at) const {
  return "line " + std::to_string(at.line) + (at.file == file_ ? "" : " of " + map_.paths[at.file]);
}

void Reading::wrong(Position at, const std::string& where, const std::string& found, std::string_view expected,
                    std::string_view example) {
  fail(at, where + ": found " + found + ", expected " + std::string(expected) + "; write for example " +
               std::string(example));
}

void Reading::unknownKey(const toml::key& key, std::string_view where, const std::vector<std::string_view>& known) {
  std::string all;
  for (const std::string_view name : known) all += (all.empty() ? "" : ", ") + std::string(name);
  fail(positionOf(key.source()), (where.empty() ? "the file" : std::string(where)) + ": found an unknown key " +
                                     std::string(key.str()) + ", expected " + all +
                                     text::didYouMean(text::mostSimilar(key.str(), known)));
}

bool Reading::isMisspelt(std::string_view name, const toml::table& table, const std::vector<std::string_view>& known) {
  return std::ranges::any_of(table, [&](const auto& entry) {
    const std::string_view key = entry.first.str();
    return std::ranges::find(known, key) == known.end() && text::mostSimilar(key, known) == name;
  });
}

std::vector<std::string> Reading::errors() {
  std::ranges::stable_sort(errors_, {}, [](const auto& error) {
    const Position& at = error.first;
    return std::tuple(at.file, at.line, at.column);
  });
  std::vector<std::string> texts;
  for (const auto& [at, what] : errors_) texts.push_back(map_.message(at, what));
  return texts;
}

std::optional<Number> Reading::numberWithType(const toml::node& node) const {
  Number number{.found = shown(node), .at = positionOf(node)};
  if (const auto bit = node.value_exact<bool>()) {
    number.type = PinType::Bit;
    number.value = *bit ? 1 : 0;
    return number;
  }
  if (const auto integer = node.value_exact<int64_t>()) {
    number.type = *integer < 0 ? PinType::S32 : PinType::U32;
    number.value = static_cast<double>(*integer);
    return *integer >= kLeast && *integer <= kMost ? std::optional(number) : std::nullopt;
  }
  number.value = node.value_exact<double>().value_or(std::numeric_limits<double>::infinity());
  return std::isfinite(number.value) ? std::optional(number) : std::nullopt;
}

void Reading::checkNumber(const std::optional<Number>& number, PinType type, const std::string& where) {
  if (!number) return;
  const bool isBit = number->type == PinType::Bit;
  const bool isInteger = number->type == PinType::S32 || number->type == PinType::U32;
  const double least = type == PinType::S32 ? std::numeric_limits<int32_t>::min() : 0;
  const double most = type == PinType::S32 ? std::numeric_limits<int32_t>::max() : static_cast<double>(kMost);
  const auto wanted = [&](bool good, const std::string& expected) {
    if (good) return;
    fail(number->at, where + ": found " + number->found + ", expected " + expected + ", because the type is " +
                         std::string(pinTypeName(type)) + "; write such a value, or another type");
  };
  switch (type) {
  case PinType::Bit: return wanted(isBit, "true or false");
  case PinType::Float: return wanted(!isBit, "a number");
  case PinType::S32:
  case PinType::U32:
    return wanted(isInteger && number->value >= least && number->value <= most,
                  "an integer from " + std::to_string(static_cast<int64_t>(least)) + " to " +
                      std::to_string(static_cast<int64_t>(most)));
  }
}

} // namespace rung::host
