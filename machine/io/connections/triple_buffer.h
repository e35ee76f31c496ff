// Whole values from one thread to another, where neither ever waits: the reader gets the newest that is complete, and
// what it does not fetch is replaced by what comes next.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>

namespace rung::io {

template <class T>
class TripleBuffer {
public:
  explicit TripleBuffer(const T& initial) : values_{initial, initial, initial} {}

  // The writing thread: fills all of `back`, which has an older value, and publishes it.
  T& back() noexcept { return values_[back_]; }
  void publish() noexcept { back_ = middle_.exchange(back_ | kNew, std::memory_order_acq_rel) & kIndex; }

  // The reading thread: true where `front` is a newer value than before.
  bool take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  const T& front() const noexcept { return values_[front_]; }

private:
  static constexpr uint8_t kIndex = 3, kNew = 4;

  std::array<T, 3> values_;
  std::atomic<uint8_t> middle_{2}; // an index, and whether it was published since it was last taken
  uint8_t back_ = 0;               // of the writing thread
  uint8_t front_ = 1;              // of the reading thread
};

} // namespace rung::io
