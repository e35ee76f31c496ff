// Increments of servos (see servo_measure.h).
#include "sim/technol/devices/servo_measure.h"

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::sim::technol {
namespace {

constexpr std::string_view kType = "ServoType", kNumerator = "MeasConstNumerator",
                           kDenominator = "MeasConstDenominator";

} // namespace

bool ServoMeasure::has(std::string_view name) {
  return text::equalsIgnoringCase(name, kType) || text::equalsIgnoringCase(name, kNumerator) ||
         text::equalsIgnoringCase(name, kDenominator);
}

std::string ServoMeasure::set(std::string_view name, std::string_view value) {
  if (!has(name))
    return "a servo has ServoType, MeasConstNumerator and MeasConstDenominator, not '" + std::string(name) + "'";
  const auto number = text::wholeIn<int32_t>(value);
  if (!number) return "'" + std::string(name) + "' needs a whole number; found '" + std::string(value) + "'";
  const bool isType = text::equalsIgnoringCase(name, kType);
  int32_t& place = isType ? type_ : text::equalsIgnoringCase(name, kNumerator) ? numerator_ : denominator_;
  place = *number;
  incrementsPerMicrometre_ = computed();
  return {};
}

double ServoMeasure::computed() const {
  if (numerator_ == 0 && denominator_ == 0) return 1;
  const double numerator = numerator_ == 0 ? 1 : numerator_, denominator = denominator_ == 0 ? 1 : denominator_;
  const bool isTrajectory = type_ == kTrajectoryCoe || type_ == kTrajectorySoe;
  return isTrajectory ? 65536 * numerator / denominator : denominator / numerator;
}

} // namespace rung::sim::technol
