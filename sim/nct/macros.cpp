// Macro variables (see macros.h).
#include "sim/nct/macros.h"

#include <cmath>

namespace rung::sim::nct {
namespace {

constexpr uint32_t kFromPlc = 1000;
constexpr uint32_t kToPlc = 1100;
constexpr uint32_t kBits = 32; // then the double word, then three doubles

uint32_t asWord(double value) {
  return std::abs(value) < 4294967296.0 ? static_cast<uint32_t>(static_cast<int64_t>(value)) : 0;
}

// Variable `n` of one of the two groups: its bits, its double word, its doubles.
double groupRead(const SignalMemory& signals, const WordSignal& bits, const RealSignal (&reals)[3], uint32_t n,
                 uint32_t channel) {
  const auto word = static_cast<uint32_t>(signals.get(bits, channel));
  if (n < kBits) return word >> n & 1;
  return n == kBits ? word : signals.get(reals[n - kBits - 1], channel);
}

} // namespace

std::optional<double> Macros::read(int64_t variable, int64_t channel) const {
  if (variable < kFirst || variable > kLast || channel < 0 || channel >= nc::nct::kChannels) return std::nullopt;
  return const_cast<Macros*>(this)->place(static_cast<uint32_t>(variable), static_cast<uint32_t>(channel));
}

bool Macros::write(int64_t variable, int64_t channel, double value) {
  if (!read(variable, channel)) return false;
  place(static_cast<uint32_t>(variable), static_cast<uint32_t>(channel)) = value;
  return true;
}

std::optional<double> Macros::programRead(uint32_t variable, uint32_t channel) const {
  if (channel >= nc::nct::kChannels) return std::nullopt;
  if (variable >= kFromPlc && variable <= kFromPlc + kBits + 3)
    return groupRead(links().signals, bitsToProgram_, toProgram_, variable - kFromPlc, channel);
  if (variable >= kToPlc && variable <= kToPlc + kBits + 3)
    return groupRead(links().signals, bitsToPlc_, toPlc_, variable - kToPlc, channel);
  return read(variable, channel);
}

bool Macros::programWrite(uint32_t variable, uint32_t channel, double value) {
  if (channel >= nc::nct::kChannels) return false;
  if (variable >= kFirst && variable <= kLast) {
    place(variable, channel) = value;
    return true;
  }
  if (variable < kToPlc || variable > kToPlc + kBits + 3) return false;
  const SignalMemory& signals = links().signals;
  const uint32_t n = variable - kToPlc;
  const auto word = static_cast<uint32_t>(signals.get(bitsToPlc_, channel));
  const uint32_t mask = n < kBits ? uint32_t{1} << n : 0;
  if (n < kBits)
    signals.set(bitsToPlc_, channel, static_cast<int32_t>(value != 0 ? word | mask : word & ~mask));
  else if (n == kBits)
    signals.set(bitsToPlc_, channel, static_cast<int32_t>(asWord(value)));
  else
    signals.set(toPlc_[n - kBits - 1], channel, value);
  return true;
}

std::optional<double> Macros::quantity(std::string_view name) const {
  const auto key = numbersAfter(name, "MACRO.");
  if (!key || key->size() != 2 || (*key)[0] < 1) return std::nullopt;
  return programRead((*key)[1], (*key)[0] - 1);
}

Handled Macros::setQuantity(std::string_view name, double value) {
  const auto key = numbersAfter(name, "MACRO.");
  if (!key) return std::nullopt;
  if (key->size() != 2 || (*key)[0] < 1 || !programWrite((*key)[1], (*key)[0] - 1, value))
    return "NC.MACRO.C.N: channel 1 to 8, variable 100 to 999 or 1100 to 1135";
  return "";
}

void Macros::powerOn(nc::PowerOn kind) {
  volatile_ = {};
  if (kind == nc::PowerOn::Cold) kept_ = {};
}

void Macros::keep(Kept& kept) { kept.value(kept_); }

} // namespace rung::sim::nct
