// Numbers of the configuration (see values.h).
#include "rtlib/nc/control/technol/values.h"

#include "rtlib/text/blanks.h"
#include "rtlib/text/number.h"

namespace rung::nc::technol {

std::optional<int64_t> integerOf(std::string_view text) {
  const text::WrittenNumber number = text::writtenNumber(text::trimmed(text));
  if (number.form != text::NumberForm::Whole) return std::nullopt;
  return static_cast<int64_t>(number.bits());
}

std::optional<double> realOf(std::string_view text) { return text::realIn(text::trimmed(text)); }

} // namespace rung::nc::technol
