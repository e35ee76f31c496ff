// Numbers of the configuration (see values.h).
#include "rtlib/nc/control/technol/values.h"

#include "rtlib/text/blanks.h"
#include "rtlib/text/number.h"

namespace rung::nc::technol {
namespace {

std::string_view withoutPlus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return plus ? text.substr(1) : text;
}

} // namespace

std::optional<int64_t> integerOf(std::string_view text) {
  text = text::trimmed(text);
  if (text.starts_with("0x") || text.starts_with("0X")) {
    const auto bits = text::numberIn<uint64_t>(text.substr(2), 16);
    return bits ? std::optional(static_cast<int64_t>(*bits)) : std::nullopt;
  }
  return text::numberIn<int64_t>(withoutPlus(text), 10);
}

std::optional<double> realOf(std::string_view text) { return text::realIn(withoutPlus(text::trimmed(text))); }

} // namespace rung::nc::technol
