// See mapping_reading.h.
#include "machine/host/mapping_reading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace rung::host {
namespace {

constexpr int64_t kLeast = std::numeric_limits<int32_t>::min(); // of integers
constexpr int64_t kMost = std::numeric_limits<uint32_t>::max();

} // namespace

std::string beside(const std::string& path, const std::string& included) {
  const size_t slash = path.rfind('/');
  return included.starts_with('/') || slash == std::string::npos ? included : path.substr(0, slash + 1) + included;
}

bool isPinName(std::string_view word) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  return !word.empty() && word.find_first_not_of(kAllowed) == std::string_view::npos;
}

std::string Reading::lineOf(text::Position at) const {
  return "line " + std::to_string(at.line) + (at.file == file() ? "" : " of " + map_.paths[at.file]);
}

std::vector<std::string> Reading::errors() const {
  std::vector<text::TomlMistake> sorted = mistakes();
  std::ranges::stable_sort(sorted, std::less(), &text::TomlMistake::at);
  std::vector<std::string> texts;
  for (const text::TomlMistake& mistake : sorted) texts.push_back(map_.message(mistake.at, mistake.text()));
  return texts;
}

std::optional<Number> Reading::numberWithType(const toml::node& node) const {
  Number number{.found = text::textOf(node), .at = positionOf(node)};
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
