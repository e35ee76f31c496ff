// An operand block for the tests of the simulated NCT control's services, without a program around it.
#pragma once
#include <array>
#include <initializer_list>
#include <span>

#include "rtlib/nc/nct/operand_block.h"

namespace rung::sim::test {

class TestBlock {
public:
  // Words from 1 (the amount) on.
  TestBlock(std::initializer_list<int32_t> words) {
    uint32_t n = 1;
    for (const int32_t word : words) words_[n++] = static_cast<uint32_t>(word);
  }
  TestBlock& real(uint32_t n, double value) {
    const auto bits = std::bit_cast<uint64_t>(value);
    words_[n] = static_cast<uint32_t>(bits);
    words_[n + 1] = static_cast<uint32_t>(bits >> 32);
    return *this;
  }
  TestBlock& word(uint32_t n, int32_t value) {
    words_[n] = static_cast<uint32_t>(value);
    return *this;
  }

  nc::nct::Block block() { return nc::nct::Block(std::span(words_)); }
  int32_t operator[](uint32_t n) { return block().word(n); }
  bool answered(uint32_t n) { return block().isAnswered(n); }

private:
  std::array<uint32_t, nc::nct::kBlockStride> words_{};
};

} // namespace rung::sim::test
