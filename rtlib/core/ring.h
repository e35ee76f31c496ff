// A bounded queue between two threads: one pushes, one pops. No lock, no allocation; what does not fit is refused and
// counted. Indices run freely and wrap; the capacity is a power of two.
#pragma once
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace rung::rt {

template <class T>
class Ring {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  // `storage` holds `capacity` elements, a power of two, and outlives the ring.
  Ring(T* storage, uint32_t capacity) noexcept : storage_(storage), mask_(capacity - 1) {}
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  uint32_t capacity() const noexcept { return mask_ + 1; }

  // Producer. False: full, the element is lost and counted.
  bool push(const T& item) noexcept {
    const uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) > mask_) {
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    storage_[tail & mask_] = item;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  // Consumer. The oldest element is number 0; null when there are not that many.
  const T* peek(uint32_t number = 0) const noexcept {
    const uint32_t head = head_.load(std::memory_order_relaxed);
    if (tail_.load(std::memory_order_acquire) - head <= number) return nullptr;
    return &storage_[(head + number) & mask_];
  }
  bool pop(T& item) noexcept {
    const T* oldest = peek();
    if (oldest == nullptr) return false;
    item = *oldest;
    head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    return true;
  }

  // Either thread; exact only for the consumer, and then a lower bound.
  uint32_t size() const noexcept {
    return tail_.load(std::memory_order_acquire) - head_.load(std::memory_order_acquire);
  }
  // Elements refused since the last clear.
  uint32_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

  // Only while neither thread uses the ring.
  void clear() noexcept {
    head_.store(0, std::memory_order_relaxed);
    tail_.store(0, std::memory_order_relaxed);
    lost_.store(0, std::memory_order_relaxed);
  }

private:
  T* storage_;
  uint32_t mask_;
  alignas(64) std::atomic<uint32_t> head_{0}; // written by the consumer
  alignas(64) std::atomic<uint32_t> tail_{0}; // written by the producer
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

} // namespace rung::rt
