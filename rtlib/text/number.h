// Reads numbers from text. Nothing here allocates.
#pragma once
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace rung::text {

// Removes a number from the beginning of the text and returns it. Nothing, and the text stays unchanged, if it does not
// begin with a number in the range of T. `format` as in std::from_chars: the base of an integer, the notation of a
// real.
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

// ---- numbers as users write them ---------------------------------------------------------------------------------

// -25, 0x1F, 16#1F, 0b101, 2#101, 8#17 and 1_000 are whole; 1.5, -2e3, inf and nan are real.
enum class NumberForm : uint8_t {
  None,       // not a number
  Whole,      // -2^63 to 2^64 - 1
  Real,       // a double: written with a point, an exponent, or as inf or nan
  TooLong,    // whole and decimal, but beyond 64 bits: fits in a real, not in an integer
  OutOfRange, // fits in no cell: too large for a double, so small that it would become 0, more than 64 bits
};

struct WrittenNumber {
  NumberForm form = NumberForm::None;
  bool negative = false;  // of a whole number
  uint64_t magnitude = 0; // of a whole number
  double real = 0;        // of a number that fits in a double
  // The 64 bits of a whole number.
  uint64_t bits() const { return negative ? 0 - magnitude : magnitude; }
};

namespace detail {

// Removes a prefix such as 0x or 16#, and returns the base.
inline uint32_t takeBase(std::string_view& digits) {
  struct Prefix {
    std::string_view text;
    uint32_t base;
  };
  for (const Prefix prefix : {Prefix{"0x", 16}, Prefix{"0X", 16}, Prefix{"0b", 2}, Prefix{"0B", 2}, Prefix{"16#", 16},
                              Prefix{"8#", 8}, Prefix{"2#", 2}}) {
    if (!digits.starts_with(prefix.text)) continue;
    digits.remove_prefix(prefix.text.size());
    return prefix.base;
  }
  return 10;
}

inline uint32_t digitOf(char c) {
  if (c >= '0' && c <= '9') return static_cast<uint32_t>(c - '0');
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? static_cast<uint32_t>(lower - 'a') + 10 : UINT32_MAX;
}

// Digits with single underscores between them.
inline NumberForm readDigits(std::string_view digits, uint32_t base, uint64_t& magnitude) {
  bool fits = !digits.empty();
  bool afterDigit = false;
  for (const char c : digits) {
    const uint32_t digit = digitOf(c);
    const bool between = c == '_' && afterDigit;
    if (!between && digit >= base) return NumberForm::None;
    afterDigit = !between;
    if (between) continue;
    fits = fits && magnitude <= (UINT64_MAX - digit) / base;
    magnitude = magnitude * base + digit;
  }
  if (!afterDigit) return NumberForm::None;
  return fits ? NumberForm::Whole : NumberForm::OutOfRange;
}

inline NumberForm readReal(std::string_view digits, double& real) {
  if (digits.starts_with('-')) return NumberForm::None; // a sign was read before
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), real);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return NumberForm::None;
  const std::string_view mantissa = digits.substr(0, digits.find_first_of("eE"));
  const bool vanished = real == 0 && mantissa.find_first_of("123456789") != std::string_view::npos;
  return error != std::errc() || vanished ? NumberForm::OutOfRange : NumberForm::Real;
}

} // namespace detail

// The number that the whole text is.
inline WrittenNumber writtenNumber(std::string_view text) {
  constexpr uint64_t kMostNegative = uint64_t{1} << 63;
  WrittenNumber number;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  std::string_view digits = text;
  const uint32_t base = detail::takeBase(digits);
  number.form = detail::readDigits(digits, base, number.magnitude);
  if (number.form == NumberForm::Whole && negative && number.magnitude > kMostNegative)
    number.form = NumberForm::OutOfRange;
  if (number.form == NumberForm::Whole) {
    number.negative = negative && number.magnitude != 0;
    number.real = static_cast<double>(number.magnitude);
  } else if (number.form == NumberForm::None) {
    number.form = detail::readReal(text, number.real);
  } else if (base == 10 && detail::readReal(text, number.real) == NumberForm::Real) {
    number.form = NumberForm::TooLong;
  }
  if (negative) number.real = -number.real;
  return number;
}

// The whole number that the text is, if it fits in T.
template <class T>
std::optional<T> wholeIn(std::string_view text) {
  const WrittenNumber number = writtenNumber(text);
  if (number.form != NumberForm::Whole) return std::nullopt;
  const bool fits = number.negative
                        ? std::cmp_greater_equal(static_cast<int64_t>(number.bits()), std::numeric_limits<T>::min())
                        : std::cmp_less_equal(number.magnitude, std::numeric_limits<T>::max());
  return fits ? std::optional(static_cast<T>(number.bits())) : std::nullopt;
}

// The finite number, whole or real, that the text is.
inline std::optional<double> realIn(std::string_view text) {
  const WrittenNumber number = writtenNumber(text);
  const bool isNumber = number.form != NumberForm::None && number.form != NumberForm::OutOfRange;
  return isNumber && std::isfinite(number.real) ? std::optional(number.real) : std::nullopt;
}

// Whether the number fits in a signed or unsigned integer of `bits` bits, 1 to 64; a bit holds only 0 and 1.
inline bool fitsBits(const WrittenNumber& number, uint32_t bits) {
  if (number.form != NumberForm::Whole) return false;
  if (number.negative) return bits > 1 && number.magnitude <= uint64_t{1} << (bits - 1);
  return bits >= 64 || number.magnitude >> bits == 0;
}

} // namespace rung::text
