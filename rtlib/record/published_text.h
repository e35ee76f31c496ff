// A text that one thread sets while others read it. Neither side waits.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "rtlib/record/latest.h"

namespace rung::runtime {

class PublishedText {
public:
  static constexpr size_t kMost = 512;

  // Sets the text; the rest of a longer one is cut off.
  void set(std::string_view text) noexcept {
    std::array<uint64_t, kWords> words{};
    words[0] = std::min(text.size(), kMost);
    std::memcpy(&words[1], text.data(), words[0]);
    latest_.publish(words);
  }

  // Reads the text. The number of characters in `to`; 0: there is none, or it was set repeatedly while this was
  // reading.
  size_t read(std::span<char> to) const noexcept {
    std::array<uint64_t, kWords> words{};
    if (latest_.read([&](size_t i, uint64_t word) { words[i] = word; }) != Looked::Found) return 0;
    const size_t size = std::min<size_t>(words[0], to.size());
    std::memcpy(to.data(), &words[1], size);
    return size;
  }

private:
  static constexpr size_t kWords = 1 + kMost / sizeof(uint64_t);
  Latest latest_{kWords};
};

} // namespace rung::runtime
