// Attributes of an axis by name.
#include "machine/io/axes/axis_attributes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::io {

namespace {

constexpr std::string_view kKey = "axis.";

enum class Takes : uint8_t { Any, Positive, NotNegative, Whole };

struct Attribute {
  std::string_view name;
  double AxisAttributes::* member;
  Takes takes;
  double least = 0, most = 0; // range of whole numbers
};

constexpr Attribute kAttributes[] = {
    {"RefMethod", &AxisAttributes::refMethod, Takes::Whole, 1, 15},
    {"RefViaPlc", &AxisAttributes::refViaPlc, Takes::Whole, 0, 1},
    {"RefSwitch", &AxisAttributes::refSwitch, Takes::Whole, 0, 2},
    {"SlowDownSwitch", &AxisAttributes::slowDownSwitch, Takes::Whole, 0, 1},
    {"InvertRefDirection", &AxisAttributes::invertRefDirection, Takes::Whole, 0, 1},
    {"RefSpeed", &AxisAttributes::refSpeed, Takes::Positive},
    {"RefSpeedLow", &AxisAttributes::refSpeedLow, Takes::Positive},
    {"MoveToPosAfterRef", &AxisAttributes::moveToPosAfterRef, Takes::Whole, 0, 2},
    {"PosAfterRef", &AxisAttributes::posAfterRef, Takes::Any},
    {"MachineNullPoint", &AxisAttributes::machineNullPoint, Takes::Any},
    {"FeedOvrDuringRef", &AxisAttributes::feedOvrDuringRef, Takes::Whole, 0, 1},
    {"NeedRef", &AxisAttributes::needRef, Takes::Whole, 0, 1},
    {"AutNeedRef", &AxisAttributes::autNeedRef, Takes::Whole, 0, 1},
    {"Acceleration", &AxisAttributes::acceleration, Takes::Positive},
    {"AccelerationRT", &AxisAttributes::accelerationRT, Takes::Positive},
    {"AccelerationEmergency", &AxisAttributes::accelerationEmergency, Takes::Positive},
    {"Feed", &AxisAttributes::feed, Takes::Positive},
    {"FeedRT", &AxisAttributes::feedRT, Takes::Positive},
    {"Rotary", &AxisAttributes::rotary, Takes::Whole, 0, 1},
    {"ZeroPulsePitch", &AxisAttributes::zeroPulsePitch, Takes::Positive},
    {"ZeroPulseAt", &AxisAttributes::zeroPulseAt, Takes::Any},
    {"Position", &AxisAttributes::position, Takes::Any},
    {"SpeedAt10V", &AxisAttributes::speedAt10V, Takes::NotNegative},
    {"ManEnable", &AxisAttributes::manEnable, Takes::Whole, 1, 2},
};

// Case does not matter, as in the other elements of the control's files.
const Attribute* find(std::string_view name) {
  const auto* const found =
      std::ranges::find_if(kAttributes, [&](const Attribute& row) { return text::equalsIgnoringCase(row.name, name); });
  return found == std::end(kAttributes) ? nullptr : found;
}

bool isMethod(double value) { return value == 1 || value == 5 || value >= 9; } // l.11475

bool fits(const Attribute& attribute, double value) {
  switch (attribute.takes) {
  case Takes::Any: return true;
  case Takes::Positive: return value > 0;
  case Takes::NotNegative: return value >= 0;
  case Takes::Whole: break;
  }
  if (attribute.member == &AxisAttributes::refMethod && !isMethod(value)) return false;
  return value == std::floor(value) && value >= attribute.least && value <= attribute.most;
}

std::string expectation(const Attribute& attribute) {
  if (attribute.member == &AxisAttributes::refMethod) return "1, 5 or 9 to 15";
  switch (attribute.takes) {
  case Takes::Any: return "a number";
  case Takes::Positive: return "a number above 0";
  case Takes::NotNegative: return "a number of at least 0";
  case Takes::Whole: break;
  }
  const auto whole = [](double value) { return std::to_string(static_cast<int>(value)); };
  return whole(attribute.least) + " to " + whole(attribute.most);
}

} // namespace

bool AxisAttributes::has(std::string_view name) { return find(name) != nullptr; }

std::string AxisAttributes::set(std::string_view name, std::string_view value) {
  const Attribute* const found = find(name);
  if (found == nullptr) return "an axis has no attribute '" + std::string(name) + "'";
  const auto number = text::realIn(value);
  const bool far = number && std::fabs(*number) > kFarthest;
  if (!number || far || !fits(*found, *number))
    return "'" + std::string(name) + "' needs " + (far ? "a number of -1e9 to 1e9" : expectation(*found)) +
           "; found '" + std::string(value) + "'";
  this->*found->member = *number;
  return {};
}

bool isAxisKey(std::string_view key) { return key.starts_with(kKey); }

std::string readAxisKey(std::string_view key, AxisKey& read) {
  std::string_view rest = key.substr(kKey.size());
  const auto number = text::takeNumber<uint32_t>(rest);
  if (!number || *number < 1 || *number > kMaxAxes || !rest.starts_with('.'))
    return "'" + std::string(key) + "' needs an axis from 1 to 16: axis.1.Feed";
  read = {.axis = *number, .attribute = rest.substr(1)};
  return {};
}

} // namespace rung::io
