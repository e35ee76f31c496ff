// The buffer by which an MR or MW box and the NC exchange an operand block (man. l.3440-3465, 3510-3540). Every box
// owns one in the space "@MB": kBlockWords words as the manual numbers them (0: execution code, 1: amount of data, from
// 2 on: words of the function), followed by a mask with a bit for each word that the NC has written. For a request the
// box copies its block here, whatever its amount, and clears the mask; the NC writes its answer here before it
// completes the request; the box then copies word 0 and the masked words back.
#pragma once
#include <bit>
#include <cstdint>
#include <span>

namespace rung::nc::nct {

inline constexpr const char* kBlockSpace = "@MB";

// Enough for the longest block that the manual describes: MW 306 with 64 program numbers has 69 words, MR 32 for 32
// axes 68, MR 309 over a column of 128 doubles 261.
inline constexpr uint32_t kBlockWords = 512;
inline constexpr uint32_t kMaskWords = kBlockWords / 32;
inline constexpr uint32_t kBlockStride = kBlockWords + kMaskWords; // words of each box

inline constexpr uint32_t kCodeWord = 0;
inline constexpr uint32_t kAmountWord = 1;

// One buffer: kBlockStride words of the space, or a copy of them. Words past the end read 0, and writing them does
// nothing.
class Block {
public:
  explicit Block(std::span<uint32_t> words) : words_(words) {}

  int32_t amount() const { return word(kAmountWord); }
  int32_t word(uint32_t n) const { return n < kBlockWords ? static_cast<int32_t>(words_[n]) : 0; }
  // Words n (low) and n + 1.
  double real(uint32_t n) const {
    return std::bit_cast<double>(uint64_t{static_cast<uint32_t>(word(n + 1))} << 32 | static_cast<uint32_t>(word(n)));
  }

  // Answers of the NC: the word is copied back to the program.
  void setWord(uint32_t n, int32_t value) {
    if (n >= kBlockWords) return;
    words_[n] = static_cast<uint32_t>(value);
    words_[kBlockWords + n / 32] |= uint32_t{1} << n % 32;
  }
  void setReal(uint32_t n, double value) {
    const uint64_t bits = std::bit_cast<uint64_t>(value);
    setWord(n, static_cast<int32_t>(bits));
    setWord(n + 1, static_cast<int32_t>(bits >> 32));
  }
  bool isAnswered(uint32_t n) const { return n < kBlockWords && (words_[kBlockWords + n / 32] >> n % 32 & 1) != 0; }

private:
  std::span<uint32_t> words_;
};

} // namespace rung::nc::nct
