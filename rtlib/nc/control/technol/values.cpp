// Numbers of the configuration (see values.h).
#include "rtlib/nc/control/technol/values.h"

#include <charconv>
#include <cmath>

namespace rung::nc::technol {
namespace {

template <class T, class... Base>
std::optional<T> parsed(std::string_view text, Base... base) {
  T value{};
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
  if (error != std::errc() || at != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string_view withoutPlus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return plus ? text.substr(1) : text;
}

} // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::optional<int64_t> integerOf(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with("0x") || text.starts_with("0X")) {
    const auto bits = parsed<uint64_t>(text.substr(2), 16);
    return bits ? std::optional(static_cast<int64_t>(*bits)) : std::nullopt;
  }
  return parsed<int64_t>(withoutPlus(text), 10);
}

std::optional<double> realOf(std::string_view text) {
  const auto value = parsed<double>(withoutPlus(trimmed(text)));
  return value && std::isfinite(*value) ? value : std::nullopt;
}

} // namespace rung::nc::technol
