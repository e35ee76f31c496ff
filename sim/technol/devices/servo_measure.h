// How the increments of a servo count: attributes of the element Servo (TECHNOL manual, l.8547-8573, l.10150-10191).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace rung::sim::technol {

class ServoMeasure {
public:
  // ServoType, MeasConstNumerator, MeasConstDenominator, in any case. "" or what is wrong.
  std::string set(std::string_view name, std::string_view value);
  static bool has(std::string_view name);

  // Increments a micrometre (1/1000 degree). In the trajectory mode (ServoType 28, 29) they are micrometres * 65536 *
  // numerator / denominator, else increments * numerator / denominator are micrometres; without both they are equal. A
  // constant of 0 is not given, a negative one turns the direction.
  double incrementsPerMicrometre() const { return incrementsPerMicrometre_; }

private:
  double computed() const;

  static constexpr int32_t kTrajectoryCoe = 28, kTrajectorySoe = 29;
  int32_t type_ = 0, numerator_ = 0, denominator_ = 0;
  double incrementsPerMicrometre_ = 1; // scans need it
};

} // namespace rung::sim::technol
