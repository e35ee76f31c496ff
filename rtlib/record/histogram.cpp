// Steps and quantiles (see histogram.h).
#include "rtlib/record/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rung::runtime {

uint32_t Histogram::stepOf(uint64_t value) noexcept {
  if (value < kExact) return static_cast<uint32_t>(value);
  const auto bits = static_cast<uint32_t>(std::bit_width(value));
  if (bits > kLastBits) return kSize - 1;
  const auto inOctave = static_cast<uint32_t>(value >> (bits - 1 - kStepBits)) - kSteps;
  return kExact + (bits - 1 - kExactBits) * kSteps + inOctave;
}

// A value v fills the step from v - 0.5 to v + 0.5.
double Histogram::lowerEdge(uint32_t step) {
  if (step < kExact) return step - 0.5;
  const uint32_t octave = (step - kExact) / kSteps;
  const uint32_t inOctave = (step - kExact) % kSteps;
  return std::ldexp(kSteps + inOctave, static_cast<int>(octave + kExactBits - kStepBits)) - 0.5;
}

void Histogram::add(uint64_t value) noexcept {
  ++counts_[stepOf(value)];
  ++count_;
  min_ = std::min(min_, value);
  max_ = std::max(max_, value);
}

double Histogram::quantile(double q) const {
  if (count_ == 0) return 0;
  const double wanted = q * static_cast<double>(count_);
  double below = 0;
  for (uint32_t step = 0; step < kSize; ++step) {
    if (counts_[step] == 0) continue;
    if (below + counts_[step] < wanted) {
      below += counts_[step];
      continue;
    }
    const double from = lowerEdge(step);
    const double value = from + (lowerEdge(step + 1) - from) * (wanted - below) / counts_[step];
    return std::clamp(value, static_cast<double>(min_), static_cast<double>(max_));
  }
  return static_cast<double>(max_);
}

double Histogram::trimmedMean() const {
  if (count_ <= 1) return static_cast<double>(max_);
  const uint64_t kept = count_ - std::max<uint64_t>(1, count_ / 100);
  double sum = 0;
  uint64_t seen = 0;
  for (uint32_t step = 0; step < kSize && seen < kept; ++step) {
    const uint64_t taken = std::min<uint64_t>(counts_[step], kept - seen);
    const double middle = (lowerEdge(step) + lowerEdge(step + 1)) / 2;
    sum += static_cast<double>(taken) * std::clamp(middle, static_cast<double>(min_), static_cast<double>(max_));
    seen += taken;
  }
  return sum / static_cast<double>(kept);
}

} // namespace rung::runtime
