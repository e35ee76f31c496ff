// A bounded queue between two threads: one pushes, one pops. No lock, no allocation; what does not fit is refused and
// counted. Indices run freely and wrap; the capacity is a power of two.
//
// Either side may drop what the ring holds. The consumer pops it. The producer cannot, for the consumer may be reading
// an element just then: it marks all elements so far as dropped, and the consumer passes over them the next time it
// looks. Until then they keep their room.
#pragma once
#include <atomic>
#include <cassert>
#include <cstdint>
#include <type_traits>

namespace rung::core {

template <class T>
class Ring {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  // `storage` holds `capacity` elements, a power of two, and outlives the ring.
  Ring(T* storage, uint32_t capacity) noexcept : storage_(storage), mask_(capacity - 1) {
    assert(capacity != 0 && (capacity & mask_) == 0);
  }
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  uint32_t capacity() const noexcept { return mask_ + 1; }

  // Producer. False: full, the element is lost and counted.
  bool push(const T& item) noexcept {
    const uint32_t tail = tail_.load(std::memory_order_relaxed);
    const uint32_t head = head_.load(std::memory_order_acquire);
    if (!isAfter(dropped_.load(std::memory_order_relaxed), head)) dropped_.store(head, std::memory_order_relaxed);
    if (tail - head > mask_) {
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    storage_[tail & mask_] = item;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }
  // Drops all elements so far, and counts those that are refused from 0 again. What the consumer is reading at this
  // moment it may still get.
  void drop() noexcept {
    dropped_.store(tail_.load(std::memory_order_relaxed), std::memory_order_release);
    lost_.store(0, std::memory_order_relaxed);
  }

  // Consumer. The oldest element is number 0; null when there are not that many.
  const T* peek(uint32_t number = 0) const noexcept {
    const uint32_t first = oldest();
    return tail_.load(std::memory_order_acquire) - first <= number ? nullptr : &storage_[(first + number) & mask_];
  }
  bool pop(T& item) noexcept {
    uint32_t first = oldest();
    const bool there = first != tail_.load(std::memory_order_acquire);
    if (there) item = storage_[first++ & mask_];
    if (first != head_.load(std::memory_order_relaxed)) head_.store(first, std::memory_order_release);
    return there;
  }

  // Either thread; exact only for the consumer, and then a lower bound.
  uint32_t size() const noexcept {
    const uint32_t first = oldest();
    return tail_.load(std::memory_order_acquire) - first;
  }
  // Elements refused since the last drop.
  uint32_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
  // Indices wrap: `a` is at most the capacity away from `b`, for the producer keeps `dropped_` near `head_`.
  static bool isAfter(uint32_t a, uint32_t b) noexcept { return static_cast<int32_t>(a - b) > 0; }
  uint32_t oldest() const noexcept {
    const uint32_t dropped = dropped_.load(std::memory_order_acquire);
    const uint32_t head = head_.load(std::memory_order_acquire);
    return isAfter(dropped, head) ? dropped : head;
  }

  T* storage_;
  uint32_t mask_;
  alignas(64) std::atomic<uint32_t> head_{0}; // written by the consumer
  alignas(64) std::atomic<uint32_t> tail_{0}; // written by the producer
  std::atomic<uint32_t> dropped_{0};          // elements before it count no more; written by the producer
  std::atomic<uint32_t> lost_{0};             // written by the producer
};

template <class T, uint32_t N>
struct RingStorage {
  T items[N];
};

// A ring with its own storage.
template <class T, uint32_t N>
class FixedRing : private RingStorage<T, N>, public Ring<T> {
  static_assert(N > 0 && (N & (N - 1)) == 0, "the capacity must be a power of two");

public:
  FixedRing() noexcept : RingStorage<T, N>{}, Ring<T>(RingStorage<T, N>::items, N) {}
};

} // namespace rung::core
