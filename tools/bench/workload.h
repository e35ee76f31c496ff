// The program that the benchmarks run, in two forms that do the same: NCT ladder text, and the C++ that somebody would
// write by hand for it. Bit logic only: a rung is three contacts (two in series with one, or a parallel pair with one)
// and a coil; the contacts are drawn from a seed among all inputs and all coils.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace rung::bench {

struct Contact {
  uint32_t bit = 0; // 0…kInputs-1: inputs, then coils
  bool negated = false;
};

struct WorkRung {
  Contact first;
  Contact second;
  bool parallel = false; // first OR second, else first AND second
  Contact third;         // AND
};

inline constexpr uint32_t kInputs = 1024;

// Rung i drives coil i.
std::vector<WorkRung> drawRungs(uint32_t count, uint64_t seed);
std::string ladderText(const std::vector<WorkRung>& rungs);
// With a `bool` a bit, inputs and coils in one array: extern "C" void scan(bool *m).
std::string handWritten(const std::vector<WorkRung>& rungs);
// Where the ladder keeps a bit: word and bit number in it.
uint32_t wordOf(uint32_t bit);

} // namespace rung::bench
