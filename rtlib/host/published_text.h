// A text that one thread sets while others read it. Neither side waits.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::host {

class PublishedText {
public:
  // What does not fit is cut off.
  void set(std::string_view text) noexcept {
    const uint32_t version = version_.load(std::memory_order_relaxed);
    version_.store(version + 1, std::memory_order_relaxed);
    const size_t size = std::min(text.size(), text_.size());
    // Released one by one: whoever reads a new one sees the odd version too.
    for (size_t i = 0; i < size; ++i) text_[i].store(text[i], std::memory_order_release);
    size_.store(size, std::memory_order_release);
    version_.store(version + 2, std::memory_order_release);
  }

  // The number of characters that `to` now holds; 0 while the text is being set.
  size_t read(std::span<char> to) const noexcept {
    const uint32_t version = version_.load(std::memory_order_acquire);
    const size_t size = std::min(size_.load(std::memory_order_acquire), to.size());
    for (size_t i = 0; i < size; ++i) to[i] = text_[i].load(std::memory_order_acquire);
    const bool whole = version % 2 == 0 && version_.load(std::memory_order_relaxed) == version;
    return whole ? size : 0;
  }

  static constexpr size_t kMost = 512;

private:
  std::atomic<uint32_t> version_{0}; // odd: the text is being set
  std::atomic<size_t> size_{0};
  std::array<std::atomic<char>, kMost> text_{};
};

} // namespace rung::host
