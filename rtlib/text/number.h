// Numbers that a text holds. Nothing allocates.
#pragma once
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace rung::text {

// The number that the text begins with, which loses it; without one, or out of the range of T, nothing, and the text
// stays as it is. `format` as std::from_chars takes it: the base of an integer, the notation of a real.
template <class T, class... Format>
std::optional<T> takeNumber(std::string_view& text, Format... format) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, format...);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return value;
}

// The number that is the whole text.
template <class T, class... Format>
std::optional<T> numberIn(std::string_view text, Format... format) {
  const std::optional<T> value = takeNumber<T>(text, format...);
  return text.empty() ? value : std::nullopt;
}

// A finite one: 12, -0.5, 1e3.
inline std::optional<double> realIn(std::string_view text) {
  const std::optional<double> value = numberIn<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

} // namespace rung::text
