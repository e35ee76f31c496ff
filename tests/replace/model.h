// What the cells that all programs share must hold (see programs.h), whichever of them runs: worked out from the
// numbers of scans and the clock alone.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace rung::test {

class Model {
public:
  // All cells by name, in the order of `values`.
  static std::vector<std::string> names();
  std::vector<int64_t> values() const;

  // The program has run once, at this time of its clock.
  void scan(int64_t nowUs);
  // The host has written a retained cell: of `writable` ones, which come first in `names`.
  static uint32_t writable();
  void write(uint32_t cell, int64_t value) { written_[cell] = value; }
  // What a retained cell can hold: a word or a bit.
  static int64_t fitting(uint32_t cell, uint32_t random);

private:
  static uint32_t timers();
  struct Timer {
    bool active = false;
    bool over = false;
    int64_t sinceUs = -1;
    int64_t leftMs = 0;
    int64_t ticks = 0;
  };

  std::vector<int64_t> written_ = std::vector<int64_t>(writable()); // KEEP, LATCH
  int64_t scans_ = 0;
  std::vector<Timer> timers_ = std::vector<Timer>(timers());
};

} // namespace rung::test
