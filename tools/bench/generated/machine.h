// The simulated machine of a generated program, the same for every form of it: from scan to scan it changes some
// inputs, an index and an operand.
#pragma once
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "tools/bench/generated/work.h"

namespace rung::bench {

struct Change {
  static constexpr size_t kBits = 4;
  uint32_t bitCount = 0;
  std::array<uint32_t, kBits> bits{}; // the inputs that change
  bool hasWords = false;
  std::array<uint32_t, 2> words{}; // an index and an operand
  std::array<uint32_t, 2> wordValues{};
  bool hasReal = false;
  uint32_t real = 0;
  double realValue = 0;
};

class Machine {
public:
  explicit Machine(const Work& work);

  // The inputs before the first scan; results, coils and tables begin at 0.
  const std::vector<bool>& inputs() const { return inputs_; }
  const std::vector<uint32_t>& words() const { return words_; }
  const std::vector<double>& reals() const { return reals_; }
  Change next();

private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  double anyReal() { return (static_cast<double>(below(1024)) - 512) / 64; }

  const Work& work_;
  std::mt19937_64 random_;
  std::vector<bool> inputs_;
  std::vector<uint32_t> words_;
  std::vector<double> reals_;
};

} // namespace rung::bench
