// Texts of messages (see messages.h).
#include "rtlib/nc/nct/messages.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "rtlib/text/number.h"

namespace rung::nc::nct {
namespace {

constexpr int kMostDecimals = 20;
// A double: digits before the point, sign, point and decimals.
constexpr size_t kLongestNumber = 310 + 2 + kMostDecimals;

class Writer {
public:
  explicit Writer(std::span<char> out) : out_(out) {}
  void add(std::string_view text) { used_ += text.copy(out_.data() + used_, out_.size() - used_); }
  void add(const Placeholder& place, const rung_message& message) {
    char digits[kLongestNumber];
    const auto written = [&] {
      if (message.real == 0 && !place.real) return std::to_chars(digits, std::end(digits), message.value);
      const double value =
          message.real != 0 ? std::bit_cast<double>(message.value) : static_cast<double>(message.value);
      return std::to_chars(digits, std::end(digits), value, std::chars_format::fixed, place.decimals);
    }();
    add({digits, static_cast<size_t>(written.ptr - digits)});
  }
  size_t used() const { return used_; }

private:
  std::span<char> out_;
  size_t used_ = 0;
};

} // namespace

std::optional<Placeholder> readPlaceholder(std::string_view text) {
  const size_t end = text.find('}');
  if (!text.starts_with('{') || end == std::string_view::npos || end < 6) return std::nullopt;
  const char kind = text[1];
  if ((kind != '#' && kind != '*') || text.substr(2, 3) != "0:F") return std::nullopt;
  Placeholder place{.length = end + 1, .real = kind == '*'};
  const auto decimals = text::numberIn<decltype(place.decimals)>(text.substr(5, end - 5));
  if (!decimals || text[5] == '-') return std::nullopt;
  place.decimals = *decimals;
  if (place.decimals > (place.real ? kMostDecimals : 0)) return std::nullopt;
  return place;
}

size_t fillText(std::string_view text, const rung_message& message, std::span<char> out) {
  Writer writer(out);
  while (!text.empty()) {
    const size_t plain = std::min(text.find('{'), text.size());
    writer.add(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) break;
    const std::optional<Placeholder> place = readPlaceholder(text);
    if (place)
      writer.add(*place, message);
    else
      writer.add("{");
    text.remove_prefix(place ? place->length : 1);
  }
  return writer.used();
}

} // namespace rung::nc::nct
