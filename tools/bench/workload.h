// The programs that the benchmarks run, each in two forms that do the same: PLC source, and the C++ that somebody would
// write by hand for it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace rung::bench {

struct Workload {
  std::string file; // its ending says the dialect
  std::string text;
  uint32_t units = 0;  // rungs, or steps
  uint32_t inputs = 0; // of `bits`, the first ones
  // Where the program keeps what the hand-written form has in one array: a byte a bit, then two bytes a word.
  std::vector<std::string> bits;
  std::vector<std::string> words;
  std::vector<std::string> ones; // set before the first scan
  // extern "C": void scan(unsigned char *); and void start() where there is state of its own.
  std::string hand;
};

// NCT ladder text, bit logic only: a rung is three contacts (two in series with one, or a parallel pair with one) and a
// coil; the contacts are drawn from a seed among 1,024 inputs and all coils.
Workload bitsWorkload(uint32_t rungs, uint64_t seed);

} // namespace rung::bench
