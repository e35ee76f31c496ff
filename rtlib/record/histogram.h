// A histogram of bounded size: values below 64 are stored exactly, larger ones in 32 steps per octave (within 1.6 %).
// Adding allocates nothing.
#pragma once
#include <array>
#include <cstdint>

namespace rung::runtime {

class Histogram {
public:
  void add(uint64_t value) noexcept;

  uint64_t count() const { return count_; }
  uint64_t min() const { return count_ == 0 ? 0 : min_; }
  uint64_t max() const { return max_; }
  // The value below which the fraction `q` (0 to 1) of all values lies, interpolated within a step. 0 if there is no
  // value.
  double quantile(double q) const;
  // The mean without the largest hundredth of the values, at least one, to exclude values prolonged by interruptions. 0
  // if there is no value.
  double trimmedMean() const;

private:
  static constexpr uint32_t kExactBits = 6; // values of up to this many bits have a step each
  static constexpr uint32_t kExact = 1u << kExactBits;
  static constexpr uint32_t kStepBits = 5;
  static constexpr uint32_t kSteps = 1u << kStepBits; // of an octave
  static constexpr uint32_t kLastBits = 34;           // larger values are counted in the last step
  static constexpr uint32_t kSize = kExact + (kLastBits - kExactBits) * kSteps;

  static uint32_t stepOf(uint64_t value) noexcept;
  static double lowerEdge(uint32_t step);

  std::array<uint32_t, kSize> counts_{};
  uint64_t count_ = 0;
  uint64_t min_ = UINT64_MAX;
  uint64_t max_ = 0;
};

} // namespace rung::runtime
